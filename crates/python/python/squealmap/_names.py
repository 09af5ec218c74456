"""Codes as the names that they stand for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError

if TYPE_CHECKING:
    import xarray


def meanings(attributes: Mapping[str, Any]) -> dict[int, str]:
    """The names of codes, from the attributes of their array."""
    codes = np.atleast_1d(attributes["flag_values"]).tolist()
    return dict(zip(codes, attributes["flag_meanings"].split(" ")))


def whole(values: Any, said: Mapping[int, str], dtype: Any, what: str = "these values") -> NDArray[Any]:
    """Codes as whole numbers.

    Raises:
        InputError: for values that are none of them, such as a mean.
    """
    values = np.asarray(values)
    if values.dtype.kind not in "iub" and not np.isin(values, list(said)).all():
        raise InputError(f"{what} are no codes: names have no mean, and there is none where values are masked; select, or count them")
    found: NDArray[Any] = values.astype(dtype)
    return found


def decoded(values: NDArray[Any], attributes: Mapping[str, Any]) -> NDArray[np.str_]:
    """The names of codes; empty where they say that something is undefined."""
    if "flag_values" not in attributes:
        raise InputError("these values are no codes with names; their attribute `flag_values` is not there")
    said = meanings(attributes)
    lowest = min(said)
    words = [said.get(code, "") for code in range(lowest, max(said) + 1)]
    table = np.array(["" if word == "undefined" else word for word in words])
    found: NDArray[np.str_] = table[whole(values, said, np.int64) - lowest]
    return found


def names(variable: xarray.DataArray) -> xarray.DataArray:
    """The names in a variable of codes such as ``ds["type"]``; empty where undefined."""
    attributes = {key: value for key, value in variable.attrs.items() if not key.startswith("flag_")}
    return variable.copy(data=decoded(variable.values, variable.attrs)).assign_attrs(attributes)
