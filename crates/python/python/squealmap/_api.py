"""What is computed."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Union

from . import _squealmap
from ._dataset import Dataset, dataset, calling
from ._engine import LOG, engine_of
from ._errors import InputError, Interrupted
from ._measured import Fit, Identification
from ._progress import Progress, Shown
from ._sweep import SweepLike, handed, path_of

if TYPE_CHECKING:
    Path = Union[str, os.PathLike[str]]

__all__ = ["fem", "fit", "identify", "linear", "modes", "run", "trace"]


def run(
    sweep: SweepLike,
    *,
    backend: str = "auto",
    precision: Union[str, None] = None,
    strict: bool = False,
    adapter: Union[str, None] = None,
    require_gpu: bool = False,
    threads: Union[int, None] = None,
    accuracy: Union[str, float, None] = None,
    check: bool = True,
    progress: Progress = None,
) -> Dataset:
    """Computes every instance of a sweep: its eigenvalues and what its motion becomes.

    Args:
        sweep: a dict with the keys of a sweep file, its path, or a :class:`Sweep`. Files that a dict names are relative to the
            working directory, those of a file to its directory. ``points`` of a dict may be columns instead of a file: arrays
            by the names of keys, one instance a row.
        backend: ``"auto"`` (a hardware GPU where there is one, else the CPU), ``"gpu"``, ``"cpu"`` or ``"reference"``.
        precision: ``"f64"`` or ``"f32"``; by default f64 on the CPU and f32 on a GPU.
        strict: a GPU rounds every operation by itself.
        adapter: only a GPU with this in its name.
        require_gpu: fail unless a hardware GPU computes.
        threads: worker threads, 1 to 1024; by default one per core.
        accuracy: what to choose engine, precision and steps for: ``"draft"`` (a relative error of 1e-2 in 95 % of the settled
            oscillations), ``"standard"`` (1e-3), ``"paper"`` (1e-4), ``"reference"``, or a number up to 0.1. The manifest says
            what was chosen, and why.
        check: whether a few instances are computed again to measure the error of the others.
        progress: True for a bar of tqdm, False for none, or anything that makes one; by default in a terminal or notebook.

    Returns:
        Arrays over the axes of the sweep, in SI units: the columns of ``map.csv``. ``type``, ``regime``, ``status`` and ``settled``
        are codes with ``flag_meanings``. ``attrs["manifest"]`` is the program's ``manifest.json``.

    Raises:
        InputError: the sweep is refused.
        Error: it cannot be computed.
        Interrupted: Ctrl-C; what is done is in its ``dataset``.
    """
    engine = engine_of(
        backend=backend,
        precision=precision,
        strict=strict,
        adapter=adapter,
        require_gpu=require_gpu,
        threads=threads,
        accuracy=accuracy,
    )
    return _run(sweep, engine, False, check, progress)


def linear(sweep: SweepLike, *, threads: Union[int, None] = None, progress: Progress = None) -> Dataset:
    """Computes the eigenvalues of every instance alone: type, growth rate in 1/s, frequency in Hz.

    Args, Returns, Raises: as :func:`run`.
    """
    engine = engine_of(backend="cpu", threads=threads)
    return _run(sweep, engine, True, True, progress)


def modes(sweep: SweepLike) -> Dataset:
    """Follows every mode along the first numeric axis of a sweep.

    Returns:
        ``frequency`` in Hz, ``growth_rate`` and ``growth_rate_fast`` in 1/s over the axes and ``mode``; ``critical``, where the
        largest growth rate changes sign, in the unit of the axis.

    Raises:
        InputError: the sweep is refused, or has no axis of numbers.
    """
    with calling():
        found = _squealmap.modes(handed(sweep))
    return dataset(found)


def trace(
    sweep: SweepLike,
    at: Union[Mapping[str, Any], str, None] = None,
    *,
    instance: Union[int, None] = None,
    samples_per_period: int = 50,
) -> Dataset:
    """Follows one instance in time.

    Args:
        sweep: as of :func:`run`.
        at: every parameter that the sweep varies, and any other, such as ``{"mu_s": 0.3, "belt_velocity": 1}``; values may lie off
            the grid.
        instance: or the instance by its number in ``map.csv``.
        samples_per_period: rows per period, 1 to 10000, besides the events.

    Returns:
        Displacements in m, velocities in m/s, accelerations in m/s2, forces in N and the state of the contact over ``t`` in s. An
        event has two rows. ``attrs["status"]`` says how the instance ended.

    Raises:
        InputError: the sweep or the instance is refused.
        Error: the instance has no motion; the sentence says why.
    """
    if instance is not None and at is not None:
        raise InputError("`at` and `instance` both choose the instance; leave one of them out")
    if instance is not None and (isinstance(instance, bool) or not hasattr(instance, "__index__")):
        raise TypeError(f"instance is a number, not {type(instance).__name__}")
    pairs = ",".join(f"{key}={_said(value)}" for key, value in at.items()) if isinstance(at, Mapping) else at
    if pairs is not None and not isinstance(pairs, str):
        raise TypeError(f"at is a dict or a string such as 'mu_s=0.3,belt_velocity=1', not {type(at).__name__}")
    number = None if instance is None else instance.__index__()
    if number is not None and not 0 <= number < 2**63:
        raise InputError(f"instance is {str(number)[:40]} but must be a number from 0 on")
    if isinstance(samples_per_period, bool) or not hasattr(samples_per_period, "__index__"):
        raise TypeError(f"samples_per_period is a whole number, not {type(samples_per_period).__name__}")
    samples_per_period = samples_per_period.__index__()
    if not 0 < samples_per_period < 2**32:
        raise InputError(f"samples_per_period is {str(samples_per_period)[:40]} but must be from 1 to 10000")
    with calling():
        found = _squealmap.trace(handed(sweep), pairs or "", number, samples_per_period)
    return dataset(found)


def identify(
    signals: Path,
    *,
    time: Union[str, None] = None,
    time_unit: Union[str, None] = None,
    rate: Union[float, None] = None,
    tangential_acceleration: Union[str, None] = None,
    normal_acceleration: Union[str, None] = None,
    tangential_force: Union[str, None] = None,
    normal_force: Union[str, None] = None,
    velocity: Union[str, None] = None,
    temperature: Union[str, None] = None,
    skew: Union[float, None] = None,
    force_skew: Union[float, None] = None,
    damping_ratio: Union[float, None] = None,
    inclination: Union[float, None] = None,
    band: Union[tuple[float, float], None] = None,
    window: Union[float, None] = None,
    overlap: Union[float, None] = None,
    largest_friction: Union[float, None] = None,
    critical_friction: Union[float, tuple[float, float], None] = None,
    model: Union[Path, None] = None,
) -> Identification:
    """Says what measured signals say: is there an instability, and which mechanism causes it?

    Args:
        signals: a CSV file with a header, or a WAV, MAT (``-v7``), UFF 58 or TDMS file.
        time, tangential_acceleration, normal_acceleration, tangential_force, normal_force, velocity, temperature: its columns; in s,
            m/s2, N, m/s and degrees Celsius. By default t, ax2, ay1, T, N, V and temperature.
        time_unit: s, ms, us, ns, min or h.
        rate: samples per second in Hz, instead of a column of time.
        skew, force_skew: delays of the normal acceleration and of the forces behind the tangential acceleration, s.
        damping_ratio: largest damping ratio that the structure may have without friction.
        inclination: its largest inclination to the contact, rad.
        band: frequencies in which to look for the oscillation, Hz.
        window, overlap: windows of the spectrogram, s, and how far they overlap, below 1.
        largest_friction: largest T/N that is believed.
        critical_friction: friction at which the modes coalesce, and its standard error.
        model: a sweep file of the rig. Forces that slow sensors do not show are taken from the accelerations then; damping, inclination
            and coalescence are those of the rig where they are not given.

    Raises:
        InputError: the file is not fit for that.
    """
    critical = critical_friction
    if critical is not None and not isinstance(critical, (tuple, list)):
        critical = (critical, critical / 30.0)
    columns = {
        "tangential_acceleration": tangential_acceleration,
        "normal_acceleration": normal_acceleration,
        "tangential_force": tangential_force,
        "normal_force": normal_force,
        "velocity": velocity,
        "temperature": temperature,
    }
    for name, column in columns.items():
        if column is not None and not isinstance(column, str):
            raise TypeError(f"{name} is the name of a column, not {type(column).__name__}")
    choices = {
        "time": time,
        "time_unit": time_unit,
        "rate": rate,
        "columns": list(columns.values()),
        "skew": skew,
        "force_skew": force_skew,
        "damping_ratio": damping_ratio,
        "inclination": inclination,
        "band": band,
        "window": window,
        "overlap": overlap,
        "largest_friction": largest_friction,
        "critical_friction": critical,
        "model": None if model is None else path_of(model),
    }
    with calling():
        report, windows, spectrogram, svg = _squealmap.identify(path_of(signals), choices)
    return Identification.of(report, dataset(windows), dataset(spectrogram), svg)


def fit(
    points: Union[Path, Sequence[Path]],
    *,
    law: str = "bilinear",
    law_velocity: Union[float, None] = None,
    friction: Union[str, None] = None,
    tangential_force: Union[str, None] = None,
    normal_force: Union[str, None] = None,
    tangential_acceleration: Union[str, None] = None,
    rate: Union[float, None] = None,
    velocity: Union[str, None] = None,
    temperature: Union[str, None] = None,
    at_temperature: Union[float, Sequence[float], None] = None,
    temperatures: Sequence[float] = (),
) -> Fit:
    """Fits a material for sweeps to measured velocity, friction and temperature.

    Args:
        points: a CSV file with a header, or a WAV, MAT (``-v7``), UFF 58 or TDMS file; several of them make one material.
        law: ``"bilinear"``, ``"exponential"``, ``"constant"``, ``"table"`` (means of friction in bins of velocity) or ``"best"``,
            the law with the least AICc.
        law_velocity: knee or Stribeck velocity, m/s; left out, the best one is found.
        friction: column of the friction coefficient; by default the ratio of the forces.
        tangential_force, normal_force, tangential_acceleration, velocity, temperature: columns, in N, m/s2, m/s and degrees Celsius.
        rate: samples per second of a record that may squeal, Hz.
        at_temperature: the temperature of all points, degrees Celsius, instead of a column; or one for each file.
        temperatures: temperatures of the rows, degrees Celsius, rising.

    Raises:
        InputError: the points do not determine the material.
    """
    if isinstance(temperatures, (str, bytes)) or not isinstance(temperatures, Iterable):
        raise TypeError(f"temperatures is a list of numbers, not {type(temperatures).__name__}")
    files: list[Any] = list(points) if isinstance(points, (list, tuple)) else [points]
    if not files:
        raise TypeError("points is a path or a list of paths, not an empty list")
    choices = {
        "law": law,
        "law_velocity": law_velocity,
        "friction": friction,
        "tangential_force": tangential_force,
        "normal_force": normal_force,
        "tangential_acceleration": tangential_acceleration,
        "rate": rate,
        "velocity": velocity,
        "temperature": temperature,
        "at_temperature": _listed(at_temperature),
        "temperatures": list(temperatures),
    }
    with calling():
        material, residuals, text, comparison, notes = _squealmap.fit([path_of(file) for file in files], choices)
    _warn(notes)
    return Fit(dataset(material), dataset(residuals), text, comparison)


def fem(study: Path) -> Dataset:
    """Computes the modes of bodies in sliding contact over friction, by finite elements.

    Args:
        study: a description of the bodies (TOML).

    Returns:
        ``frequency`` in Hz, ``growth_rate`` in 1/s and what else ``fem.csv`` has, over ``mu`` and ``mode``.

    Raises:
        InputError: the description is refused.
    """
    with calling():
        found = _squealmap.fem(path_of(study))
    return dataset(found)


def _listed(value: Any) -> list[Any]:
    if value is None:
        return []
    return list(value) if isinstance(value, (list, tuple)) else [value]


def _said(value: Any) -> str:
    value = value.item() if hasattr(value, "item") else value
    return repr(value) if isinstance(value, float) else str(value)


def _run(sweep: SweepLike, engine: dict[str, Any], only: bool, check: bool, progress: Progress) -> Dataset:
    shown = Shown(progress)
    try:
        with calling():
            found, notes, told, raised = _squealmap.run(handed(sweep), engine, only, check, shown.wanted)
    finally:
        shown.close()
    _warn(notes)
    for note in told:
        LOG.info(note)
    made = dataset(found)
    if isinstance(raised, KeyboardInterrupt):
        manifest = _manifest(made)["computation"]
        raise Interrupted(made, manifest["computed"], manifest["instances"]) from None
    if raised is not None:
        raise raised
    stopped = _manifest(made)["computation"]["stopped"] if "complete" in made.attrs else None
    if stopped:
        _warn([f"the sweep is not complete: {stopped}; what was not computed is `not_computed`"])
    return made


def _manifest(made: Dataset) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(made.attrs["manifest"])
    return found


def _warn(notes: Sequence[str]) -> None:
    for note in notes:
        warnings.warn(note, UserWarning, stacklevel=4)
