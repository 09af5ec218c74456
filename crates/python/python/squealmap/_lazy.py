"""A variable whose values stand in tiles, as xarray reads it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import xarray
from numpy.typing import DTypeLike, NDArray
from xarray.backends import BackendArray
from xarray.core import indexing

from ._squealmap import Tiles


class _OfTiles(BackendArray):
    def __init__(self, directory: str, tiles: Tiles, name: str, shape: tuple[int, ...], dtype: DTypeLike) -> None:
        self.directory = directory
        self.tiles = tiles
        self.name = name
        self.shape = shape
        self.dtype = np.dtype(dtype)

    def __reduce__(self) -> tuple[Any, ...]:
        """Another process, or a copy, opens the directory anew."""
        return _again, (self.directory, self.name, self.shape, self.dtype)

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

    def _read(self, key: tuple[Any, ...]) -> NDArray[Any]:
        """Reads from the first to the last instance that is asked for, and takes these."""
        first, rest, lengths = 0, list(key), list(self.shape)
        while rest and isinstance(rest[0], (int, np.integer)):
            lengths.pop(0)
            first += int(rest.pop(0)) * math.prod(lengths)
        if not rest:
            found: NDArray[Any] = self.tiles.values(self.name, first, first + 1)[0]
            return found
        numbers = range(*rest[0].indices(lengths[0]))
        within = math.prod(lengths[1:])
        if not numbers:
            low, high = 0, 0
        else:
            low, high = min(numbers), max(numbers) + 1
        values = self.tiles.values(self.name, first + low * within, first + high * within)
        block = values.reshape(high - low, *lengths[1:])
        # The first of them is at one end of what was read.
        taken: NDArray[Any] = block[(slice(None, None, numbers.step), *rest[1:])]
        return taken


def _again(directory: str, name: str, shape: tuple[int, ...], dtype: DTypeLike) -> _OfTiles:
    return _OfTiles(directory, Tiles(directory), name, shape, dtype)


def lazy(
    directory: str,
    tiles: Tiles,
    name: str,
    dims: tuple[str, ...],
    shape: tuple[int, ...],
    dtype: DTypeLike,
    attributes: dict[str, Any],
) -> xarray.Variable:
    """A variable that is read when it is asked for."""
    data = indexing.LazilyIndexedArray(_OfTiles(directory, tiles, name, shape, dtype))
    return xarray.Variable(dims, data, attributes)
