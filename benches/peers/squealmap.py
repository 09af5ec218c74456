"""The program on rows of instances: standard deviation of x2, and instances per second of one thread."""
import csv, json, os, re, subprocess, tempfile
import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "target", "release", "squealmap")

BRAKE = '[friction]\nlaw = "bilinear"\nknee_velocity = 5.0\n'
BELT = ('[friction]\nlaw = "constant"\n'
        '[model]\nm1 = 0.5\nm2 = 0.5\nk1 = 1.0\nk2 = 1.0\nc1 = 0.0\nc2 = 0.0\nf_ext = 1.0\ntheta = 0.0\n')

# Engines, scalars and steps per period.
STEPS = [("cpu", "f64", 12), ("cpu", "f64", 5), ("cpu", "f64", 4), ("cpu", "f64", 3), ("cpu", "f32", 12), ("cpu", "f32", 5),
         ("cpu", "f32", 4), ("cpu", "f32", 3), ("reference", "f64", 12)]


def run(rows, sections, backend, precision, steps):
    """rows of mu_s, mu_d, V, start velocity; `sections` of the sweep file say the rest"""
    with tempfile.TemporaryDirectory() as d:
        sweep(d, rows, sections, backend, precision, steps)
        with open(os.path.join(d, "out", "map.csv")) as f:
            table = list(csv.DictReader(f))
        with open(os.path.join(d, "out", "manifest.json")) as f:
            found = json.load(f)["computation"]["instances_per_second"]
        assert all(row["status"] == "ok" for row in table)
        return np.array([float(row["x2_std"]) for row in table]), found


def rate(rows, sections, backend, precision, steps):
    """instances per second alone, tiles written but no table and no figure of them"""
    with tempfile.TemporaryDirectory() as d:
        said = sweep(d, rows, sections, backend, precision, steps, "--shard", "0/1")
        count, seconds = re.match(r"(\d+) instances of shard 0/1 in ([\d.]+) s;", said).groups()
        assert int(count) == len(rows)
        return len(rows)/float(seconds)


def sweep(d, rows, sections, backend, precision, steps, *options):
    """computes rows into the folder `out` of `d`; what the program says"""
    with open(os.path.join(d, "points.csv"), "w") as f:
        f.write("mu_s,mu_d,belt_velocity,start_velocity\n")
        f.writelines("%r,%r,%r,%r\n" % tuple(map(float, row)) for row in rows)
    with open(os.path.join(d, "map.toml"), "w") as f:
        f.write('points = "points.csv"\n' + sections +
                '[response]\nsettle = "100 periods"\nmeasure = "40 periods"\nsteps_per_period = %d\n' % steps)
    return subprocess.run([PROGRAM, "run", "map.toml", "-o", "out", "--threads", "1", "--backend", backend, "--precision", precision,
                           "--no-check", *options], cwd=d, check=True, capture_output=True, text=True).stdout


def cases(scene, rows, many, truth):
    """the engines on rows for turns.table; rates of the CPU engine are those on many, because rows are done in no time"""
    cases = {}
    for backend, precision, steps in STEPS:
        def case(backend=backend, precision=precision, steps=steps):
            std, found = run(rows, scene, backend, precision, steps)
            if backend == "cpu": found = rate(many, scene, backend, precision, steps)
            return std, found
        cases["**squealmap** `%s` %s %d steps" % (backend, precision, steps)] = (case, truth)
    return cases
