"""The figures of the program."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from . import _squealmap
from ._errors import InputError
from ._parts import PARTS

if TYPE_CHECKING:
    import xarray

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
        get = "give its dataset and name it as quantity" if what == "DataArray" else "install xarray: pip install 'squealmap[xarray]'"
        raise InputError(f"plot takes an xarray.Dataset, not {what}; {get}")
    # No branch of modes may cross zero.
    empty = [str(name) for name, size in dataset.sizes.items() if size == 0 and name != "crossing"]
    if empty:
        raise InputError(f"there is nothing to draw: `{empty[0]}` has no values; select some")
    kind = str(dataset.attrs.get("squealmap", ""))
    if kind not in PARTS:
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
        part = PARTS[kind](dataset)
        _squealmap.write_table(os.path.join(directory, part.table), part.columns)
        Path(directory, part.document).write_text(part.text, encoding="utf-8")
        svg = _squealmap.figure([directory, *options])
        # The figure says of which directory it is.
        svg = svg.replace(directory, "DIR")
    return Figure(svg, title or str(dataset.attrs.get("title", "")))


def _pairs(pairs: Union[Mapping[str, Any], str, None]) -> str:
    if pairs is None or isinstance(pairs, str):
        return pairs or ""
    return ",".join(f"{key}={value.item() if hasattr(value, 'item') else value}" for key, value in pairs.items())
