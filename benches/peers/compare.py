"""squealmap and its peers on the same map, in turn, one thread each: errors, and instances per CPU-second. heyoka judges
the peers and must be there; numba, diffrax and Boost.odeint take part where they are installed.

    cargo build --release && python3 -m venv /tmp/peers && /tmp/peers/bin/pip install heyoka numba numpy diffrax jax
    sudo apt install libboost-dev
    /tmp/peers/bin/python benches/peers/compare.py [ROUNDS]

The map: 12 x 12 x 4 (mu_s, mu_d in [0, 0.6], V 0.5, 1, 3, 6 m/s), start at the equilibrium with x2' += 0.3 V,
100 + 40 periods. squealmap computes all observables of a map and the eigenvalues; the peers the standard deviation
of x2 of samples of the window, which differs from squealmap's integral over time by 0.06 %: each is judged by its own
kind, the peers by heyoka at 1e-12, squealmap by its reference. Times are CPU seconds of the computation, compile time of the
peers apart; those of squealmap are taken on 96 x 96 x 4 instances of the same map, some two seconds of work."""
import functools, importlib, subprocess, sys
import numpy as np
import model as m, squealmap, turns
from peer_heyoka import Engine

ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 3
SMALL, LARGE = 12, 96


def heyoka(engine, rows):
    return np.concatenate([engine.run(rows[k:k + engine.bs], 100, 40)[0] for k in range(0, len(rows), engine.bs)])


def installed(name):
    """a peer, or None and a line that says why not"""
    try:
        return importlib.import_module("peer_" + name)
    except ImportError as why:
        print("no %s: %s" % (name, why), file=sys.stderr)


def peers(rows):
    """name -> function that gives standard deviations and a rate"""
    cases = {}
    for tolerance in (1e-9, 1e-6):
        cases["heyoka %.0e" % tolerance] = functools.partial(turns.timed, functools.partial(heyoka, Engine(tolerance, force_avx512=True)), rows)
    if numba := installed("numba"):
        numba.nb.set_num_threads(1)
        numba.run(m.bench_map(2), 1e-3, 10, 10)          # compile
        for name, dt in (("1e-4 s", 1e-4), ("30 steps", numba.T0/30)):
            def run(dt=dt):
                std, seconds = numba.bench(rows, dt, rounds=1)
                return std, len(rows)/seconds
            cases["numba RK4 " + name] = run
    if diffrax := installed("diffrax"):
        for steps in (30, 60):
            solve = functools.partial(diffrax.run, steps=steps)
            solve(rows)          # compile
            cases["diffrax Tsit5 %d steps" % steps] = functools.partial(turns.timed, solve, rows)
    try:
        odeint = importlib.import_module("peer_odeint").Engine()
        for tolerance in (1e-6, 1e-7, 1e-9):
            cases["odeint dopri5 %.0e" % tolerance] = functools.partial(odeint.run, rows, tolerance)
    except (OSError, subprocess.CalledProcessError) as why:
        print("no odeint: %s" % why, file=sys.stderr)
    return cases


def main():
    rows, many = m.bench_map(SMALL), m.bench_map(LARGE)
    judge = heyoka(Engine(1e-12, force_avx512=True), rows)
    ours = squealmap.run(rows, squealmap.BRAKE, "reference", "f64", 24)[0]
    apart = 100.0*np.abs(ours/judge - 1.0)
    print("the judges are apart by %.1e / %.1e %% (p50 / p99)\n" % (np.percentile(apart, 50), np.percentile(apart, 99)))
    cases = {name: (run, judge) for name, run in peers(rows).items()}
    cases |= squealmap.cases(squealmap.BRAKE, rows, many, ours)
    turns.table(cases, ROUNDS, "heyoka 1e-09")


if __name__ == "__main__":
    main()
