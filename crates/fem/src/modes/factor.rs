//! K − σ M = L D Lᵀ, sparse.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLdltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::dissection::dissected;
use crate::Error;
use crate::assembly::{Pattern, Symmetric};

/// The order of elimination of a pattern, found once and used for every shift.
#[derive(Debug, Clone)]
pub struct Ordering(Arc<SymbolicCholesky<usize>>);

/// A factorised symmetric matrix.
#[derive(Debug)]
pub struct Factor {
    ordering: Ordering,
    values: Vec<f64>,
    /// The shift σ, 1/s².
    pub shift: f64,
    /// How many eigenvalues of (K, M) lie below the shift: the negative entries of D (Sylvester).
    pub below: usize,
}

fn symbolic(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, usize> {
    let size = pattern.size();
    SymbolicSparseColMatRef::new_checked(size, size, &pattern.start, None, &pattern.row)
}

impl Ordering {
    /// Approximate minimum degree: good for thin bodies, and where nothing is known of the places.
    ///
    /// # Errors
    /// Where the memory is not enough.
    pub fn new(pattern: &Pattern) -> Result<Self, Error> {
        Self::by(pattern, SymmetricOrdering::Amd)
    }

    /// Nested dissection by the places (m) of the unknowns, as [`crate::assembly::Numbering::places`] knows them: good for thick bodies.
    ///
    /// # Errors
    /// Where the memory is not enough.
    pub fn dissected(pattern: &Pattern, places: &[[f64; 3]]) -> Result<Self, Error> {
        Self::given(pattern, &dissected(pattern, places))
    }

    /// The one of both that makes fewer entries: a factorisation takes much longer than to find both.
    ///
    /// # Errors
    /// Where the memory is not enough.
    pub fn best(pattern: &Pattern, places: &[[f64; 3]]) -> Result<Self, Error> {
        let (one, other) = rayon::join(|| Self::new(pattern), || Self::dissected(pattern, places));
        let (one, other) = (one?, other?);
        Ok(if one.entries() <= other.entries() { one } else { other })
    }

    /// The unknowns in an order of elimination that is given.
    ///
    /// # Errors
    /// An order that does not name each unknown once; memory that is not enough.
    pub fn given(pattern: &Pattern, order: &[usize]) -> Result<Self, Error> {
        let size = pattern.size();
        let mut inverse = vec![size; size];
        for (i, unknown) in order.iter().enumerate() {
            if *unknown < size {
                inverse[*unknown] = i;
            }
        }
        if order.len() != size || inverse.contains(&size) {
            let what = format!("an order of elimination must name each of the {size} unknowns once");
            return Err(Error::Solver { what });
        }
        Self::by(pattern, SymmetricOrdering::Custom(PermRef::new_checked(order, &inverse, size)))
    }

    fn by(pattern: &Pattern, order: SymmetricOrdering<'_, usize>) -> Result<Self, Error> {
        // Elasticity has dense blocks, always: one kind of factor is enough.
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        factorize_symbolic_cholesky(symbolic(pattern), Side::Lower, order, parameters)
            .map(|found| Self(Arc::new(found)))
            .map_err(|error| Error::Solver {
                what: format!("no order of elimination for {} unknowns: {error}", pattern.size()),
            })
    }

    /// Entries of the factor L: eight bytes each.
    #[must_use]
    pub fn entries(&self) -> usize {
        self.0.len_val()
    }
}

impl Factor {
    /// Factorises K − σ M.
    ///
    /// # Errors
    /// Where a pivot is zero: the shift is an eigenvalue, or a body can move without a force.
    pub fn new(
        ordering: &Ordering,
        stiffness: &Symmetric,
        mass: &Symmetric,
        shift: f64,
    ) -> Result<Self, Error> {
        /// Below this fraction of the largest pivot, the smallest is what rounding leaves of zero.
        const ZERO: f64 = 1e-14;
        let matrix = stiffness.plus(-shift, mass);
        let parallel = faer::get_global_parallelism();
        let mut values = vec![0.0; ordering.entries()];
        let scratch = ordering.0.factorize_numeric_ldlt_scratch::<f64>(parallel, Spec::default());
        let view = SparseColMatRef::new(symbolic(&matrix.pattern), &matrix.values);
        ordering
            .0
            .factorize_numeric_ldlt(
                &mut values,
                view,
                Side::Lower,
                LdltRegularization::default(),
                parallel,
                MemStack::new(&mut MemBuffer::new(scratch)),
                Spec::default(),
            )
            .map_err(|_| singular(shift))?;
        let mut factor = Self { ordering: ordering.clone(), values, shift, below: 0 };
        let (mut least, mut largest) = (f64::INFINITY, 0.0_f64);
        let mut below = 0;
        factor.pivots(|d| {
            least = least.min(d.abs());
            largest = largest.max(d.abs());
            below += usize::from(d < 0.0);
        });
        if !(least > ZERO * largest) {
            return Err(singular(shift));
        }
        factor.below = below;
        Ok(factor)
    }

    /// Calls a function with each entry of D.
    fn pivots(&self, mut each: impl FnMut(f64)) {
        if let SymbolicCholeskyRaw::Supernodal(symbolic) = self.ordering.0.raw() {
            let factor = SupernodalLdltRef::new(symbolic, &self.values);
            for s in 0..symbolic.n_supernodes() {
                let block = factor.supernode(s).val();
                (0..block.ncols()).for_each(|i| each(block[(i, i)]));
            }
        }
    }

    /// Replaces each column b by (K − σ M)⁻¹ b.
    pub fn solve(&self, mut columns: MatMut<'_, f64>) {
        let parallel: Par = faer::get_global_parallelism();
        let scratch = self.ordering.0.solve_in_place_scratch::<f64>(columns.ncols(), parallel);
        LdltRef::new(&self.ordering.0, &self.values).solve_in_place_with_conj(
            Conj::No,
            columns.as_mut(),
            parallel,
            MemStack::new(&mut MemBuffer::new(scratch)),
        );
    }
}

fn singular(shift: f64) -> Error {
    if shift == 0.0 {
        return Error::Free;
    }
    let what = format!("the shift {shift:.6e} 1/s2 is an eigenvalue to within rounding: move it");
    Error::Solver { what }
}
