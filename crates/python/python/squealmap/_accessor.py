"""What a dataset of xarray can do: ``ds.squealmap``."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray

from ._figure import Figure, plot
from ._names import names


# xarray has no types for it.
_register: Any = xarray.register_dataset_accessor


@_register("squealmap")
class Accessor:
    """What this package knows of a dataset that it made."""

    def __init__(self, dataset: xarray.Dataset) -> None:
        self._dataset = dataset

    def plot(self, quantity: Any = None, **options: Any) -> Figure:
        """The figure of the program, see :func:`squealmap.plot`."""
        return plot(self._dataset, quantity, **options)

    def names(self, name: str) -> xarray.DataArray:
        """The names of a variable of codes such as ``type``; empty where undefined."""
        return names(self._dataset[name])

    @property
    def manifest(self) -> dict[str, Any]:
        """The document of the program: sweep, engine, counts, meanings."""
        found: dict[str, Any] = json.loads(self._dataset.attrs["manifest"] or "{}")
        return found

    def counts(self, name: str) -> dict[str, int]:
        """How many instances have each name of a variable of codes."""
        found, counts = np.unique(self.names(name).values, return_counts=True)
        return dict(zip(found.tolist(), counts.tolist()))

    def _repr_svg_(self) -> str:
        return self.plot().svg
