//! Real modes, the projected problem with friction, complex modes, and where two of them coalesce.

mod attribution;
mod basis;
mod coalescence;
mod columns;
mod dense;
mod direct;
mod dissection;
mod factor;
mod follow;
mod judge;
mod modal;
mod nearby;
mod pair;
mod real;
mod residual;
mod small;

pub use attribution::{Alone, alone};
pub use basis::Basis;
pub use coalescence::{Coalescence, coalescence, coalescence_small, first_unstable};
pub use dense::pairs;
pub use direct::{Near, near};
pub use factor::{Factor, Ordering};
pub use follow::{Branch, follow, follow_by};
pub use judge::Judge;
pub use modal::{damp, loss_ratios};
pub use nearby::nearby;
pub use pair::{Pair, likeness};
pub use real::{RealModes, count_below, lowest};
pub use residual::{lift, refine, residuals};
pub use small::Small;
