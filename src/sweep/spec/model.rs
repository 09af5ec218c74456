//! `[model]`: the kinds of models, which parameters each reads, and the file of a modal one.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use crate::model::Param;
use crate::model::modal::Modal;
use crate::sweep::error::{Error, Result};
use crate::sweep::spec::{MAX_SWEEP_BYTES, Spec};
use squealmap_input::files;
use squealmap_input::place::Source;

/// What `kind` may say.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Two masses on a belt.
    #[default]
    TwoMass,
    /// A few modes of any structure.
    Modal,
}

impl Kind {
    /// Every kind with its name in a sweep file.
    pub(super) const ALL: [(&'static str, Kind); 2] = [("two_mass", Kind::TwoMass), ("modal", Kind::Modal)];

    /// As it stands in a sweep file.
    pub(super) fn written(self) -> &'static str {
        match self {
            Kind::TwoMass => "kind = \"two_mass\" in [model]",
            Kind::Modal => "kind = \"modal\" in [model]",
        }
    }

    /// The only kind that reads a parameter; `None` where both do.
    pub(super) fn only_reader(param: Param) -> Option<Kind> {
        match param {
            Param::FExt
            | Param::MuS
            | Param::MuD
            | Param::KneeVelocity
            | Param::StribeckVelocity
            | Param::Decay
            | Param::Temperature
            | Param::BeltVelocity => None,
            Param::DampingRatio
            | Param::DampingRatio1
            | Param::DampingRatio2
            | Param::DampingRatio3
            | Param::DampingRatio4
            | Param::DampingRatio5
            | Param::DampingRatio6
            | Param::DampingRatio7
            | Param::DampingRatio8
            | Param::Kn => Some(Kind::Modal),
            // What only a motion in time shows is known of two masses alone.
            Param::M1
            | Param::M2
            | Param::K1
            | Param::K2
            | Param::C1
            | Param::C2
            | Param::Theta
            | Param::Restitution
            | Param::TemperatureEnd
            | Param::BeltVelocityEnd
            | Param::RampDuration
            | Param::RiseDuration
            | Param::StartVelocity
            | Param::StartDisplacement
            | Param::StartFraction
            | Param::StartEventFraction
            | Param::LargeVelocity
            | Param::LargeDisplacement
            | Param::BoxDisplacementFrom
            | Param::BoxDisplacementTo
            | Param::BoxVelocityFrom
            | Param::BoxVelocityTo => Some(Kind::TwoMass),
        }
    }

    /// The kind that reads a parameter which this one does not.
    pub(super) fn reader(self, param: Param) -> Option<Kind> {
        Kind::only_reader(param).filter(|reader| *reader != self)
    }
}

/// Instances whose friction is looked at, spread over the sweep.
const LOOKED_AT: usize = 4096;

impl Spec {
    /// A sentence about friction beyond that for which the vectors of a modal model were chosen, where a sweep has such.
    #[must_use]
    pub fn beyond_its_modes(&self) -> Option<String> {
        let modal = self.modal.as_ref()?;
        let instances = self.grid.len();
        let looked_at = LOOKED_AT.min(instances);
        let mu = |part: usize| {
            // The first and the last among them.
            let instance = self.instance(part * (instances - 1) / (looked_at - 1).max(1));
            instance.law.mu(instance.params.require(Param::BeltVelocity))
        };
        if let Some(contact) = modal.contact {
            let [low, high] = contact.range;
            let kn = |part: usize| {
                let instance = part * (instances - 1) / (looked_at - 1).max(1);
                self.instance(instance).params.get(Param::Kn)
            };
            if let Some(kn) = (0..looked_at).filter_map(kn).find(|kn| !(low..=high).contains(kn)) {
                return Some(format!(
                    "the contact stiffness is {kn:e} Pa/m in this sweep, but the vectors of `{}` were chosen for {low:e} to {high:e}: beyond, eigenvalues are \
                     less accurate",
                    modal.name
                ));
            }
        }
        let [low, high] = modal.mu;
        let beyond = |mu: &f64| (low - mu).max(mu - high);
        let farthest = (0..looked_at).map(mu).max_by(|a, b| beyond(a).total_cmp(&beyond(b)))?;
        (beyond(&farthest) > 0.0).then(|| {
            format!(
                "the coefficient of friction is {farthest:.4} in this sweep, but the vectors of `{}` were chosen for {low} to \
                 {high}: beyond, eigenvalues are less accurate",
                modal.name
            )
        })
    }
}

/// What to say of a key that is none, and that somebody may look for.
pub(super) fn no_key(name: &str) -> Option<&'static str> {
    (name == "contact_stiffness").then_some("the contact stiffness of a modal model is `kn`")
}

/// What to say where a description of bodies in contact is taken for a sweep.
pub(super) fn of_study(name: &str) -> Option<&'static str> {
    matches!(name, "parts" | "materials" | "supports" | "loads" | "bonds" | "sliding").then_some(
        "this is a study of bodies in contact by finite elements: `squealmap fem` computes it, and `squealmap fem --check` says what it costs",
    )
}

/// Reads the file of modes `name`, relative to `base_dir`, which stands at `span` of `sweep`.
pub(super) fn read(sweep: &Source, span: Range<usize>, name: &str, base_dir: &Path) -> Result<Arc<Modal>> {
    let path = base_dir.join(name);
    let found = files::text(&path, MAX_SWEEP_BYTES).and_then(|text| of_text(name, &text));
    match found {
        Ok(modal) => Ok(Arc::new(modal)),
        Err(why) => Err(Error::ReadNamed { at: sweep.place(span), role: "modes", path, why }),
    }
}

/// The structure of a text; what is wrong with it as the end of a sentence.
#[cfg(feature = "fem")]
pub(super) fn of_text(name: &str, text: &str) -> std::result::Result<Modal, String> {
    use crate::model::modal::{Contact, Matrices};
    use nalgebra::DMatrix;

    let file = squealmap_fem::study::Modal::read(text).map_err(|why| why.to_string())?;
    if file.load == 0.0 {
        let why = "its load is 0 N, so that a slope of friction would have no effect; press the bodies in the study";
        return Err(why.to_owned());
    }
    let n = file.size();
    let all = file.symmetric.iter().chain(&file.friction).chain([&file.slope]);
    let mut all = all.map(|matrix| DMatrix::from_fn(n, n, |i, j| matrix[(i, j)]));
    let mut next = || all.next().ok_or_else(|| "a matrix is missing".to_owned());
    let matrices = Matrices {
        symmetric: [next()?, next()?, next()?],
        friction: [next()?, next()?, next()?],
        slope: next()?,
        contact: DMatrix::from_fn(n, n, |i, j| {
            file.contact.as_ref().map_or(0.0, |of| of.per_stiffness[(i, j)])
        }),
    };
    let contact = file.contact.as_ref().map(|of| Contact { stiffness: of.stiffness, range: of.range });
    let (names, loads) = ([name.to_owned(), text.to_owned()], [file.load, file.wedge]);
    Modal::new(names, &matrices, file.mu, loads, contact, file.modes)
}

/// The structure of a text, which only the feature `fem` reads.
#[cfg(not(feature = "fem"))]
pub(super) fn of_text(_: &str, _: &str) -> std::result::Result<Modal, String> {
    Err("this is built without the feature `fem`; build it with that".to_owned())
}
