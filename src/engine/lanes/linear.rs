//! The eigenvalues of many sliding equilibria at a time: [`crate::engine::kernel::linear`] in the lanes of vector registers, in
//! f64. The same operations in the same order, none of them contracted, so that the bits are those of one instance alone and of
//! a device.

use pulp::{Arch, Simd, WithSimd};

use crate::engine::judged::{Examined, with_eigenvalues};
use crate::engine::kernel::linear::{MAX_STEPS, NEGLIGIBLE_EPSILONS, Quartic, Root, type_of};
use crate::engine::kernel::words::{INPUT_WORDS, STATE_WORDS, Words};
use crate::engine::lanes::vector::Vector;
use crate::model::instance::Instance;
use crate::model::kind::{InstabilityType, UNSTABLE_ABOVE};
use crate::model::linear::{Linear, Preparation, prepare, solve};

type Wide<S> = Vector<S, f64>;

/// Type of instability and eigenvalue analysis.
pub type Solved = (Option<InstabilityType>, Option<Linear>);

/// [`examined`](crate::engine::judged::examined) of many instances, together in the lanes of vector registers.
pub fn examined_many(instances: &[Instance], asked: bool) -> impl Iterator<Item = Examined> {
    let prepared: Vec<Preparation> = instances.iter().map(prepare).collect();
    let solved = solved(&prepared);
    instances
        .iter()
        .zip(prepared)
        .zip(solved)
        .map(move |((instance, prepared), solved)| with_eigenvalues(instance, asked, &prepared, |_| solved))
}

/// What [`solve`] gives for each of some preparations, by the factors of the kernel; by [`solve`] itself where these are beyond the
/// range of numbers, or have too few digits.
#[must_use]
pub fn solved(prepared: &[Preparation]) -> Vec<Solved> {
    solved_on(Arch::new(), prepared)
}

/// The same by an instruction set.
#[must_use]
pub fn solved_on(instructions: Arch, prepared: &[Preparation]) -> Vec<Solved> {
    let words: Vec<Words> = prepared.iter().flatten().map(Words::new).collect();
    let mut made = Vec::with_capacity(words.len());
    instructions.dispatch(All { words: &words, made: &mut made });
    let mut made = words.iter().zip(made);
    let each = |prepared: &Preparation| {
        let found = prepared.as_ref().ok().and_then(|_| made.next());
        let results = found.and_then(|(words, (state, kind))| {
            let known = !words.is_far() && state.iter().all(|value| value.is_finite());
            known.then(|| words.results(state, kind)).flatten()
        });
        results.map_or_else(|| solve(prepared), |(kind, linear)| (Some(kind), Some(linear)))
    };
    prepared.iter().map(each).collect()
}

/// Words to analyse, and what is made of them: the state words of the kernel and the type.
struct All<'a> {
    words: &'a [Words],
    made: &'a mut Vec<([f64; STATE_WORDS], u32)>,
}

impl WithSimd for All<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for words in self.words.chunks(Wide::<S>::LANES) {
            let mut inputs = [Wide::constant(simd, 0.0); INPUT_WORDS];
            for lane in 0..Wide::<S>::LANES {
                // Behind the last one it is that one again.
                let words = &words[lane.min(words.len() - 1)];
                for k in 0..INPUT_WORDS {
                    inputs[k].set(lane, words.inputs[k]);
                }
            }
            let (state, unstable) = analyse(simd, &inputs);
            for lane in 0..words.len() {
                let [full, flat, frozen] = std::array::from_fn(|k| unstable[k].get(lane) > 0.0);
                self.made.push((std::array::from_fn(|k| state[k].get(lane)), type_of(full, flat, frozen)));
            }
        }
    }
}

/// State words of the kernel, and 1 where the modes of each of the three polynomials grow.
#[inline(always)]
fn analyse<S: Simd>(simd: S, words: &[Wide<S>; INPUT_WORDS]) -> ([Wide<S>; STATE_WORDS], [Wide<S>; 3]) {
    let one = Wide::constant(simd, 1.0);
    let [full, flat, frozen] = std::array::from_fn(|k| {
        rightmost(Quartic { p: words[4 * k], g: words[4 * k + 1], k: words[4 * k + 2], e: words[4 * k + 3] })
    });
    let [mass, gap, damping] = [words[12], words[13], words[14]];
    let above_re = one + damping * full.re;
    let above_im = damping * full.im;
    let below = damping - mass * full.p;
    let near = full.t.abs().less(one.like(0.5));
    let below_re = near.select(gap - mass * full.t, one - mass * full.q) + below * full.re;
    let below_im = below * full.im;
    let ratio_re = above_re * below_re + above_im * below_im;
    let ratio_im = above_im * below_re - above_re * below_im;
    let unstable = [full, flat, frozen].map(|root| {
        let size = (root.re * root.re + root.im * root.im).sqrt();
        one.only((one.like(UNSTABLE_ABOVE) * size).less(root.re))
    });
    ([full.re, full.im, ratio_re, ratio_im, flat.re, frozen.re], unstable)
}

