"""The tiles of a directory, read as they are asked for."""

from __future__ import annotations

import importlib.util
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from ._dataset import Dataset, has_xarray, of_numpy, of_xarray
from ._sweep import path_of
from ._squealmap import Tiles

if TYPE_CHECKING:
    import xarray


def open(directory: Union[str, os.PathLike[str]], *, chunks: Union[str, None] = "tiles") -> Dataset:
    """Opens the directory of a run of the program; values are read when they are asked for.

    Args:
        directory: what ``squealmap run`` has written, complete or not; what is missing is ``not_computed``.
        chunks: ``"tiles"`` for arrays of dask in pieces of about a tile, where dask is installed; None for none.

    Returns:
        As :func:`squealmap.run`. Without xarray all is read at once.

    Raises:
        InputError: there are no tiles, or a tile is damaged.
    """
    if chunks not in ("tiles", None):
        raise ValueError(f'chunks is {chunks!r} but must be "tiles" or None')
    path = path_of(directory)
    tiles = Tiles(path)
    dimensions, coordinates, variables, attrs = tiles.described()
    shape = [length for _, length in dimensions]
    manifest = Path(path, "manifest.json")
    if manifest.is_file():
        attrs["manifest"] = manifest.read_text(encoding="utf-8")
    if not has_xarray():
        instances = math.prod(shape)
        read = [(name, dims, tiles.values(name, 0, instances), of) for name, dims, _, of in variables]
        return of_numpy((dimensions, coordinates, read, attrs))
    made = of_xarray((dimensions, coordinates, [], attrs))
    from ._lazy import lazy

    for name, dims, none, of in variables:
        made[name] = lazy(path, tiles, name, dims, tuple(shape), none.dtype, of)
    if chunks == "tiles" and importlib.util.find_spec("dask") is not None:
        return _chunked(made, dimensions, tiles.tile)
    return made


def _chunked(made: xarray.Dataset, dimensions: list[tuple[str, int]], tile: int) -> xarray.Dataset:
    """In pieces along the first dimensions, each of about a tile."""
    chunks: dict[str, int] = {}
    for at, (name, length) in enumerate(dimensions):
        within = math.prod(length for _, length in dimensions[at + 1 :])
        chunks[name] = min(length, max(1, tile // max(within, 1)))
    return made.chunk(chunks)
