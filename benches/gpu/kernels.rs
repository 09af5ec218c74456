//! The kernels and their parts as they are given to a compiler.

use squealmap::engine::kernel::linear;
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::marching::Form;
use squealmap::engine::precision::Precision;
use squealmap::model::piece::LawForm;

/// A kernel for one scalar, with what a scene chooses.
#[derive(Clone, Debug)]
pub(crate) struct Variant {
    /// Its name in the rows.
    pub(crate) name: &'static str,
    pub(crate) precision: Precision,
    /// Its text in WGSL.
    pub(crate) source: String,
}

/// Every kernel whose figures are kept.
pub(crate) fn all() -> Vec<Variant> {
    use Part::{Growth, Settle, Window};
    use Precision::{F32, F64};
    let plain = |precision| variant("linear", precision, linear::KERNEL.source(precision, &[]));
    vec![
        plain(F32),
        plain(F64),
        march("march, growth", F32, Growth, LawForm::Pieces),
        march("march, settling", F32, Settle, LawForm::Pieces),
        march("march, window", F32, Window, LawForm::Pieces),
        march("march, exponential, settling", F32, Settle, LawForm::Exponential),
        march("march, exponential, window", F32, Window, LawForm::Exponential),
        march("march, rational, settling", F32, Settle, LawForm::Rational),
        march("march, settling", F64, Settle, LawForm::Pieces),
        march("march, window", F64, Window, LawForm::Pieces),
    ]
}

/// A part of the march for a belt of one velocity; straight laws of two pieces.
fn march(name: &'static str, precision: Precision, part: Part, law: LawForm) -> Variant {
    let pieces = if law.is_straight() { 2 } else { 1 };
    let form = Form { law, pieces, ramp: false };
    let (kernel, choices) = form.kernel(part).expect("laws of two pieces have a kernel");
    variant(name, precision, kernel.source(precision, &choices))
}

fn variant(name: &'static str, precision: Precision, source: String) -> Variant {
    Variant { name, precision, source }
}