/// `y`, as [`crate::engine::kernel::linear::split`] has it.
#[inline(always)]
fn split<S: Simd>(quartic: Quartic<Wide<S>>) -> Wide<S> {
    let like = |value| quartic.p.like(value);
    let [zero, half, one, two, three, four] = [0.0, 0.5, 1.0, 2.0, 3.0, 4.0].map(like);
    let b = four - quartic.g;
    let c = quartic.k;
    let f = quartic.e * quartic.e;
    let mut low = zero;
    let root = (c * c + four * b * f).sqrt();
    let above = zero.less(f).select(two * f / (root + c), zero);
    let above = c.less(zero).select((root - c) / (two * b), above);
    let mut high = zero.less(b).select(above, one + b.abs().max(c.abs()).max(f));
    let mut y = high;
    let negligible = like(NEGLIGIBLE_EPSILONS) * like(f64::EPSILON);
    let mut searched = zero.at_most(zero);
    for _ in 0..MAX_STEPS {
        let value = ((two * y + b) * y + c) * y - f;
        let slope = (three * two * y + two * b) * y + c;
        let is_above = zero.less(value);
        high = is_above.select(y, high);
        low = is_above.select(low, y);
        let newton = y - value / slope;
        let inside = low.at_most(newton).and(newton.at_most(high));
        let next = inside.select(newton, half * (low + high));
        let step = (next - y).abs();
        y = searched.select(next, y);
        searched = searched.and(!step.at_most(negligible * next));
        if !searched.any() {
            break;
        }
    }
    y
}

/// The root of largest real part, as [`crate::engine::kernel::linear::rightmost`] has it.
#[inline(always)]
fn rightmost<S: Simd>(quartic: Quartic<Wide<S>>) -> Root<Wide<S>> {
    let Quartic { p, g, e, .. } = quartic;
    let [zero, one, two] = [0.0, 1.0, 2.0].map(|value| p.like(value));
    let y = split(quartic);
    let r = (y * (two + y)).sqrt();
    let product = e + p * y;
    let square = (two * y - g) + p * p;
    let w = square.max(zero).sqrt();
    let w = product.less(zero).select(-w, w);
    let w = zero.less(g).and(zero.less(r)).select(product / r, w);
    let t1 = y + r;
    let q1 = one + t1;
    let q2 = one / q1;
    let p1 = p + w;
    let p2 = p - w;
    let p2 = p2.abs().less(p1.abs()).select((two * (p - e) - p1 * q2) / q1, p2);
    let first = quadratic(p1, q1, t1);
    let second = quadratic(p2, q2, -(t1 * q2));
    let same = second.re.at_most(first.re).and(first.re.at_most(second.re));
    let other = first.re.less(second.re).or(same.and(first.im.less(second.im)));
    let of = |get: fn(Root<Wide<S>>) -> Wide<S>| other.select(get(second), get(first));
    Root {
        re: of(|root| root.re),
        im: of(|root| root.im),
        p: of(|root| root.p),
        q: of(|root| root.q),
        t: of(|root| root.t),
    }
}

/// The root of `ζ² + p ζ + q`, as [`crate::engine::kernel::linear::quadratic`] has it.
#[inline(always)]
fn quadratic<S: Simd>(p: Wide<S>, q: Wide<S>, t: Wide<S>) -> Root<Wide<S>> {
    let zero = p.like(0.0);
    let half = -p.like(0.5) * p;
    let discriminant = half * half - q;
    let turns = discriminant.less(zero);
    let root = turns.select(-discriminant, discriminant).sqrt();
    let real = zero.at_most(half).select(half + root, q / (half - root));
    Root { re: turns.select(half, real), im: root.only(turns), p, q, t }
}
