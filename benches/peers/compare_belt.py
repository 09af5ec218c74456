"""squealmap, heyoka and numba on the single mass on a belt with hard mu_s/mu_d, in turn, one thread each; the exact
solution (belt.py) judges all of them.

    /tmp/peers/bin/python benches/peers/compare_belt.py [ROUNDS]

The map: 12 x 12 x 4 (mu_s in [0.3, 0.6], mu_d in [0.02, 0.25], V 0.05, 0.1, 0.2, 0.5), 100 + 40 periods. squealmap integrates
the whole model at theta = 0 with all observables, the peers the single mass alone. heyoka's samples are judged by the
same samples of the exact solution, the others by its integrals. Times of squealmap are taken on 400 x 400 x 4 instances, some two seconds of work."""
import sys
import numpy as np
import belt, squealmap, turns
import peer_belt_heyoka, peer_belt_numba

ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 3


def main():
    rows = belt.belt_map()
    many = belt.belt_map(400)
    exact = np.array([belt.exact(row) for row in rows])
    integrated, sampled = exact[:, 0], exact[:, 1]
    cases = {}
    for tolerance in (1e-9, 1e-6):
        engine = peer_belt_heyoka.Engine(tolerance, force_avx512=True)
        cases["heyoka %.0e" % tolerance] = (lambda engine=engine: turns.timed(engine.run, rows), sampled)
    peer_belt_numba.run(rows[:1], 30)          # compile
    for steps in (294, 30):
        run = lambda rows, steps=steps: peer_belt_numba.run(rows, steps)
        cases["numba RK4 %d steps" % steps] = (lambda run=run: turns.timed(run, rows), integrated)
    cases |= squealmap.cases(squealmap.BELT, rows, many, integrated)
    turns.table(cases, ROUNDS, "heyoka 1e-09")


if __name__ == "__main__":
    main()
