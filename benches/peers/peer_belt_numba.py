"""numba RK4 on the single mass as a user would write it: fixed step, contact state switched at step ends only."""
import numpy as np, numba as nb
import belt


@nb.njit
def instance(mu_s, mu_d, V, kick, dt, n_settle, n_meas):
    x, v = mu_d, kick
    stuck = False
    sg = 1.0 if V > v else -1.0
    x0, sx, sxx = mu_d, 0.0, 0.0
    h2 = 0.5*dt
    for i in range(n_settle + n_meas):
        if stuck:
            x += V*dt
            if abs(x) > mu_s:
                stuck = False
                sg = 1.0 if x > 0 else -1.0
        else:
            f = sg*mu_d
            a1 = f - x
            v2 = v + h2*a1; a2 = f - (x + h2*v)
            v3 = v + h2*a2; a3 = f - (x + h2*v2)
            v4 = v + dt*a3; a4 = f - (x + dt*v3)
            x += dt/6*(v + 2*v2 + 2*v3 + v4)
            v += dt/6*(a1 + 2*a2 + 2*a3 + a4)
            if (V - v)*sg <= 0.0:
                if abs(x) <= mu_s:
                    stuck = True
                    v = V
                else:
                    sg = 1.0 if x > 0 else -1.0
        if i >= n_settle:
            d = x - x0
            sx += d
            sxx += d*d
    q = sx/n_meas
    return np.sqrt(max(sxx/n_meas - q*q, 0.0))


@nb.njit
def all_of(p, dt, n_settle, n_meas):
    o = np.empty(len(p))
    for i in range(len(p)):
        o[i] = instance(p[i, 0], p[i, 1], p[i, 2], p[i, 3], dt, n_settle, n_meas)
    return o


def run(rows, steps):
    """std of x with so many steps per period"""
    return all_of(rows, belt.PERIOD/steps, belt.SETTLE*steps, belt.MEASURE*steps)
