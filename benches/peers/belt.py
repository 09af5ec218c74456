"""The single mass on a belt with hard mu_s/mu_d (m = k = N = 1, undamped): its exact solution, which judges the codes.

x'' = sigma mu_d - x in slip, x' = V in stick, which ends at |x| = mu_s. Slip is an arc of a circle in the phase plane
about sigma mu_d, so every event and every integral has a closed form. Once stuck the motion repeats: stick lasts
2 (mu_s - mu_d)/V, slip 2 (pi - atan((mu_s - mu_d)/V)), the amplitude is sqrt(V^2 + (mu_s - mu_d)^2)."""
import math
import numpy as np

KICK = 1.2                        # of V, so that the start slips backwards and the first stick is found, not given
PERIOD = 2*math.pi
SETTLE, MEASURE = 100, 40         # periods
SAMPLES = 24                      # of a period, for codes that sample


def belt_map(n=12, velocities=(0.05, 0.1, 0.2, 0.5)):
    """rows of mu_s in [0.3, 0.6], mu_d in [0.02, 0.25], V, start velocity; without mu_d the cycle touches the limit of stick from
    outside, x = -mu_s, and rounding decides whether it sticks there"""
    static, dynamic = np.linspace(0.3, 0.6, n), np.linspace(0.02, 0.25, n)
    return np.array([(a, b, V, KICK*V) for V in velocities for a in static for b in dynamic])


def pieces(mu_s, mu_d, V, kick, end):
    """the motion from the sliding equilibrium with x' = kick: (start, length, centre, amplitude, phase) of arcs
    x = centre + amplitude cos(t + phase), or (start, length, None, x at the start, V) of sticks"""
    t, x, v = 0.0, mu_d, kick
    stuck = abs(v - V) == 0.0
    sigma = 1.0 if v < V else -1.0
    while t < end:
        if stuck:
            length = (mu_s - x)/V
            yield t, length, None, x, V
            x, v, sigma, stuck = mu_s, V, 1.0, False
        else:
            centre = sigma*mu_d
            A, phase = math.hypot(x - centre, v), math.atan2(-v, x - centre)
            # x' = -A sin(t + phase) is V again: rising to it from sigma = 1, falling to it from sigma = -1.
            if V > A:
                yield t, math.inf, centre, A, phase
                return
            angle = math.pi + math.asin(V/A) if sigma > 0 else -math.asin(V/A)
            length = (angle - phase) % PERIOD
            yield t, length, centre, A, phase
            x, v = centre + A*math.cos(phase + length), V
            stuck = abs(x) <= mu_s
            sigma = 1.0 if x > 0 else -1.0
        t += length


def exact(row):
    """standard deviation of x over the window: by integrals, and of samples; and the period of the cycle"""
    mu_s, mu_d, V, kick = map(float, row)
    low, high = SETTLE*PERIOD, (SETTLE + MEASURE)*PERIOD
    grid = low + np.arange(MEASURE*SAMPLES + 1)*(PERIOD/SAMPLES)
    sampled = np.empty(len(grid))
    first = second = 0.0
    for start, length, centre, a, b in pieces(mu_s, mu_d, V, kick, high):
        inside = (grid >= start) & (grid <= start + length)
        s = grid[inside] - start
        sampled[inside] = a + b*s if centre is None else centre + a*np.cos(s + b)
        p, q = max(low, start) - start, min(high, start + length) - start
        if q <= p: continue
        if centre is None:
            first += a*(q - p) + b*(q*q - p*p)/2
            second += ((a + b*q)**3 - (a + b*p)**3)/(3*b)
        else:
            sine = math.sin(q + b) - math.sin(p + b)
            double = math.sin(2*(q + b)) - math.sin(2*(p + b))
            first += centre*(q - p) + a*sine
            second += centre*centre*(q - p) + 2*centre*a*sine + a*a*((q - p)/2 + double/4)
    T = high - low
    alpha = (mu_s - mu_d)/V
    return math.sqrt(second/T - (first/T)**2), sampled.std(), 2*alpha + 2*(math.pi - math.atan(alpha))
