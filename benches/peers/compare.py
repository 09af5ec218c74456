"""squealmap, heyoka and numba on the same map, in turn, one thread each: errors first, then instances per CPU-second.

    cargo build --release && python3 -m venv /tmp/peers && /tmp/peers/bin/pip install heyoka numba numpy
    /tmp/peers/bin/python benches/peers/compare.py [ROUNDS]

The map: 12 x 12 x 4 (mu_s, mu_d in [0, 0.6], V 0.5, 1, 3, 6 m/s), start at the equilibrium with x2' += 0.3 V,
100 + 40 periods. squealmap computes all observables of a map and the eigenvalues; the peers the standard deviation
of x2 of samples of the window, which differs from squealmap's integral over time by 0.06 %: each is judged by its own
kind, the peers by heyoka at 1e-12, squealmap by its reference. Times are CPU seconds of the computation, compile time of the peers apart; those of squealmap are taken on
48 x 48 x 4 instances of the same map, because 576 are done in hundredths of a second."""
import csv, json, os, subprocess, sys, tempfile, time
import numpy as np
import model as m
from peer_heyoka import Engine
import peer_numba

ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 3
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.path.join(ROOT, "target", "release", "squealmap")
SMALL, LARGE = 12, 48


def squealmap(n, backend, precision, steps):
    """x2_std of the map in m, and instances per second of one thread."""
    with tempfile.TemporaryDirectory() as d:
        with open(os.path.join(d, "points.csv"), "w") as f:
            f.write("mu_s,mu_d,belt_velocity,start_velocity\n")
            f.writelines("%r,%r,%r,%r\n" % tuple(map(float, row)) for row in m.bench_map(n))
        with open(os.path.join(d, "map.toml"), "w") as f:
            f.write('points = "points.csv"\n[friction]\nlaw = "bilinear"\nknee_velocity = 5.0\n'
                    '[response]\nsettle = "100 periods"\nmeasure = "40 periods"\nsteps_per_period = %d\n' % steps)
        subprocess.run([PROGRAM, "run", "map.toml", "-o", "out", "--threads", "1", "--backend", backend, "--precision", precision],
                       cwd=d, check=True, capture_output=True)
        with open(os.path.join(d, "out", "map.csv")) as f:
            rows = list(csv.DictReader(f))
        with open(os.path.join(d, "out", "manifest.json")) as f:
            rate = json.load(f)["computation"]["instances_per_second"]
        assert all(row["status"] == "ok" for row in rows)
        return np.array([float(row["x2_std"]) for row in rows]), rate


def heyoka(engine):
    rows = m.bench_map(SMALL)
    std = np.empty(len(rows))
    began = time.process_time()
    for k in range(0, len(rows), engine.bs):
        std[k:k + engine.bs] = engine.run(rows[k:k + engine.bs], 100, 40)[0]
    return std, len(rows)/(time.process_time() - began)


def numba(dt):
    rows = m.bench_map(SMALL)
    std, seconds = peer_numba.bench(rows, dt, rounds=1)
    return std, len(rows)/seconds


def main():
    judge = heyoka(Engine(1e-12, force_avx512=True))[0]
    peer_numba.nb.set_num_threads(1)
    peer_numba.run(m.bench_map(2), 1e-3, 10, 10)
    tight, loose = Engine(1e-9, force_avx512=True), Engine(1e-6, force_avx512=True)
    cases = [("heyoka 1e-9", lambda: heyoka(tight)), ("heyoka 1e-6", lambda: heyoka(loose)),
             ("numba RK4 1e-4 s", lambda: numba(1e-4)), ("numba RK4 30 steps", lambda: numba(peer_numba.T0/30))]
    ours = [("cpu", "f64", 12), ("cpu", "f64", 5), ("cpu", "f32", 12), ("cpu", "f32", 5), ("cpu", "f32", 4),
            ("reference", "f64", 12)]
    best, errors = {}, {}
    judges = {"squealmap": squealmap(SMALL, "reference", "f64", 24)[0]}
    apart = 100.0*np.abs(judges["squealmap"]/judge - 1.0)
    print("the judges are apart by %.1e / %.1e %% (p50 / p99)\n" % (np.percentile(apart, 50), np.percentile(apart, 99)))
    for backend, precision, steps in ours:
        std, _ = squealmap(SMALL, backend, precision, steps)
        errors["squealmap %s %s %d steps" % (backend, precision, steps)] = std
    for _ in range(ROUNDS):
        for name, run in cases:
            errors[name], rate = run()
            best[name] = max(best.get(name, 0.0), rate)
        for backend, precision, steps in ours:
            name = "squealmap %s %s %d steps" % (backend, precision, steps)
            best[name] = max(best.get(name, 0.0), squealmap(LARGE if backend == "cpu" else SMALL, backend, precision, steps)[1])
    print("| code | instances per CPU-second | error of std x2, p50 / p99, % | over heyoka 1e-9 |\n|---|---|---|---|")
    for name, rate in best.items():
        error = 100.0*np.abs(errors[name]/judges.get(name.split()[0], judge) - 1.0)
        print("| %s | %.0f | %.1e / %.1e | %.1f |" % (name, rate, np.percentile(error, 50), np.percentile(error, 99), rate/best["heyoka 1e-9"]))


if __name__ == "__main__":
    main()
