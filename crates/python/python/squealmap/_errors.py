"""Why there is no result."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, Union

if TYPE_CHECKING:
    import xarray

    from ._arrays import Arrays


class Error(Exception):
    """There is no result; the text is the sentence of the program."""

    def __init__(self, text: str) -> None:
        # A terminal would obey control characters.
        super().__init__("".join(ascii(c)[1:-1] if unicodedata.category(c) == "Cc" and c != "\n" else c for c in text))


class InputError(Error, ValueError):
    """What was handed over is refused: the sentence names the key, the value, the limit and what to do."""


class Interrupted(KeyboardInterrupt):
    """A sweep was stopped by Ctrl-C; ``dataset`` has what is done, the rest is ``not_computed``."""

    dataset: Union[xarray.Dataset, Arrays]

    def __init__(self, dataset: Union[xarray.Dataset, Arrays], done: int, total: int) -> None:
        super().__init__(
            f"stopped after {done} of {total} instances; what is done is in the attribute `dataset` of this exception"
        )
        self.dataset = dataset
        self._counts = done, total

    def __reduce__(self) -> tuple[type[Interrupted], tuple[Union[xarray.Dataset, Arrays], int, int]]:
        """So that a process can hand it to another."""
        return Interrupted, (self.dataset, *self._counts)
