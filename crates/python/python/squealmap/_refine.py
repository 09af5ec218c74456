"""The lines of a large map from few of its instances."""

from __future__ import annotations

from typing import Any, Union

from . import _squealmap
from ._dataset import Dataset, dataset, calling
from ._engine import LOG, engine_of
from ._errors import InputError
from ._progress import Progress, Shown
from ._sweep import SweepLike, handed

__all__ = ["refine"]


def refine(
    sweep: SweepLike,
    *,
    coarse: Union[int, None] = None,
    sample: Union[int, None] = None,
    seed: Union[int, None] = None,
    backend: str = "auto",
    precision: Union[str, None] = None,
    strict: bool = False,
    adapter: Union[str, None] = None,
    require_gpu: bool = False,
    threads: Union[int, None] = None,
    progress: Progress = None,
) -> Dataset:
    """Computes the lines between types, regimes and failures of a large map, and not what lies between them.

    A coarse part of the grid comes first, then what lies between computed neighbours that differ. A region inside one coarse cell
    is missed; a sample says how much of the map that may be.

    Args:
        sweep: as of :func:`run`, with two axes of numbers.
        coarse: cells along each side of a map to begin with, 2 to 4096; by default that of the sweep's ``refine``, or 32.
        sample: instances drawn among those that no line asks for; by default that of the sweep, or 1000.
        seed: of the drawing; by default that of the sweep, or 1.
        backend, precision, strict, adapter, require_gpu, threads, progress: as of :func:`run`.

    Returns:
        The arrays of :func:`run` over all axes. Where ``computed`` is no, numbers are NaN and the labels are those of the cell
        around the instance. ``attrs["refined"]`` is JSON: how many were computed, and how much may be missed.

    Raises:
        InputError: the sweep is refused, or has no map of two axes.
        Error: it cannot be computed.
        KeyboardInterrupt: Ctrl-C; nothing is kept.
    """
    choices = {"coarse": _count("coarse", coarse), "sample": _count("sample", sample), "seed": _count("seed", seed)}
    engine = engine_of(
        backend=backend, precision=precision, strict=strict, adapter=adapter, require_gpu=require_gpu, threads=threads
    )
    shown = Shown(progress)
    try:
        with calling():
            found, told = _squealmap.refine(handed(sweep), engine, choices, shown.wanted)
    finally:
        shown.close()
    for note in told:
        LOG.info(note)
    return dataset(found)


def _count(name: str, value: Any) -> Union[int, None]:
    if value is None:
        return None
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise TypeError(f"{name} is a whole number, not {type(value).__name__}")
    number: int = value.__index__()
    if not 0 <= number < 2**63:
        raise InputError(f"{name} is {str(number)[:40]} but must be a whole number from 0 to {2**63 - 1}")
    return number
