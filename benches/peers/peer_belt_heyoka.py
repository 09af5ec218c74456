"""heyoka on the single mass, batch mode: one blended right-hand side, one blended terminal event function, parameters
rewritten in place by a compiled callback (belt_transition.c)."""
import numpy as np, heyoka as hy
import belt, fast


class Engine:
    def __init__(self, tol, bs=8, **kw):
        x, v = hy.make_vars("x", "v")
        p = hy.par
        self.transition = fast.load("belt_transition")
        self.bs, self.L = bs, np.zeros((3, bs))
        event = hy.t_event_batch(p[2] + p[3]*x + p[4]*v, callback=self.transition.cb0, direction=hy.event_direction.negative, cooldown=1e-9)
        self.ta = hy.taylor_adaptive_batch([(x, v), (v, p[1] - p[0]*x)], np.zeros((2, bs)), pars=np.zeros((5, bs)), tol=tol, t_events=[event], **kw)

    def batch(self, rows):
        ta, bs = self.ta, self.bs
        padded = rows[np.minimum(np.arange(bs), len(rows) - 1)]
        self.L[:] = padded[:, [2, 0, 1]].T
        ta.state[:] = padded[:, [1, 3]].T
        self.transition.bind(ta.state.ctypes.data, ta.pars.ctypes.data, self.L.ctypes.data, bs)
        ta.set_time(0.0)
        ta.reset_cooldowns()
        ta.propagate_until(belt.SETTLE*belt.PERIOD)
        grid = (belt.SETTLE + np.arange(belt.MEASURE*belt.SAMPLES + 1)/belt.SAMPLES)*belt.PERIOD
        _, out = ta.propagate_grid(np.repeat(grid[:, None], bs, axis=1))
        return out[:, 0, :].std(axis=0)[:len(rows)]

    def run(self, rows):
        """std of x, from samples of the window"""
        return np.concatenate([self.batch(rows[k:k + self.bs]) for k in range(0, len(rows), self.bs)])
