"""How far a sweep has come, by tqdm or anything with its interface."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable
from typing import Any, Protocol, Union


class Bar(Protocol):
    """What is asked of a bar of progress, which tqdm's has."""

    def update(self, n: int) -> Any:
        """Takes ``n`` more."""

    def close(self) -> Any:
        """Ends."""


Progress = Union[bool, None, Callable[..., Bar]]

# A sweep that is over sooner shows no bar, s.
_DELAY = 0.5


def _usual() -> Union[Callable[..., Bar], None]:
    try:
        make: Callable[..., Bar] = importlib.import_module("tqdm.auto").tqdm
    except ImportError:
        return None
    return make


def _is_watched() -> bool:
    """Whether anybody looks: a terminal, or a notebook."""
    open_one = sys.stderr is not None and not sys.stderr.closed
    return "ipykernel" in sys.modules or (open_one and sys.stderr.isatty())


class Shown:
    """A bar that begins when it is known how much there is to do."""

    def __init__(self, progress: Progress) -> None:
        usual = _usual() if progress is True or (progress is None and _is_watched()) else None
        self._make = progress if callable(progress) else usual
        self._keys: dict[str, Any] = {} if callable(progress) else {"delay": _DELAY}
        self._bar: Union[Bar, None] = None
        self._done = 0

    @property
    def wanted(self) -> Union[Callable[[int, int], None], None]:
        """What the compiled part calls, if anything."""
        return self._told if self._make is not None else None

    def _told(self, done: int, total: int) -> None:
        if self._bar is None and self._make is not None:
            self._bar = self._make(total=total, unit=" instances", **self._keys)
        # What refining asks for grows on the way.
        if getattr(self._bar, "total", total) != total:
            setattr(self._bar, "total", total)
        if self._bar is not None and done > self._done:
            self._bar.update(done - self._done)
            self._done = done

    def close(self) -> None:
        """Ends the bar, if there is one."""
        if self._bar is not None:
            self._bar.close()
