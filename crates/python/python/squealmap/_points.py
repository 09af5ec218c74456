"""Instances one by one: columns by the names of keys."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Set
from numbers import Real
from typing import Any, Union

import numpy as np

from ._errors import InputError

Column = Union[list[float], list[str]]


def is_columns(points: Any) -> bool:
    """Whether these are columns: a dict of arrays, or a table of pandas; a file is none."""
    return isinstance(points, Mapping) or (hasattr(points, "items") and hasattr(points, "columns"))


def columns_of(points: Any) -> list[tuple[str, Column]]:
    """Columns as the compiled part takes them.

    Raises:
        TypeError: for columns that hold neither numbers nor names.
        InputError: for columns that are not as long as each other.
    """
    found = [(_name(name), _column(str(name), values)) for name, values in points.items()]
    for name, column in found[1:]:
        first, length = found[0][0], len(found[0][1])
        if len(column) != length:
            raise InputError(
                f"points: `{name[:60]}` has {len(column)} values but `{first[:60]}` has {length}; give one of each per instance"
            )
    return found


def _name(name: Any) -> str:
    if not isinstance(name, str):
        raise TypeError(f"points.{str(name)[:60]}: the columns of points are named by strings, not {type(name).__name__}")
    return _encoded(name)


def _column(name: str, values: Any) -> Column:
    if isinstance(values, (str, bytes, Mapping, Set)) or not isinstance(values, Iterable):
        raise TypeError(f"points.{name[:60]} is an array of numbers or names, not {type(values).__name__}")
    if np.ma.is_masked(values):
        raise TypeError(f"points.{name[:60]} is masked in part; leave those instances out")
    # Arrays of numpy, pandas and xarray.
    values = np.asarray(values).tolist() if hasattr(values, "__array__") else list(values)
    if not isinstance(values, list):
        raise TypeError(f"points.{name[:60]} is a single value; give an array of one dimension")
    if values and all(isinstance(one, str) for one in values):
        return [_encoded(one) for one in values]
    for at, one in enumerate(values):
        if isinstance(one, bool) or not isinstance(one, Real):
            kind = type(one).__name__
            raise TypeError(f"points.{name[:60]}[{at}] is a number, or every value is a name; this is of the type {kind}")
    return [_number(one) for one in values]


def _number(value: Any) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def _encoded(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise TypeError(f"a name of the points is no Unicode: {text[:40]!a}") from None
    return text
