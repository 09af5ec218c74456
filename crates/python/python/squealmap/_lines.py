"""A sweep in Python as the lines of a sweep file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterator, Mapping
from typing import Any

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")
_ESCAPED = re.compile(r'["\\\x00-\x1f\x7f]')
# Deeper than any sweep, and less than Python bears.
_DEEPEST = 16
# Digits of a whole number, whatever it is to mean.
_DIGITS = 40


def lines(sweep: Mapping[str, Any]) -> str:
    """The keys of a sweep, one a line, such as ``axes.mu_s.points = 8``.

    Raises:
        TypeError: for something that a sweep file does not hold.
    """
    return "".join(f"{path} = {value}\n" for path, value in _entries(sweep, ""))


def _entries(table: Mapping[str, Any], above: str, depth: int = 0) -> Iterator[tuple[str, str]]:
    if depth > _DEEPEST:
        raise TypeError(f"{above.rstrip('.')[:60]}: a sweep has no dicts in dicts so deep")
    for key, value in table.items():
        if not isinstance(key, str):
            raise TypeError(f"{above}{key!r}: the keys of a sweep are strings, not {type(key).__name__}")
        path = above + (key if _BARE.match(key) else _text(key))
        if isinstance(value, Mapping) and value:
            yield from _entries(value, path + ".", depth + 1)
        else:
            yield path, _value(value, path, depth)


def _value(value: Any, path: str, depth: int) -> str:
    if depth > _DEEPEST:
        raise TypeError(f"{path}: a sweep has no lists in lists so deep")
    # Numbers and arrays of numpy, pandas and xarray, the last of which hold one of numpy.
    if hasattr(value, "dims"):
        value = value.values
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value) if abs(value) < 10**_DIGITS else ("inf" if value > 0 else "-inf")
    if isinstance(value, float):
        if math.isfinite(value):
            return repr(value)
        return "nan" if math.isnan(value) else ("inf" if value > 0 else "-inf")
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, os.PathLike):
        return _text(os.fsdecode(value))
    if isinstance(value, Mapping):
        pairs = (f"{key} = {text}" for key, text in _entries(value, "", depth + 1))
        return "{ " + ", ".join(pairs) + " }" if value else "{}"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_value(one, path, depth + 1) for one in value) + "]"
    raise TypeError(
        f"{path} is of the type {type(value).__name__}, but a sweep holds strings, numbers, booleans, lists and dicts"
    )


def _text(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise TypeError(f"a text of the sweep is no Unicode: {text[:40]!a}") from None
    return '"' + _ESCAPED.sub(lambda found: f"\\u{ord(found[0]):04x}", text) + '"'
