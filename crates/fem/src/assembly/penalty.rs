//! Contact by a stiffness instead of multipliers: the surfaces overlap a little, and the normal force grows with that.
//!
//! The normal forces are N = −k A g with the gaps g = G_n u of the contact points and A = ∫ N_a N_b dA. That adds Gᵀ k A G to K, with
//! G = G_n Z, and makes K_n = −k A G; inertia and damping of the surface have no part in N.

use crate::mesh::FaceRef;

/// A contact stiffness.
#[derive(Debug, Clone, PartialEq)]
pub struct Penalty {
    /// Pressure per overlap k, Pa/m.
    pub stiffness: f64,
    /// Faces of the slaves.
    pub faces: Vec<FaceRef>,
}
