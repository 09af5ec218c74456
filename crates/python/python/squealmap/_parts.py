"""What the program draws a dataset from: the table and the document of its command, for the part of it that is there."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._errors import InputError
from ._names import meanings, whole

if TYPE_CHECKING:
    import xarray

Columns = list[tuple[str, Any]]


class Part(NamedTuple):
    """Names and contents of a table and of the document beside it."""

    table: str
    columns: Columns
    document: str
    text: str


def _map(dataset: xarray.Dataset) -> Part:
    if "status" not in dataset:
        raise InputError("a map is drawn with its `status`, which this dataset has no longer; select with ds.isel or ds.sel")
    if not dataset["status"].dims:
        raise InputError("one instance is no map; select some")
    manifest = json.loads(dataset.attrs["manifest"])
    for key in ("files", "checksum", "tiles"):
        manifest.pop(key, None)
    spec = manifest["spec"]
    listed = "axes" not in spec
    # Rows go through the axes in the order of the sweep, whichever the order of the dimensions is here.
    dims = ["instance"] if listed else [name for name in spec["axes"] if name in dataset["status"].dims]
    _are(dataset["status"], dims, "the axes of the sweep")
    columns = spec["points"]["columns"] if listed and "points" in spec else list(spec.get("axes", {}))
    swept = [name for name in columns if name in dataset.coords and dataset.coords[name].ndim == 1]
    if not listed:
        _have(dataset, dims)
    like = dataset["status"].transpose(*dims)
    rows = [(name, dataset[name].broadcast_like(like).transpose(*dims)) for name in swept]
    # What a user has added is drawn where it is over all instances.
    over = [name for name in dataset.data_vars if {*dataset[name].dims} == {*dims}]
    rows += [(str(name), dataset[name].transpose(*dims)) for name in over]
    there = {*swept, *over}
    manifest["columns"] = [one for one in manifest["columns"] if one["name"] in there]
    if listed:
        if "points" in spec:
            spec["points"]["rows"] = dataset.sizes["instance"]
    else:
        spec["axes"] = {name: {**spec["axes"][name], "values": dataset[name].values.tolist()} for name in dims}
    return Part("map.csv", [(name, _cells(values)) for name, values in rows], "manifest.json", json.dumps(manifest))


def _modes(dataset: xarray.Dataset) -> Part:
    document = json.loads(dataset.attrs["manifest"])
    axes = document["grid"]["axes"]
    names = [axis["name"] for axis in axes]
    frequency = dataset["frequency"]
    dims = [name for name in names if name in frequency.dims]
    if "mode" not in frequency.dims:
        raise InputError("modes are drawn with their dimension `mode`: select with a list, ds.isel(mode=[0])")
    _are(frequency, [*dims, "mode"], "the axes of the sweep and `mode`")
    _have(dataset, [*dims, "mode"])
    followed = next(axis["name"] for axis in axes if len(axis["values"]) > 1 and not isinstance(axis["values"][0], str))
    if frequency.sizes.get(followed, 1) < 2:
        raise InputError(f"modes are drawn along `{followed}`, of which one value is left; select more of it")
    modes = dataset["mode"].values.tolist()
    if modes != list(range(1, len(modes) + 1)):
        raise InputError("modes are drawn from the first one on and in their order; select ds.isel(mode=[0]) or slices from 0")
    for axis in axes:
        name = axis["name"]
        if name in dataset.coords:
            values = dataset[name].values
            axis["values"] = values.tolist() if values.ndim else [values.item()]
        elif len(axis["values"]) > 1:
            _have(dataset, [name])
    across = [name for name in dims if name != followed]
    branches = int(np.prod([dataset.sizes[name] for name in across], dtype=int))
    document["critical"] = _crossings(dataset, across, dataset[followed].values, branches)
    like = frequency.isel(mode=0, drop=True).transpose(*dims)
    there = [name for name in names if name in dataset.coords]
    columns = [(name, _cells(dataset[name].broadcast_like(like).transpose(*dims))) for name in there]
    for at, mode in enumerate(modes):
        for name, column in [
            ("frequency", f"frequency_{mode}"),
            ("growth_rate", f"growth_rate_{mode}"),
            ("growth_rate_fast", f"growth_rate_{mode}_fast"),
        ]:
            columns.append((column, _cells(dataset[name].isel(mode=at).transpose(*dims))))
    return Part("modes.csv", columns, "modes.json", json.dumps(document))


def _crossings(dataset: xarray.Dataset, across: list[str], values: Any, branches: int) -> list[list[float]]:
    """Where the largest growth rate of each branch crosses zero, of what is within the values that are there."""
    if "critical" not in dataset or dataset["critical"].size == 0:
        return [[] for _ in range(branches)]
    critical = dataset["critical"]
    if "crossing" not in critical.dims:
        critical = critical.expand_dims("crossing")
    rows = critical.transpose(*across, "crossing").values.reshape(branches, -1)
    return [[x for x in row.tolist() if min(values) <= x <= max(values)] for row in rows]


def _trace(dataset: xarray.Dataset) -> Part:
    if "state" not in dataset:
        raise InputError("a trace is drawn with its `state`, which this dataset has no longer; select times with ds.isel(t=…)")
    _are(dataset["state"], ["t"], "the times")
    _have(dataset, ["t"])
    document = json.loads(dataset.attrs["manifest"])
    document["rows"] = dataset.sizes["t"]
    ordered = dataset.sortby("t")
    names = ["t", *(name for name in dataset.data_vars if dataset[name].dims == ("t",))]
    return Part("trace.csv", [(str(name), _cells(ordered[name])) for name in names], "trace.json", json.dumps(document))


def _fem(dataset: xarray.Dataset) -> Part:
    _are(dataset["frequency"], ["mu", "mode"], "`mu`, of which two values are needed, and `mode`")
    _have(dataset, ["mu", "mode"])
    ordered = dataset.sortby(["mu", "mode"])
    like = ordered["frequency"].transpose("mu", "mode")
    names = ["mu", "mode", *(name for name in dataset.data_vars if {*dataset[name].dims} <= {"mu", "mode"})]
    columns = [(str(name), _cells(ordered[name].broadcast_like(like).transpose("mu", "mode"))) for name in names]
    return Part("fem.csv", columns, "manifest.json", str(dataset.attrs["manifest"]))


PARTS = {"map": _map, "modes": _modes, "trace": _trace, "fem": _fem}


def _have(dataset: xarray.Dataset, names: list[str]) -> None:
    """Refuses a dataset whose coordinates were dropped: indices are no values."""
    for name in names:
        if name not in dataset.coords:
            raise InputError(f"the values of `{name}` are not there any longer: keep its coordinate")


def _are(variable: xarray.DataArray, dims: list[str], what: str) -> None:
    """Refuses dimensions that the program does not know."""
    if {*variable.dims} != {*dims}:
        found = ", ".join(str(name) for name in variable.dims) or "none"
        raise InputError(f"the dimensions are {found}, but a figure is drawn over {what}")


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
