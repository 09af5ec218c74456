"""The figures of the program."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _squealmap
from ._errors import InputError
from ._names import meanings, whole

if TYPE_CHECKING:
    import xarray

# The files that the figure of each kind is drawn from: its table and its document.
_FILES = {
    "map": ("map.csv", "manifest.json"),
    "modes": ("modes.csv", "modes.json"),
    "trace": ("trace.csv", "trace.json"),
    "fem": ("fem.csv", "manifest.json"),
}


class Figure:
    """A figure as SVG, which notebooks show."""

    def __init__(self, svg: str, title: str = "") -> None:
        self.svg = svg
        self.title = title

    def _repr_svg_(self) -> str:
        return self.svg

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the figure as SVG, PNG or PDF, by the ending of the path.

        Raises:
            InputError: for another ending.
        """
        ending = Path(path).suffix.lstrip(".").lower()
        if ending == "svg":
            Path(path).write_text(self.svg, encoding="utf-8")
        elif ending in ("png", "pdf"):
            Path(path).write_bytes(_squealmap.rendered(self.svg, ending, self.title))
        else:
            raise InputError(f"a figure is saved as .svg, .png or .pdf, not as .{ending}")

    def __repr__(self) -> str:
        return f"<squealmap.Figure of {len(self.svg)} characters of SVG; save(path) writes it>"


def plot(
    dataset: xarray.Dataset,
    quantity: Union[str, Iterable[str], None] = None,
    *,
    select: Union[Mapping[str, Any], str, None] = None,
    cut: Union[Mapping[str, Any], str, None] = None,
    isolines: Iterable[float] = (),
    levels: Union[int, None] = None,
    hatch: bool = False,
    journal: Union[str, None] = None,
    width: Union[float, None] = None,
    title: Union[str, None] = None,
) -> Figure:
    """Draws a dataset of this package as the program does.

    Args:
        dataset: what :func:`run`, :func:`linear`, :func:`open`, :func:`modes`, :func:`trace` or :func:`fem` gave, or a part of it.
        quantity: of a map, what to show: ``type``, ``regime``, ``growth``, ``amplitude``, ``frequency`` or a column of numbers.
        select, cut: of a map, values of axes: only these instances, or curves through them.
        isolines: of a map, lines at these values of its quantities, in their units.
        levels: of a map, lines at about so many round values.
        hatch: of a map, types by hatching too.
        journal: the width that a journal asks for, such as ``"elsevier-1col"``.
        width: or the width, mm.
        title: what stands above the figure.

    Raises:
        InputError: the dataset is none of this package, or has no such quantity.
    """
    if not hasattr(dataset, "data_vars"):
        what = type(dataset).__name__
        raise InputError(f"plot takes an xarray.Dataset, not {what}; install xarray: pip install 'squealmap[xarray]'")
    empty = [str(name) for name, size in dataset.sizes.items() if size == 0]
    if empty:
        raise InputError(f"there is nothing to draw: `{empty[0]}` has no values; select some")
    kind = str(dataset.attrs.get("squealmap", ""))
    if kind not in _FILES:
        raise InputError("only datasets of squealmap draw themselves: the attribute `squealmap` is not there or another")
    options = []
    names = [quantity] if isinstance(quantity, str) else list(quantity or ())
    for option, value in [
        ("--quantity", ",".join(names)),
        ("--select", _pairs(select)),
        ("--cut", _pairs(cut)),
        ("--isolines", ",".join(str(float(one)) for one in isolines)),
        ("--levels", levels),
        ("--journal", journal),
        ("--width", width),
        ("--title", title),
    ]:
        if value is not None and (value != "" or option == "--title"):
            options.append(f"{option}={value}")
    if hatch:
        options.append("--hatch")
    with tempfile.TemporaryDirectory() as directory:
        table, document = _FILES[kind]
        columns = _instances(dataset) if kind == "map" else _COLUMNS[kind](dataset)
        _squealmap.write_table(os.path.join(directory, table), columns)
        text = _of_part(dataset) if kind in ("map", "modes", "trace") else str(dataset.attrs["manifest"])
        Path(directory, document).write_text(text, encoding="utf-8")
        svg = _squealmap.figure([directory, *options])
        # The figure says of which directory it is.
        svg = svg.replace(directory, "DIR")
    return Figure(svg, title or str(dataset.attrs.get("title", "")))


