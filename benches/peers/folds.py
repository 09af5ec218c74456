"""Folds of limit cycles of the two-mass belt model by an independent code: scipy's DOP853 between located events, the equations of
docs/physics.md in SI units, a fixed point of the return map (upward zeros of x2') for each x2 on it, and the extremum of the parameter.

    python3 folds.py up 3       the fold over mu_d that ends the rising branch at mu_s = 0.6, V = 3 m/s (Table 1, bilinear law)
    python3 folds.py down 3     the one that ends the falling branch; both also at V = 4
"""
import sys
import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

M1, M2, K1, K2, C1, C2, F, TH, VK = 2.12, 0.18, 1e5, 1.01e5, 0.1, 0.1, 1000.0, 0.01, 5.0
S, C = np.sin(TH), np.cos(TH)
KW = dict(method="DOP853", rtol=3e-14, atol=1e-16, dense_output=False)


def mu(v, p):
    a = abs(v)
    return p["mu_d"] if a >= VK else p["mu_s"] + (p["mu_d"] - p["mu_s"]) * a / VK


def springs(x2, y2, y1, vx, vy, v1):
    g = K1 * (x2 * C - y2 * S) + C1 * (vx * C - vy * S)
    h = K2 * (x2 * S + y2 * C - y1) + C2 * (vx * S + vy * C - v1)
    return g, h


def accel(state, kind, sigma, piece, p):
    """(ax, ay, a1), T, N"""
    x2, y2, y1, vx, vy, v1 = state
    g, h = springs(x2, y2, y1, vx, vy, v1)
    a1 = (h - F) / M1
    if kind == "free":
        A = np.array([[M2 + M1 * C * C, -M1 * S * C], [-M1 * S * C, M2 + M1 * S * S]])
        ax, ay = np.linalg.solve(A, [-C * g - S * h, S * g - C * h])
        return (ax, ay, a1), 0.0, 0.0
    if kind == "stick":
        T = C * g + S * h
        return (0.0, 0.0, a1), T, C * h - S * g
    v = sigma * (p["V"] - vx)
    m = p["mu_d"] if piece else p["mu_s"] + (p["mu_d"] - p["mu_s"]) * v / VK
    # (m2 + m1 c^2) ax + c g + s h = sigma m N,  N = c h - s (m1 c ax + g)
    ax = (sigma * m * (C * h - S * g) - C * g - S * h) / (M2 + M1 * C * C + sigma * m * M1 * C * S)
    N = C * h - S * (M1 * C * ax + g)
    return (ax, 0.0, a1), sigma * m * N, N


def at_rest(state, p):
    (_, _, _), T, N = accel(state, "stick", 1, 0, p)
    if abs(T) <= p["mu_s"] * N:
        return "stick", 1, 0
    sigma = np.sign(T)
    _, _, N = accel(state, "slip", sigma, 0, p)
    return ("slip", sigma, 0) if N > 0 else ("free", 1, 0)


def impact(state, p):
    x2, _, y1, vx, vy, v1 = state
    A = np.array([[M2 + M1 * C * C, -M1 * S * C], [-M1 * S * C, M2 + M1 * S * S]])
    v = p["V"] - vx
    sg, m = np.sign(v), mu(v, p)
    # e = 0: dvy = -vy
    d = np.linalg.solve(np.array([[A[0, 0], -sg * m], [A[1, 0], -1.0]]), [-A[0, 1] * (-vy), -A[1, 1] * (-vy)])
    dvx, Pn = d
    if (v - dvx) * v < 0:
        dvx = v
        Pt, Pn = A @ np.array([v, -vy])
        assert abs(Pt) <= m * Pn
    new = np.array([x2, 0.0, y1, vx + dvx, 0.0, v1])
    v = p["V"] - new[3]
    if abs(v) < 1e-13:
        new[3] = p["V"]
        return new, at_rest(new, p)
    contact = ("slip", np.sign(v), int(abs(v) >= VK))
    _, _, N = accel(new, *contact, p)
    return new, (contact if N > 0 else ("free", 1, 0))


