"""What is found in measurements."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any, Union

from ._dataset import Dataset
from ._figure import Figure


@dataclass(frozen=True)
class Identification:
    """What measured signals say.

    Attributes:
        report: the content of ``identify.json``: segments with verdict, witnesses and confidence; SI units, phases in degrees.
        windows: a row for every window of ``windows.csv``.
        spectrogram: over ``time`` in s and ``frequency`` in Hz.
        figure: the figure of the program.
    """

    report: dict[str, Any]
    windows: Dataset
    spectrogram: Dataset
    figure: Figure

    @staticmethod
    def of(report: str, windows: Dataset, spectrogram: Dataset, svg: str) -> Identification:
        """Of what the compiled part gives."""
        return Identification(json.loads(report), windows, spectrogram, Figure(svg))

    @property
    def summary(self) -> str:
        """The verdict in one sentence."""
        return str(self.report["summary"])

    def __repr__(self) -> str:
        return f"<squealmap.Identification: {self.summary}>"

    def _repr_svg_(self) -> str:
        return self.figure.svg


@dataclass(frozen=True)
class Fit:
    """A material fitted to measured friction.

    Attributes:
        material: parameters of the law with their standard errors over ``temperature`` in degrees Celsius; of tables their rows.
        residuals: every point with what the law gives there.
        text: the material file.
        comparison: the laws beside each other, by their residuals and information criteria.
    """

    material: Dataset
    residuals: Dataset
    text: str
    comparison: str

    def write(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes the material file, which ``material`` in ``[friction]`` of a sweep names."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.text)

    def __repr__(self) -> str:
        return f"<squealmap.Fit\n{self.text}>"
