"""What the tests share: the repository, the program of the package, small sweeps."""

import csv
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]

# Six lines of the README, with fewer points.
FIRST = {
    "title": "Friction against belt velocity",
    "friction": {"law": "bilinear", "mu_d": 0.2},
    "axes": {
        "mu_s": {"from": 0.2, "to": 0.6, "points": 5},
        "belt_velocity": {"from": 0.3, "to": 6.3, "points": 7},
    },
    "response": {"settle": "auto"},
}

FIRST_TOML = """
title = "Friction against belt velocity"
friction.law = "bilinear"
friction.mu_d = 0.2
axes.mu_s = { from = 0.2, to = 0.6, points = 5 }
axes.belt_velocity = { from = 0.3, to = 6.3, points = 7 }
response.settle = "auto"
"""

# Minutes of work on a few cores.
LONG = {
    "friction": {"law": "exponential", "mu_d": 0.2, "stribeck_velocity": 0.5},
    "axes": {
        "mu_s": {"from": 0.2, "to": 0.6, "points": 400},
        "belt_velocity": {"from": 0.3, "to": 6.3, "points": 500},
    },
    "response": {"settle": "200 periods", "measure": "100 periods"},
}


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def program():
    """Runs the program of the package and gives what it ended with; the arguments, then the directory to run in."""
    beside = Path(sys.executable).with_name("squealmap")
    found = str(beside) if beside.exists() else shutil.which("squealmap")
    assert found, "the console script is not installed"

    def run(*arguments, cwd=None):
        words = [found, *map(str, arguments)]
        return subprocess.run(words, cwd=cwd, capture_output=True, text=True, timeout=300)

    run.path = found
    return run


@pytest.fixture(scope="session")
def first(tmp_path_factory, program):
    """The directory in which the program has computed the first map."""
    directory = tmp_path_factory.mktemp("first")
    (directory / "first.toml").write_text(FIRST_TOML)
    ended = program("run", "first.toml", "-o", "out", cwd=directory)
    assert ended.returncode == 0, ended.stderr
    return directory


def table(path):
    """The columns of a table as lists of strings."""
    with open(path, newline="") as file:
        header, *rows = csv.reader(line for line in file if not line.startswith("#"))
    return {name: [row[at] for row in rows] for at, name in enumerate(header)}


def number(cell):
    return float(cell) if cell else float("nan")


def document(path):
    return json.loads(Path(path).read_text())
