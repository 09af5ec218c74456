//! The phase of a window, by a second pass over it.

use std::f64::consts::TAU;

use num_complex::Complex64;

use crate::engine::reductions::Reductions;
use crate::engine::reference::integrate::Integrator;
use crate::engine::reference::observe::CyclePhase;
use crate::engine::scene::Scene;
use crate::model::status::Status;

/// The Fourier components at the response frequency, which is known only after the window: a second pass over it.
pub(super) fn phase(
    scene: &Scene,
    mut integrator: Integrator,
    frequency: f64,
    seen: &Reductions,
    half: f64,
) -> Result<[[f64; 2]; 2], Status> {
    let mut cycle = CyclePhase {
        angular_frequency: TAU * frequency,
        from: seen.first,
        to: seen.last,
        x: Complex64::ZERO,
        y: Complex64::ZERO,
    };
    for _ in 0..2 {
        scene.advance(&mut integrator, half, &mut cycle)?;
    }
    Ok([cycle.x, cycle.y].map(|z| [z.re, z.im]))
}
