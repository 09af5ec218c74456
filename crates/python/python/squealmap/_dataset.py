"""Columns of the compiled part as a dataset."""

from __future__ import annotations

import contextlib
import importlib
import importlib.util
import re
import threading
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import NDArray

from ._arrays import Arrays

if TYPE_CHECKING:
    import xarray

    Column = tuple[str, tuple[str, ...], Any, dict[str, Any]]
    Handed = tuple[list[tuple[str, int]], list[Column], list[Column], dict[str, str]]

# How the compiled part says that it cannot take an argument.
_FIELD = re.compile(r"failed to extract field \w+\.(\w+)")

Dataset = Union["xarray.Dataset", Arrays]


def has_xarray() -> bool:
    """Whether xarray is installed."""
    return importlib.util.find_spec("xarray") is not None


def dataset(handed: Handed) -> Dataset:
    """A dataset of xarray, where it is installed; its arrays are those of the compiled part."""
    return of_xarray(handed) if has_xarray() else of_numpy(handed)


def of_numpy(handed: Handed) -> Arrays:
    """Arrays of numpy."""
    dimensions, coordinates, variables, attrs = handed
    sizes = dict(dimensions)
    return Arrays(
        sizes,
        {column[0]: _shaped(column, sizes) for column in coordinates},
        {column[0]: _shaped(column, sizes) for column in variables},
        {column[0]: column[1] for column in coordinates + variables},
        {column[0]: column[3] for column in coordinates + variables},
        dict(attrs),
    )


def of_xarray(handed: Handed) -> xarray.Dataset:
    """A dataset of xarray, which knows `.squealmap`."""
    import xarray

    importlib.import_module("._accessor", __package__)
    dimensions, coordinates, variables, attrs = handed
    sizes = dict(dimensions)
    return xarray.Dataset(
        {column[0]: (column[1], _shaped(column, sizes), column[3]) for column in variables},
        {column[0]: (column[1], _shaped(column, sizes), column[3]) for column in coordinates},
        attrs,
    )


def _shaped(column: Column, sizes: dict[str, int]) -> NDArray[Any]:
    """The values of a column over its dimensions: the same memory."""
    _, dims, values, _ = column
    flat = values if isinstance(values, np.ndarray) else np.array(values, dtype=str)
    return flat.reshape([sizes[name] for name in dims])


@contextlib.contextmanager
def calling() -> Iterator[None]:
    """Imports xarray, which takes half a second, while the compiled part computes; says which argument has a wrong type."""
    thread = threading.Thread(target=lambda: has_xarray() and importlib.import_module("xarray"))
    thread.start()
    try:
        yield
    except TypeError as why:
        field = _FIELD.match(str(why))
        if field is None:
            raise
        raise TypeError(f"{field[1]}: {why.__cause__}") from None
    finally:
        thread.join()
