"""The period doublings of Table 1 at mu_s = 0.5, mu_d = 0.3 (bilinear law) over the belt velocity, by an independent code (see folds.py
and multipliers.py): where the multiplier of the cycle of one return is -1, by secants from outside the band, where that is stable.

    python3 doubling.py 0.43 0.42      from above
    python3 doubling.py 0.20 0.207     from below
"""
import sys

import multipliers

# As far out as a cycle at 0.43 m/s, in proportion to the belt velocity.
X2 = 0.0052


def beyond(velocity):
    """The multiplier that is nearest to -1, plus 1, of the cycle at a belt velocity."""
    p = {"mu_s": 0.5, "mu_d": 0.3, "V": velocity}
    found, period = multipliers.cycle(p, 0.0048 - X2 * velocity / 0.43 * 0.6, 0.0, settling=400)
    nearest = min(found, key=lambda one: abs(one + 1))
    print(f"V = {velocity:.12f}: {nearest:.12f}, period {period:.12f}", flush=True)
    return nearest.real + 1


def main(first, second):
    ends = [(velocity, beyond(velocity)) for velocity in (first, second)]
    while abs(ends[1][0] - ends[0][0]) > 1e-10:
        (a, f), (b, g) = ends
        there = b - g * (b - a) / (g - f)
        ends = [ends[1], (there, beyond(there))]


if __name__ == "__main__":
    main(float(sys.argv[1]), float(sys.argv[2]))
