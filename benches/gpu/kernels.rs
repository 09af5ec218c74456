//! The kernels and their parts as they are given to a compiler.

use squealmap::engine::kernel::source::Constant;
use squealmap::engine::kernel::{linear, response};
use squealmap::engine::lanes::job::Part;
use squealmap::engine::march::kernel as march;
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
    use Precision::{F32, F64};
    let plain = |precision| variant("linear", precision, linear::KERNEL.source(precision, &[]));
    vec![
        plain(F32),
        plain(F64),
        march("march, growth", Part::Growth),
        march("march, settling", Part::Settle),
        march("march, window", Part::Window),
        respond::<2>("response, two pieces", F32, LawForm::Pieces, false),
        respond::<2>("response, two pieces, ramp", F32, LawForm::Pieces, true),
        respond::<1>("response, exponential", F32, LawForm::Exponential, false),
        respond::<1>("response, rational", F32, LawForm::Rational, false),
        respond::<2>("response, two pieces", F64, LawForm::Pieces, false),
    ]
}

fn respond<const PIECES: usize>(
    name: &'static str,
    precision: Precision,
    law: LawForm,
    ramp: bool,
) -> Variant {
    let choices: [(&str, Constant); 2] = response::choices(law, ramp);
    variant(name, precision, response::kernel::<PIECES>().source(precision, &choices))
}

/// A part of the march, for laws of two pieces and a belt of one velocity.
fn march(name: &'static str, part: Part) -> Variant {
    let (kernel, _) = march::kernel_for(2).expect("laws of two pieces have a kernel");
    variant(name, Precision::F32, kernel.source(Precision::F32, &march::choices(part, false)))
}

fn variant(name: &'static str, precision: Precision, source: String) -> Variant {
    Variant { name, precision, source }
}
