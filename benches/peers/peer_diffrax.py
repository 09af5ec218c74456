"""diffrax on the two-mass model: Tsit5 with fixed steps, contact state switched at step ends, vmap over all instances, jit, f64.

Its events end a solve. Under vmap every lane then waits for the one with the most events, and each solve starts anew, so
the solver's step inside a loop of fixed length is the better form; the time of an event is known to a step only."""
import os
os.environ.setdefault("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1")
import numpy as np, jax, jax.numpy as jnp, diffrax
import model as m
jax.config.update("jax_enable_x64", True)

SLIP, STICK, FREE = 0, 1, 2
SOLVER = diffrax.Tsit5()


def forces(x):
    h = m.k2s*(x[0]*m.s + x[1]*m.c - x[2]) + m.c2s*(x[3]*m.s + x[4]*m.c - x[5])
    g = m.k1s*(x[0]*m.c - x[1]*m.s) + m.c1s*(x[3]*m.c - x[4]*m.s)
    return h, m.c*g + m.s*h, m.c*h - m.s*g


def mu_of(v, mu_s, mu_d):
    return jnp.where(jnp.abs(v) >= m.vks, mu_d, mu_s + (mu_d - mu_s)*jnp.abs(v)/m.vks)


def slip(x, sigma, V, mu_s, mu_d):
    """acceleration of x2 and normal force"""
    _, R, W = forces(x)
    q = sigma*mu_of(V - x[3], mu_s, mu_d)
    ax = (q*W - R)/(m.a00 + q*m.m1s*m.c*m.s)
    return ax, W - m.s*m.c*m.m1s*ax


def motion(t, x, args):
    mode, sigma, V, mu_s, mu_d = args
    h, R, W = forces(x)
    ax, _ = slip(x, sigma, V, mu_s, mu_d)
    free = mode == FREE
    ax = jnp.where(free, -(m.i00*R + m.i01*W), jnp.where(mode == SLIP, ax, 0.0))
    ay = jnp.where(free, -(m.i01*R + m.i11*W), 0.0)
    return jnp.stack([x[3], x[4], x[5], ax, ay, (h - m.Fs)/m.m1s])


def switch(x, mode, sigma, V, mu_s, mu_d):
    """impact, rest, stick, lift-off at the end of a step, in this order"""
    v = V - x[3]
    sign = jnp.where(v > 0, 1.0, -1.0)
    q = sign*mu_of(v, mu_s, mu_d)
    after = x[3] - x[4]*(m.i00*q + m.i01)/(m.i11 + m.i01*q)
    hit = (mode == FREE) & (x[1] <= 0.0) & (x[4] < 0.0)
    stopped = hit & ((V - after)*sign <= 0.0)
    x = jnp.where(hit, x.at[1].set(0.0).at[4].set(0.0).at[3].set(jnp.where(stopped, V, after)), x)
    sigma = jnp.where(hit, sign, sigma)
    mode = jnp.where(hit, SLIP, mode)
    closed = mode != FREE
    _, R, W = forces(x.at[3].set(V))
    holds = jnp.abs(R) <= mu_s*W
    rest = closed & ((mode == STICK) | ((V - x[3])*sigma <= 0.0))
    x = x.at[3].set(jnp.where(rest & holds, V, x[3]))
    sigma = jnp.where(rest & ~holds, jnp.where(R > 0, 1.0, -1.0), sigma)
    mode = jnp.where(rest, jnp.where(holds, STICK, SLIP), mode)
    _, of_slip = slip(x, sigma, V, mu_s, mu_d)
    _, _, of_stick = forces(x)
    normal = jnp.where(mode == STICK, of_stick, of_slip)
    return x, jnp.where(closed & (normal <= 0.0), FREE, mode), sigma


def instance(row, start, steps, settle, measure):
    mu_s, mu_d, V = row
    h = m.PERIOD/steps
    term = diffrax.ODETerm(motion)

    def body(i, carry):
        x, mode, sigma, total, square = carry
        args = (mode, sigma, V, mu_s, mu_d)
        x, _, _, _, _ = SOLVER.step(term, 0.0, h, x, args, (jnp.asarray(False), motion(0.0, x, args)), made_jump=True)
        x, mode, sigma = switch(x, mode, sigma, V, mu_s, mu_d)
        d = jnp.where(i >= settle*steps, x[0] - start[0], 0.0)
        return x, mode, sigma, total + d, square + d*d

    carry = (start, jnp.asarray(SLIP), jnp.where(V > start[3], 1.0, -1.0), 0.0, 0.0)
    _, _, _, total, square = jax.lax.fori_loop(0, (settle + measure)*steps, body, carry)
    count = measure*steps
    return jnp.sqrt(square/count - (total/count)**2)*m.L0


COMPILED = jax.jit(jax.vmap(instance, in_axes=(0, 0, None, None, None)), static_argnums=(2, 3, 4))


def run(rows, steps, settle=100, measure=40):
    """std x2 (m) with so many steps per period"""
    starts = [m.start(*map(float, row)) for row in rows]
    values = np.array([(row[0], row[1], V) for row, (_, V) in zip(rows, starts)])
    return np.asarray(COMPILED(values, np.array([x for x, _ in starts]), steps, settle, measure))