def _pairs(pairs: Union[Mapping[str, Any], str, None]) -> str:
    if pairs is None or isinstance(pairs, str):
        return pairs or ""
    return ",".join(f"{key}={value}" for key, value in pairs.items())


def _swept(dataset: xarray.Dataset) -> list[str]:
    """The axes of a map, or the columns of listed instances."""
    of = dataset.attrs["manifest"]
    spec = json.loads(of).get("spec", {})
    names = list(spec.get("axes", {})) or list(spec.get("points", {}).get("columns", []))
    return [name for name in names if name in dataset.coords and dataset.coords[name].ndim == 1]


def _cells(values: xarray.DataArray) -> Any:
    """A column as the table takes it."""
    flat = values.values.ravel()
    if "flag_values" in values.attrs:
        said = meanings(values.attrs)
        first = min(said)
        yes_no = {"no": "0", "yes": "1", "undefined": ""}
        words = [yes_no.get(said.get(code, ""), said.get(code, "")) for code in range(first, max(said) + 1)]
        return whole(flat, said, np.int8, f"the values of `{values.name}`"), first, words
    return [str(word) for word in flat] if flat.dtype.kind in "OUS" else flat.astype(np.float64)


def _instances(dataset: xarray.Dataset) -> list[tuple[str, Any]]:
    """The columns of ``map.csv``."""
    if "status" not in dataset:
        raise InputError("a map is drawn with its `status`, which this dataset has no longer; select with ds.isel or ds.sel")
    if not dataset["status"].dims:
        raise InputError("one instance is no map; select some")
    swept = _swept(dataset)
    dims = dataset["status"].dims
    whole = [(name, dataset[name].broadcast_like(dataset["status"]).transpose(*dims)) for name in swept]
    computed = [(str(name), dataset[name].transpose(*dims)) for name in dataset.data_vars if dataset[name].dims]
    return [(name, _cells(values)) for name, values in whole + computed]


def _modes(dataset: xarray.Dataset) -> list[tuple[str, Any]]:
    """The columns of ``modes.csv``."""
    axes = [dim for dim in dataset["frequency"].dims if dim != "mode"]
    like = dataset["frequency"].isel(mode=0, drop=True)
    columns = [(str(axis), _cells(dataset[axis].broadcast_like(like).transpose(*axes))) for axis in axes]
    for at, mode in enumerate(dataset["mode"].values.tolist()):
        for name, column in [
            ("frequency", f"frequency_{mode}"),
            ("growth_rate", f"growth_rate_{mode}"),
            ("growth_rate_fast", f"growth_rate_{mode}_fast"),
        ]:
            columns.append((column, _cells(dataset[name].isel(mode=at).transpose(*axes))))
    return columns


def _trace(dataset: xarray.Dataset) -> list[tuple[str, Any]]:
    """The columns of ``trace.csv``."""
    return [(str(name), _cells(dataset[name])) for name in ["t", *dataset.data_vars]]


def _fem(dataset: xarray.Dataset) -> list[tuple[str, Any]]:
    """The columns of ``fem.csv``."""
    like = dataset["frequency"].transpose("mu", "mode")
    names = ["mu", "mode", *dataset.data_vars]
    return [(str(name), _cells(dataset[name].broadcast_like(like).transpose("mu", "mode"))) for name in names]


_COLUMNS = {"modes": _modes, "trace": _trace, "fem": _fem}


def _of_part(dataset: xarray.Dataset) -> str:
    """The document of a dataset, with the values that its axes have here."""
    manifest = json.loads(dataset.attrs["manifest"])
    if dataset.attrs["squealmap"] == "trace":
        manifest["rows"] = dataset.sizes["t"]
    if dataset.attrs["squealmap"] != "map":
        return json.dumps(manifest)
    for key in ("files", "checksum", "tiles"):
        manifest.pop(key, None)
    there = {*_swept(dataset), *dataset.data_vars}
    manifest["columns"] = [one for one in manifest["columns"] if one["name"] in there]
    spec = manifest["spec"]
    if "axes" in spec:
        dims = dataset["status"].dims
        spec["axes"] = {
            name: {**axis, "values": dataset[name].values.tolist()} for name, axis in spec["axes"].items() if name in dims
        }
    elif "points" in spec:
        spec["points"]["rows"] = dataset.sizes["instance"]
    return json.dumps(manifest)