def advance(state, contact, p, stop_rise=True, t_end=1.0):
    """To the next upward zero of x2', from one."""
    t = 0.0
    state = np.array(state, float)
    fresh_rest = True
    events_seen = []
    while t < t_end:
        kind, sigma, piece = contact
        def f(_, s):
            a, _, _ = accel(s, kind, sigma, piece, p)
            return [s[3], s[4], s[5], *a]
        if fresh_rest:
            # Out of the event itself, which no event is next to.
            r = solve_ivp(f, (t, t + 1e-6), state, **KW)
            t, state, fresh_rest = r.t[-1], r.y[:, -1], False
        def rise(_, s): return s[3]
        rise.terminal, rise.direction = stop_rise, 1
        evs, names = [rise], ["rise"]
        if kind == "slip":
            def lift(_, s): return accel(s, kind, sigma, piece, p)[2]
            def rest(_, s): return sigma * (p["V"] - s[3])
            def knee(_, s): return VK - sigma * (p["V"] - s[3])
            lift.terminal, lift.direction = True, -1
            rest.terminal, rest.direction = True, -1
            knee.terminal, knee.direction = True, (-1 if piece == 0 else 1)
            evs += [lift, rest, knee]; names += ["lift", "rest", "knee"]
        elif kind == "stick":
            def cone(_, s):
                _, T, N = accel(s, kind, 1, 0, p); return p["mu_s"] * N - abs(T)
            def lift(_, s): return accel(s, kind, 1, 0, p)[2]
            cone.terminal, cone.direction = True, -1
            lift.terminal, lift.direction = True, -1
            evs += [cone, lift]; names += ["cone", "lift"]
        else:
            def gap(_, s): return s[1]
            gap.terminal, gap.direction = True, -1
            evs += [gap]; names += ["gap"]
        h = 2e-3 if kind != "free" else 5e-4
        r = solve_ivp(f, (t, t + 0.2), state, events=evs, max_step=h, first_step=1e-5, **KW)
        hit = [(te[-1], n, ye[-1]) for te, n, ye in zip(r.t_events, names, r.y_events) if len(te) and te[-1] > t + 1e-9]
        t0 = t
        if r.status != 1:
            t, state = r.t[-1], r.y[:, -1]
            continue
        te, name, ye = min(hit, key=lambda x: abs(x[0] - r.t[-1]))
        t, state, fresh_rest = te, ye.copy(), True
        events_seen.append(name)
        if name == "rise":
            state[3] = 0.0
            return state, contact, t, events_seen
        if name == "lift":
            contact = ("free", 1, 0)
        elif name == "rest":
            state[3] = p["V"]; contact = at_rest(state, p)
        elif name == "knee":
            contact = ("slip", sigma, 1 - piece)
        elif name == "cone":
            _, T, _ = accel(state, "stick", 1, 0, p)
            contact = ("slip", np.sign(T), 0)
        elif name == "gap":
            state, contact = impact(state, p)
    raise RuntimeError("no return")


def section(z, contact, p):
    s = np.array([z[0], 0.0, z[1], 0.0, 0.0, z[2]])
    e, c, t, ev = advance(s, contact, p)
    assert c == contact, (c, contact)
    return np.array([e[0], e[2], e[5]]), ev


def fold(mu_d0, direction, V, contact=("slip", 1.0, 0)):
    p = dict(mu_s=0.6, mu_d=mu_d0, V=V)
    # settle onto the stable cycle, and take it along to the value next to the fold
    z = np.array([0.0, -0.0099, 0.0]) + np.array([-0.012, 0, 0])
    for value in np.linspace(FROM[direction], mu_d0, 12):
        p["mu_d"] = value
        for _ in range(60):
            z, ev = section(z, contact, p)
        print(value, z, ev, flush=True)
    scale = np.array([1e-2, 1e-2, 1.0])
    def solve(x0, guess):
        def g(u):
            q = dict(p, mu_d=u[2])
            zz = np.array([x0, u[0] * 1e-2, u[1]])
            e, _ = section(zz, contact, q)
            return (e - zz) / scale
        u, info, ier, msg = fsolve(g, guess, xtol=1e-13, epsfcn=1e-12, full_output=True)
        return u, np.abs(info["fvec"]).max()
    u = np.array([z[1] / 1e-2, z[2], mu_d0])
    u, r = solve(z[0], u)
    print("cycle", u, r, flush=True)
    pts = [(z[0], u[2], u)]
    # walk in x0 until mu_d turns
    dx = STEP[direction]
    x0 = z[0]
    while True:
        x0 += dx
        guess = u if len(pts) < 2 else 2 * pts[-1][2] - pts[-2][2]
        u, r = solve(x0, guess)
        pts.append((x0, u[2], u))
        print(x0, u[2], r, flush=True)
        if len(pts) >= 4 and (pts[-1][1] - pts[-2][1]) * (pts[-2][1] - pts[-3][1]) < 0:
            break
    # refine about the extremum
    a = np.array([q[0] for q in pts[-4:]]); b = np.array([q[1] for q in pts[-4:]])
    for h in (abs(dx), abs(dx) / 4):
        c2 = np.polyfit(a[-3:] - a[-2], b[-3:], 2)
        xv = a[-2] - c2[1] / (2 * c2[0])
        us = [(xv + k * h / 2) for k in (-2, -1, 0, 1, 2)]
        vals = []
        for x in us:
            uu, r = solve(x, u); u = uu; vals.append(uu[2])
        a, b = np.array(us[1:4]), np.array(vals[1:4])
        c4 = np.polyfit((np.array(us) - xv) / h, vals, 4)
        d = np.polyder(np.poly1d(c4)); roots = [z.real for z in d.roots if abs(z.imag) < 1e-9]
        best = min(roots, key=abs)
        print("fold", np.poly1d(c4)(best), "residual", r, flush=True)


FROM = {"up": 0.02, "down": 0.36}
STEP = {"up": 2e-5, "down": 2e-5}
NEXT_TO = {("up", 3): 0.341, ("down", 3): 0.0775, ("up", 4): 0.2995, ("down", 4): 0.1325}
if __name__ == "__main__":
    way, V = sys.argv[1], int(sys.argv[2])
    fold(NEXT_TO[way, V], way, float(V))
