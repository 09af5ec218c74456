"""What is to compute a sweep."""

from __future__ import annotations

import logging
import os
import sys
from typing import Any, Union

from ._errors import InputError

# What the program says on standard error, such as which engine computes.
LOG = logging.getLogger("squealmap")


def engine_of(
    *,
    backend: str = "auto",
    precision: Union[str, None] = None,
    strict: bool = False,
    adapter: Union[str, None] = None,
    require_gpu: bool = False,
    threads: Union[int, None] = None,
    accuracy: Union[str, float, None] = None,
) -> dict[str, Any]:
    """The engine as the compiled part takes it.

    Raises:
        InputError: for a number of threads that cannot be.
        TypeError: for an accuracy that is neither a name nor a number.
    """
    # Numbers of numpy are numbers.
    if threads is not None and not isinstance(threads, bool) and hasattr(threads, "__index__"):
        threads = threads.__index__()
    if threads is not None and (isinstance(threads, bool) or not isinstance(threads, int) or not 0 < threads <= 1024):
        raise InputError(f"threads is {str(threads)[:40]} but must be a whole number from 1 to 1024")
    if accuracy is not None and hasattr(accuracy, "item"):
        accuracy = accuracy.item()
    if accuracy is not None and (isinstance(accuracy, bool) or not isinstance(accuracy, (str, int, float))):
        raise TypeError(f"accuracy is a name such as 'paper' or a number, not {type(accuracy).__name__}")
    # Mesa's layer that sorts devices says twice that there is no display; devices are sorted by the program.
    if sys.platform == "linux" and backend != "cpu" and not os.environ.get("XDG_RUNTIME_DIR", "").startswith("/"):
        os.environ.setdefault("NODEVICE_SELECT", "1")
    return {
        "backend": backend,
        "precision": precision,
        "strict": strict,
        "adapter": adapter,
        "require_gpu": require_gpu,
        "threads": threads,
        "accuracy": None if accuracy is None else str(accuracy)[:40],
    }
