//! Modes followed by their shapes while friction rises.

use faer::c64;

use super::pair::{Pair, likeness, matched};

/// One mode along the values of μ.
#[derive(Debug, Clone)]
pub struct Branch {
    /// The pair at each value of μ, by its place in the pairs of that value.
    pub at: Vec<usize>,
}

/// Follows the `count` first pairs of the first value of μ through all values. Each pair belongs to one mode at most; the most alike
/// are joined first. Where shapes do not decide, as after two have coalesced, the nearer eigenvalue does: its distance counts over the
/// sum of both, which is below 1 however far all modes move from one value to the next.
#[must_use]
pub fn follow(steps: &[Vec<Pair>], count: usize) -> Vec<Branch> {
    let lambdas: Vec<Vec<c64>> =
        steps.iter().map(|pairs| pairs.iter().map(|pair| pair.lambda).collect()).collect();
    follow_by(&lambdas, count, |step, old, new| {
        let (old, all) = (&steps[step][old].vector, &steps[step + 1]);
        // Of an eigenvalue that several modes have, any shapes that span theirs may come out.
        let like =
            |pair: &Pair| if one(all[new].lambda, pair.lambda) { likeness(old, &pair.vector) } else { 0.0 };
        all.iter().map(like).sum::<f64>().min(1.0)
    })
}

/// Whether two eigenvalues are one but for rounding.
fn one(a: c64, b: c64) -> bool {
    const ROUNDING: f64 = 1e-8;
    (a - b).norm() <= ROUNDING * a.norm()
}

/// The same with a likeness of its own: of a mode of a step, by its place there, and one of the next step.
#[must_use]
pub fn follow_by(
    steps: &[Vec<c64>],
    count: usize,
    alike: impl Fn(usize, usize, usize) -> f64,
) -> Vec<Branch> {
    let Some(first) = steps.first() else { return Vec::new() };
    let mut branches: Vec<Branch> = (0..count.min(first.len())).map(|k| Branch { at: vec![k] }).collect();
    for (i, step) in steps.windows(2).enumerate() {
        let [before, after] = step else { continue };
        let mut offers = Vec::with_capacity(branches.len() * after.len());
        for (b, branch) in branches.iter().enumerate() {
            let at = branch.at[branch.at.len() - 1];
            for (k, new) in after.iter().enumerate() {
                let both = (new.norm() + before[at].norm()).max(f64::MIN_POSITIVE);
                let apart = (new - before[at]).norm() / both;
                offers.push((alike(i, at, k) - apart, b, k));
            }
        }
        let served = matched(offers, [branches.len(), after.len()]);
        for (branch, k) in branches.iter_mut().zip(served) {
            branch.at.push(k.unwrap_or(branch.at[branch.at.len() - 1]));
        }
    }
    branches
}
