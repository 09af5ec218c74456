"""Results without xarray: named numpy arrays."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _names


class Arrays(Mapping[str, NDArray[Any]]):
    """Named arrays over named dimensions, for those without xarray.

    ``arrays["x2_std"]`` is a numpy array; coordinates are found by their names, too.

    Attributes:
        sizes: names and lengths of the dimensions, the first varies slowest.
        coords: the values along the dimensions.
        dims: of each array, its dimensions.
        units: of each array, its SI unit; ``"1"`` when dimensionless.
        attrs: what the dataset is of, see ``manifest``.
    """

    def __init__(
        self,
        sizes: dict[str, int],
        coords: dict[str, NDArray[Any]],
        variables: dict[str, NDArray[Any]],
        dims: dict[str, tuple[str, ...]],
        attributes: dict[str, dict[str, Any]],
        attrs: dict[str, Any],
    ) -> None:
        self.sizes = sizes
        self.coords = coords
        self.dims = dims
        self.units = {name: str(of.get("units", "")) for name, of in attributes.items()}
        self.attrs = attrs
        self._variables = variables
        self._attributes = attributes

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._variables[name] if name in self._variables else self.coords[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._variables)

    def __len__(self) -> int:
        return len(self._variables)

    def attributes(self, name: str) -> dict[str, Any]:
        """Unit, meaning and codes of an array."""
        return self._attributes[name]

    def names(self, name: str) -> NDArray[np.str_]:
        """The names of an array of codes such as ``type``; empty where undefined."""
        return _names.decoded(self[name], self._attributes[name])

    @property
    def manifest(self) -> dict[str, Any]:
        """The document of the program: sweep, engine, counts, meanings."""
        found: dict[str, Any] = json.loads(self.attrs["manifest"] or "{}")
        return found

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name}: {length}" for name, length in self.sizes.items())
        return f"<squealmap.Arrays ({sizes}) {', '.join(self)}>"
