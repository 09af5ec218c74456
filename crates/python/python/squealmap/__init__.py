"""Stability maps of friction-induced vibration.

When does a brake contact become unstable, by which mechanism, and what does it do then? A sweep is a dict, a sweep file or a
:class:`Sweep`; :func:`run` computes every combination of its values::

    import squealmap

    ds = squealmap.run("first.toml")
    ds.squealmap.plot()

Results are :class:`xarray.Dataset` where xarray is installed, else :class:`Arrays` of numpy. Units are SI, temperatures are in
degrees Celsius, and names are those of sweep files and of ``map.csv``. What is refused is an :class:`InputError` with the
sentence of the program.
"""

from __future__ import annotations

import importlib
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._api import fem as fem
    from ._api import fit as fit
    from ._api import identify as identify
    from ._api import linear as linear
    from ._api import modes as modes
    from ._refine import refine as refine
    from ._api import run as run
    from ._api import trace as trace
    from ._arrays import Arrays as Arrays
    from ._errors import Error as Error
    from ._errors import InputError as InputError
    from ._errors import Interrupted as Interrupted
    from ._figure import Figure as Figure
    from ._measured import Fit as Fit
    from ._measured import Identification as Identification
    from ._names import names as names
    from ._figure import plot as plot
    from ._open import open as open
    from ._sweep import Sweep as Sweep
    from ._squealmap import version as __version__

# Where each name is found, once it is asked for: the program of this package starts without numpy.
_PLACES = {
    "Arrays": "_arrays",
    "Error": "_errors",
    "Figure": "_figure",
    "Fit": "_measured",
    "Identification": "_measured",
    "InputError": "_errors",
    "Interrupted": "_errors",
    "Sweep": "_sweep",
    "fem": "_api",
    "fit": "_api",
    "identify": "_api",
    "linear": "_api",
    "modes": "_api",
    "names": "_names",
    "open": "_open",
    "plot": "_figure",
    "refine": "_refine",
    "run": "_api",
    "trace": "_api",
}

__all__ = sorted([*_PLACES, "__version__"])


def __getattr__(name: str) -> Any:
    if name == "__version__":
        return importlib.import_module("._squealmap", __name__).version
    try:
        module = importlib.import_module(f".{_PLACES[name]}", __name__)
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    return getattr(module, name)


def __dir__() -> list[str]:
    return __all__


# A program that has xarray already has `.squealmap` on every dataset, also on one that it read from a file.
if sys.modules.get("xarray") is not None:
    importlib.import_module("._accessor", __name__)
