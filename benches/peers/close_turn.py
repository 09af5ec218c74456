"""squealmap against heyoka at 1e-9 on the map and on the single mass, in close turn, one thread each.

    /tmp/peers/bin/python benches/peers/close_turn.py [ROUNDS]

For machines whose clock changes within minutes: heyoka runs before and after each run of squealmap, the ratio is that to
the mean of both. Prints the median of the ratios and their quartiles; errors are those of compare.py and compare_belt.py."""
import sys
import numpy as np
import belt, model, squealmap, turns
import peer_belt_heyoka, peer_heyoka

ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 9
STEPS = [("f32", 3), ("f32", 4), ("f64", 3), ("f64", 4), ("f64", 12)]


def on_the_map():
    rows, engine = model.bench_map(12), peer_heyoka.Engine(1e-9, force_avx512=True)
    blocks = range(0, len(rows), engine.bs)
    run = lambda rows: np.concatenate([engine.run(rows[k:k + engine.bs], 100, 40)[0] for k in blocks])
    return (lambda: turns.timed(run, rows)[1]), squealmap.BRAKE, model.bench_map(96)


def on_the_belt():
    rows, engine = belt.belt_map(), peer_belt_heyoka.Engine(1e-9, force_avx512=True)
    return (lambda: turns.timed(engine.run, rows)[1]), squealmap.BELT, belt.belt_map(400)


def main():
    for name, (heyoka, scene, rows) in (("the map", on_the_map()), ("the single mass", on_the_belt())):
        print("\n| on %s | over heyoka 1e-09, median | quartiles |\n|---|---|---|" % name)
        ratios = {case: [] for case in STEPS}
        for _ in range(ROUNDS):
            for case in STEPS:
                before, rate = heyoka(), squealmap.rate(rows, scene, "cpu", *case)
                ratios[case].append(2.0*rate/(before + heyoka()))
        for (precision, steps), values in ratios.items():
            low, middle, high = np.percentile(values, [25, 50, 75])
            print("| `cpu` %s %d steps | %.1f | %.1f to %.1f |" % (precision, steps, middle, low, high))


if __name__ == "__main__":
    main()
