"""Floquet multipliers of limit cycles by an independent code (see folds.py), beside those of a map with `settle = "cycle"`.

    squealmap run benches/peers/multipliers.toml -o out/multipliers
    python3 benches/peers/multipliers.py out/multipliers/map.csv

The model is Table 1 with theta = 0.01 and the bilinear law with its knee at 5 m/s; the axes of the map are mu_s, mu_d and belt_velocity.
From a state about as far out as the cycle of the map the return map (upward zeros of x2') is followed, then Newton's method finds
its fixed point; the Jacobian is that of central differences, in the five coordinates of the section where the body flies there,
else in three.
"""
import csv
import sys

import numpy as np

import folds

SCALE = np.array([1e-2, 1e-2, 1e-2, 1.0, 1.0])
RETURNS, STEPS, DIFFERENCE = 120, 12, 2e-6
# The section's coordinates in (x2, y2, y1, vx, vy, v1): in contact y2 and vy are zero.
COORDINATES = {"free": [0, 1, 2, 4, 5], "slip": [0, 2, 5]}


def back(state, contact, p):
    """One return: the state, how it is in contact, the time."""
    state, contact, time, _ = folds.advance(state, contact, p)
    return state, contact, time


def cycle(p, x2, y1, settling=RETURNS):
    """The multipliers of the cycle that these displacements settle to, and its period."""
    state, contact = np.array([x2, 0.0, y1, 0.0, 0.0, 0.0]), ("slip", 1.0, int(p["V"] >= folds.VK))
    for _ in range(settling):
        state, contact, _ = back(state, contact, p)
    free = COORDINATES[contact[0]]
    scale = SCALE[: len(free)] if len(free) == 5 else SCALE[[0, 2, 4]]

    def mapped(z):
        full = np.zeros(6)
        full[free] = z * scale
        end, same, time = back(full, contact, p)
        if same != contact:
            raise RuntimeError(f"the section changes from {contact} to {same}")
        return end[free] / scale, time

    z = state[free] / scale
    for _ in range(STEPS):
        columns = []
        for k in range(len(z)):
            step = np.zeros(len(z))
            step[k] = DIFFERENCE
            columns.append((mapped(z + step)[0] - mapped(z - step)[0]) / (2 * DIFFERENCE))
        jacobian = np.array(columns).T
        end, time = mapped(z)
        step = np.linalg.solve(np.eye(len(z)) - jacobian, end - z)
        z = z + step
        if np.abs(step).max() < 1e-10:
            return np.linalg.eigvals(jacobian), time
    raise RuntimeError("no cycle was found")


def main(path):
    worst = {"period": 0.0, "modulus": 0.0, "angle": 0.0}
    compared = elsewhere = failed = 0
    for row in csv.DictReader(open(path)):
        if row["found_by"] != "shooting" or row["cycle_returns"] != "1":
            continue
        p = {"mu_s": float(row["mu_s"]), "mu_d": float(row["mu_d"]), "V": float(row["belt_velocity"])}
        mean, deviation, y1 = (float(row[name]) for name in ("x2_mean", "x2_std", "y1_mean"))
        try:
            multipliers, period = cycle(p, mean - 2**0.5 * deviation, y1)
        except (RuntimeError, AssertionError, np.linalg.LinAlgError) as why:
            failed += 1
            print(p, "failed:", why, flush=True)
            continue
        largest = max(multipliers, key=abs)
        angle = abs(np.degrees(np.angle(largest)))
        print(p, f"{abs(largest):.12f} {angle:.9f} {period:.15f}", row["floquet"], row["floquet_angle"], row["period"], flush=True)
        if abs(period / float(row["period"]) - 1) > 1e-4:
            elsewhere += 1
            continue
        compared += 1
        worst["period"] = max(worst["period"], abs(period / float(row["period"]) - 1))
        worst["modulus"] = max(worst["modulus"], abs(abs(largest) - float(row["floquet"])))
        worst["angle"] = max(worst["angle"], abs(angle - abs(float(row["floquet_angle"]))))
    print(f"{compared} compared, {elsewhere} on another cycle, {failed} not found here; largest differences:", worst)


if __name__ == "__main__":
    main(sys.argv[1])
