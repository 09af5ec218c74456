//! The content of the paper's figures, each computed once and when first asked for.

use std::sync::OnceLock;

use crate::model::Param;
use crate::model::instance::Instance;
use crate::study::error::Result;
use crate::study::modes::follow::{Modes, modes_of};
use crate::study::paper::accelerations;
use crate::study::paper::accelerations::Trial;
use crate::study::paper::growth::{Growth, PhaseCase};
use crate::study::paper::phase::PhaseTrial;
use crate::study::paper::ramp::Ramp;
use crate::study::paper::sweeps::{Case, FIGURE_2};
use crate::sweep::spec::Spec;

/// Settings that the paper leaves open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// Duration of the ramp of Figures 4 to 7, s; `None`: as shipped.
    pub ramp_duration: Option<f64>,
    /// Displacement at the start of that ramp, m; `None`: as shipped.
    pub kick: Option<f64>,
}

/// The paper's cases with what it leaves open.
#[derive(Debug)]
pub struct Study {
    settings: Settings,
    ramps: [OnceLock<Ramp>; 3],
    growths: [OnceLock<Growth>; 2],
    trials: OnceLock<Vec<Trial>>,
    phases: OnceLock<PhaseTrial>,
}

impl Study {
    /// A study with these settings; computes nothing yet.
    #[must_use]
    pub fn new(settings: Settings) -> Study {
        Study {
            settings,
            ramps: Default::default(),
            growths: Default::default(),
            trials: OnceLock::new(),
            phases: OnceLock::new(),
        }
    }

    /// The sweep of Figure 2 and its modes.
    ///
    /// # Errors
    /// None with the shipped sweep; modes share one signature.
    pub fn modes(&self) -> Result<(Spec, Modes)> {
        let spec = FIGURE_2.spec();
        let modes = modes_of(&spec)?;
        Ok((spec, modes))
    }

    /// The sweep of a case's ramp: the shipped one with the settings.
    #[must_use]
    pub fn sweep(&self, case: Case) -> Spec {
        self.settled(case.ramp())
    }

    /// A ramp with the settings in the place of what is shipped.
    fn settled(&self, mut spec: Spec) -> Spec {
        let open = [
            (Param::RampDuration, self.settings.ramp_duration),
            (Param::StartDisplacement, self.settings.kick),
        ];
        for (param, value) in open {
            if let Some(value) = value {
                spec.base.set(param, value);
            }
        }
        spec
    }

    /// The ramp of a case, computed when first asked for.
    ///
    /// # Errors
    /// When the integration ends before the ramp does.
    pub fn ramp(&self, case: Case) -> Result<&Ramp> {
        let place = &self.ramps[case as usize];
        if let Some(ramp) = place.get() {
            return Ok(ramp);
        }
        let ramp = Ramp::compute(case, &self.sweep(case))?;
        Ok(place.get_or_init(|| ramp))
    }

    /// The growth of a case of Figure 7, computed when first asked for.
    ///
    /// # Errors
    /// When the integration ends before the ramp does.
    pub fn growth(&self, case: PhaseCase) -> Result<&Growth> {
        let place = &self.growths[case as usize];
        if let Some(growth) = place.get() {
            return Ok(growth);
        }
        let growth = Growth::compute(case, &self.settled(case.sweep()))?;
        Ok(place.get_or_init(|| growth))
    }

    /// Other ramps and kicks, computed when first asked for; the settings do not change them.
    #[must_use]
    pub fn trials(&self) -> &[Trial] {
        self.trials.get_or_init(accelerations::trials)
    }

    /// The phase method on trial, computed when first asked for; the settings do not change it.
    ///
    /// # Errors
    /// When its sweep cannot be computed at all.
    pub fn phase_trial(&self) -> Result<&PhaseTrial> {
        if let Some(trial) = self.phases.get() {
            return Ok(trial);
        }
        let trial = PhaseTrial::compute()?;
        Ok(self.phases.get_or_init(|| trial))
    }

    /// The instance of a case's ramp.
    #[must_use]
    pub fn instance(&self, case: Case) -> Instance {
        self.sweep(case).instance(0)
    }
}
