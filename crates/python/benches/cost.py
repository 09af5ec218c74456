"""What Python costs beside the program: time and peak memory of both, each in a process of its own.

    python crates/python/benches/cost.py PROGRAM

PROGRAM is the program as cargo builds it. Writes benches/results/python.csv.
"""

import csv
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import squealmap

ROOT = Path(__file__).resolve().parents[3]

FEW = """
friction.law = "bilinear"
friction.mu_d = 0.2
axes.mu_s = { from = 0.2, to = 0.6, points = 5 }
axes.belt_velocity = { from = 0.3, to = 6.3, points = 7 }
response = { settle = "2 periods", measure = "4 periods" }
"""
GRID = """
friction.law = "exponential"
friction.stribeck_velocity = 0.5
axes.mu_s = { from = 0.2, to = 0.6, points = 100 }
axes.mu_d = { from = 0.2, to = 0.6, points = 100 }
axes.belt_velocity = { from = 0.3, to = 6.3, points = 100 }
"""
# Each with how often: of few instances there is nothing but what every call costs, which shows through other work on the
# machine where it is measured often.
SWEEPS = {
    "35 short transients": (FEW, 12),
    "1e6 eigenvalues": ('analysis = ["linear"]\n' + GRID, 2),
    "1e6 short transients": (GRID + 'response = { settle = "2 periods", measure = "4 periods" }\n', 1),
    "the map of the README": ((ROOT / "sweeps/paper_map.toml").read_text(), 1),
}

PYTHON = "import squealmap; ds = squealmap.run('sweep.toml', progress=False); assert ds.sizes"
NUMPY = "import sys; sys.modules['xarray'] = None; " + PYTHON


def measured(words, directory):
    """Wall time and processor time in s, and peak memory in MB, of a command. Other work on a machine changes only the first."""
    began = time.monotonic()
    process = subprocess.Popen(words, cwd=directory, stdout=subprocess.DEVNULL)
    _, code, usage = os.wait4(process.pid, 0)
    took = time.monotonic() - began
    assert code == 0, words
    return took, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    program = sys.argv[1]
    rows = []
    for name, (text, rounds) in SWEEPS.items():
        best = {}
        for _ in range(rounds):
            for by, words in [
                ("program", [program, "run", "sweep.toml", "-o", "out", "--quiet", "--force"]),
                ("python", [sys.executable, "-c", PYTHON]),
                ("python without xarray", [sys.executable, "-c", NUMPY]),
            ]:
                with tempfile.TemporaryDirectory() as directory:
                    Path(directory, "sweep.toml").write_text(text)
                    found = measured(words, directory)
                best[by] = tuple(map(min, found, best.get(by, found)))
        for by, (took, busy, memory) in best.items():
            rows.append([name, by, f"{took:.2f}", f"{busy:.2f}", f"{memory:.0f}"])
            print(*rows[-1], sep="\t", flush=True)
    cores = os.cpu_count()
    machine = f"{platform.machine()}, {cores} cores, Python {platform.python_version()}, squealmap {squealmap.__version__}"
    with open(ROOT / "benches/results/python.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["sweep", "by", "wall_seconds", "processor_seconds", "peak_mb", "machine"])
        writer.writerows([*row, machine] for row in rows)


main()
