//! What each friction law takes, and building it from an instance's parameters.

use std::sync::Arc;

use crate::model::friction::{FrictionLaw, LawKind, MuTable};
use crate::model::{Param, Params};

/// Every parameter of some law: what a material may give.
pub(super) const LAW_PARAMS: [Param; 5] =
    [Param::MuS, Param::MuD, Param::KneeVelocity, Param::StribeckVelocity, Param::Decay];

/// The law with this name.
pub(super) fn from_name(name: &str) -> Option<LawKind> {
    LawKind::ALL.into_iter().find(|kind| kind.name() == name)
}

/// The names of all laws.
pub(super) fn names() -> [&'static str; LawKind::ALL.len()] {
    LawKind::ALL.map(LawKind::name)
}

/// The parameters that a law reads.
pub(super) fn uses(kind: LawKind) -> &'static [Param] {
    match kind {
        LawKind::Constant => &[Param::MuD, Param::MuS],
        LawKind::Bilinear => &[Param::MuS, Param::MuD, Param::KneeVelocity],
        LawKind::Exponential => &[Param::MuS, Param::MuD, Param::StribeckVelocity],
        LawKind::Rational => &[Param::MuS, Param::Decay],
        LawKind::Table => &[],
    }
}

/// The first parameter that a law cannot do without and that `has` does not know.
///
/// The constant law takes `mu_s = mu_d` when only `mu_d` is given.
pub(super) fn missing(kind: LawKind, has: impl Fn(Param) -> bool) -> Option<Param> {
    let optional = |param| kind == LawKind::Constant && param == Param::MuS;
    uses(kind).iter().copied().find(|&param| !optional(param) && !has(param))
}

/// The names of the laws that read `param`.
pub(super) fn users(param: Param) -> Vec<&'static str> {
    LawKind::ALL.into_iter().filter(|&kind| uses(kind).contains(&param)).map(LawKind::name).collect()
}

/// The law of an instance.
///
/// # Panics
/// When a parameter or the table is missing, which validation excludes.
pub(super) fn build(kind: LawKind, params: &Params, table: Option<&Arc<MuTable>>) -> FrictionLaw {
    match kind {
        LawKind::Constant => {
            let mu_d = params.require(Param::MuD);
            FrictionLaw::Constant { mu_s: params.get(Param::MuS).unwrap_or(mu_d), mu_d }
        }
        LawKind::Bilinear => FrictionLaw::Bilinear {
            mu_s: params.require(Param::MuS),
            mu_d: params.require(Param::MuD),
            knee_velocity: params.require(Param::KneeVelocity),
        },
        LawKind::Exponential => FrictionLaw::Exponential {
            mu_s: params.require(Param::MuS),
            mu_d: params.require(Param::MuD),
            stribeck_velocity: params.require(Param::StribeckVelocity),
        },
        LawKind::Rational => {
            FrictionLaw::Rational { mu_s: params.require(Param::MuS), decay: params.require(Param::Decay) }
        }
        LawKind::Table => {
            FrictionLaw::Table(Arc::clone(table.expect("the law `table` was validated to have its file")))
        }
    }
}

/// The parameters of a law with their values.
pub(super) fn parts(law: &FrictionLaw) -> Vec<(Param, f64)> {
    match *law {
        FrictionLaw::Constant { mu_s, mu_d } => vec![(Param::MuS, mu_s), (Param::MuD, mu_d)],
        FrictionLaw::Bilinear { mu_s, mu_d, knee_velocity } => {
            vec![(Param::MuS, mu_s), (Param::MuD, mu_d), (Param::KneeVelocity, knee_velocity)]
        }
        FrictionLaw::Exponential { mu_s, mu_d, stribeck_velocity } => {
            vec![(Param::MuS, mu_s), (Param::MuD, mu_d), (Param::StribeckVelocity, stribeck_velocity)]
        }
        FrictionLaw::Rational { mu_s, decay } => vec![(Param::MuS, mu_s), (Param::Decay, decay)],
        FrictionLaw::Table(_) => Vec::new(),
    }
}
