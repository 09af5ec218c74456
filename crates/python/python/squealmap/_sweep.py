"""Sweeps: a file, a dict, or built call by call."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, field
from typing import Any, Union

from ._lines import lines
from ._points import columns_of, is_columns

SweepLike = Union["Sweep", Mapping[str, Any], str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Sweep:
    """A sweep built call by call: every call gives a new sweep with one more section or axis.

    The keys are those of a sweep file, in SI units; nothing is checked before the sweep is computed::

        sweep = (
            squealmap.Sweep("Friction against belt velocity")
            .friction(law="bilinear", mu_d=0.2)
            .axis("mu_s", start=0.2, stop=0.6, points=41)
            .axis("belt_velocity", [1.0, 3.0, 6.0])
            .response(settle="auto")
        )

    Args:
        title: what stands above figures.
        directory: what files that the sweep names are relative to; by default the working directory.
    """

    title: str = ""
    directory: Union[str, os.PathLike[str]] = "."
    keys: Mapping[str, Any] = field(default_factory=dict)

    def _with(self, section: str, keys: Mapping[str, Any]) -> Sweep:
        within = {**self.keys.get(section, {}), **keys}
        return Sweep(self.title, self.directory, {**self.keys, section: within})

    def analysis(self, *names: str) -> Sweep:
        """What is computed: ``"linear"`` (eigenvalues), ``"response"`` (the motion), or both."""
        return Sweep(self.title, self.directory, {**self.keys, "analysis": list(names)})

    def model(self, **keys: Any) -> Sweep:
        """Keys of ``[model]``: masses in kg, stiffnesses in N/m, dampings in N s/m, ``f_ext`` in N, ``theta`` in rad."""
        return self._with("model", keys)

    def friction(self, **keys: Any) -> Sweep:
        """Keys of ``[friction]``: ``law``, its parameters, ``material``, ``temperature`` in degrees Celsius."""
        return self._with("friction", keys)

    def belt(self, **keys: Any) -> Sweep:
        """Keys of ``[belt]``: ``belt_velocity`` in m/s, and a ramp."""
        return self._with("belt", keys)

    def start(self, **keys: Any) -> Sweep:
        """Keys of ``[start]``: ``kind``, and the size of the kick in m/s and m."""
        return self._with("start", keys)

    def response(self, **keys: Any) -> Sweep:
        """Keys of ``[response]``: ``settle``, ``measure``, ``steps_per_period``, ``check``."""
        return self._with("response", keys)

    def axis(
        self,
        name: str,
        values: Union[Iterable[Any], None] = None,
        *,
        start: Union[float, None] = None,
        stop: Union[float, None] = None,
        points: Union[int, None] = None,
        log: bool = False,
    ) -> Sweep:
        """An axis: its values, or ``points`` of them from ``start`` to ``stop``, both included.

        The first axis varies slowest.

        Args:
            name: a key of the sections above, ``law`` or ``material``.
            values: numbers in the SI unit of the key, or names.
            start, stop: its ends.
            points: how many values.
            log: whether the steps are equal ratios.
        """
        if values is not None:
            if isinstance(values, (str, bytes, Mapping, Set)) or not isinstance(values, Iterable):
                raise TypeError(f"the values of axis {name} are a list or an array, not {type(values).__name__}")
            values = values.tolist() if hasattr(values, "tolist") else list(values)
        given = {"values": values, "from": start, "to": stop, "points": points}
        axis = {key: value for key, value in given.items() if value is not None}
        return self._with("axes", {name: {**axis, "scale": "log"} if log else axis})

    def points(self, points: Union[str, os.PathLike[str], Mapping[str, Any], Any]) -> Sweep:
        """The instances one by one, instead of axes.

        Args:
            points: a CSV file, or columns: a dict of arrays by the names of keys, in SI units, or a table of pandas.
        """
        return Sweep(self.title, self.directory, {**self.keys, "points": points})

    def to_dict(self) -> dict[str, Any]:
        """The keys as :func:`squealmap.run` takes them."""
        return {**({"title": self.title} if self.title else {}), **self.keys}

    def __str__(self) -> str:
        """The text of a sweep file.

        Raises:
            TypeError: for points that are columns.
        """
        if is_columns(self.keys.get("points")):
            raise TypeError("a sweep file holds no columns of points: write them as CSV, and give `points` that file")
        return lines(self.to_dict())

    def write(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes a sweep file; files that it names are then relative to its directory."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(str(self))


def handed(sweep: SweepLike) -> dict[str, Any]:
    """A sweep as the compiled part takes it.

    Raises:
        TypeError: for something that is no sweep.
    """
    if isinstance(sweep, Sweep):
        return _of_keys(sweep.to_dict(), os.fspath(sweep.directory))
    if isinstance(sweep, Mapping):
        return _of_keys(sweep, ".")
    if isinstance(sweep, (str, os.PathLike)):
        return {"file": path_of(sweep), "lines": "", "points": None, "directory": "."}
    raise TypeError(
        f"a sweep is a dict, the path of a sweep file or a squealmap.Sweep, not of the type {type(sweep).__name__}"
    )


def _of_keys(keys: Mapping[str, Any], directory: str) -> dict[str, Any]:
    points = keys.get("points")
    if not is_columns(points):
        return {"file": None, "lines": lines(keys), "points": None, "directory": directory}
    rest = {key: value for key, value in keys.items() if key != "points"}
    return {"file": None, "lines": lines(rest), "points": columns_of(points), "directory": directory}


def path_of(path: Union[str, os.PathLike[str]]) -> str:
    """A path as a string.

    Raises:
        TypeError: for something that is no path.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"a path is needed, not {type(path).__name__}")
    return os.fsdecode(path)
