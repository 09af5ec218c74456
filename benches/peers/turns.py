"""Codes in turn on one map: the best rate of several rounds, the errors, a Markdown table."""
import time
import numpy as np


def timed(run, rows):
    """the result of run(rows), and rows per CPU-second of this process"""
    began = time.process_time()
    std = run(rows)
    return std, len(rows)/(time.process_time() - began)


def table(cases, rounds, base):
    """cases: name -> (function that gives standard deviations and a rate, truth); ratios are to the case `base`"""
    best, errors = {}, {}
    for _ in range(rounds):
        for name, (run, truth) in cases.items():
            std, rate = run()
            errors[name] = 100.0*np.abs(std/truth - 1.0)
            best[name] = max(best.get(name, 0.0), rate)
    print("| code | instances per CPU-second | error of std x2, p50 / p99, % | over " + base + " |\n|---|---|---|---|")
    for name, rate in best.items():
        print("| %s | %.0f | %.1e / %.1e | %.1f |" % (name, rate, np.percentile(errors[name], 50), np.percentile(errors[name], 99), rate/best[base]))
