//! The engine that was chosen for a sweep, computing one range of instances after the other.

use std::fmt;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

use crate::engine::Engine;
use crate::engine::choice::choose;
use crate::engine::computation::{Computation, Stopped};
use crate::engine::computed::Computed;
use crate::engine::error::Result;
use crate::engine::options::Options;
use crate::engine::record::Record;
use crate::model::modal;
use crate::sweep::accuracy::check::check;
use crate::sweep::accuracy::configuration::Configuration;
use crate::sweep::accuracy::sample::subset;
use crate::sweep::several;
use crate::sweep::spec::{Analysis, Spec, Starts};

/// What computes a sweep.
pub struct Solver<'a> {
    spec: &'a Spec,
    options: &'a Options<'a>,
    engine: Box<dyn Engine>,
}

impl fmt::Debug for Solver<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solver").field("engine", &self.engine).finish_non_exhaustive()
    }
}

impl<'a> Solver<'a> {
    /// Chooses the engine, see [`choose`].
    ///
    /// # Errors
    /// Those of [`choose`].
    pub fn new(spec: &'a Spec, options: &'a Options<'a>) -> Result<Solver<'a>> {
        Ok(Solver::with_engine(spec, options, choose(options, spec)?))
    }

    /// With an engine that computes as the options say.
    #[must_use]
    pub fn with_engine(spec: &'a Spec, options: &'a Options<'a>, engine: Box<dyn Engine>) -> Solver<'a> {
        Solver { spec, options, engine }
    }

    /// The sweep.
    #[must_use]
    pub fn spec(&self) -> &Spec {
        self.spec
    }

    /// Where and how the eigenvalue analysis and the response are computed; `None` where not asked for.
    #[must_use]
    pub fn computations(&self) -> [Option<Computation>; 2] {
        let Analysis { linear, response, .. } = self.spec.analysis;
        let [mut of_linear, of_response] = self.engine.computations(self.spec);
        if self.spec.modal.is_some() {
            modal::METHOD.clone_into(&mut of_linear.method);
        }
        [linear.then_some(of_linear), response.then_some(of_response)]
    }

    /// The records of the instances `range`, in order; the CPU's part runs on the rayon pool it is called in.
    /// `progress` gets the number of newly finished instances. A run that is cancelled or fails on its way
    /// gives what is done, see [`Computed::stopped`]. With `checked` in the analysis some are computed again, see
    /// [`mod@crate::sweep::accuracy::check`].
    ///
    /// # Errors
    /// When the engine fails or is cancelled before any instance of the range is done, or a result is in doubt.
    pub fn records(&mut self, range: Range<usize>, progress: &(dyn Fn(usize) + Sync)) -> Result<Computed> {
        self.records_of(self.spec, range, progress)
    }

    /// As [`Solver::records`]. Of the `ahead` instances behind the range, for which the next call asks, the engine may begin some.
    ///
    /// # Errors
    /// Those of [`Solver::records`].
    pub fn records_ahead(
        &mut self,
        range: Range<usize>,
        ahead: usize,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        if self.ahead() == 0 {
            self.records(range, progress)
        } else {
            self.once(self.spec, range, ahead, progress)
        }
    }

    /// How many instances behind a range the engine begins at most.
    #[must_use]
    pub fn ahead(&self) -> usize {
        let Analysis { response, starts, .. } = self.spec.analysis;
        if response && starts == Starts::One { self.engine.ahead(self.spec) } else { 0 }
    }

    /// The records of the instances `range` of another sweep, which asks for the same analysis; see [`Solver::records`].
    ///
    /// # Errors
    /// Those of [`Solver::records`].
    pub fn records_of(
        &mut self,
        spec: &Spec,
        range: Range<usize>,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        if spec.analysis.starts == Starts::One {
            return self.once(spec, range, 0, progress);
        }
        let block = self.engine.at_once(range.len());
        let mut once = |spec: &Spec, range: Range<usize>, progress: &(dyn Fn(usize) + Sync)| {
            self.once(spec, range, 0, progress)
        };
        several::records(spec, range, block, &mut once, progress)
    }

    /// The records of instances with one start each, checked.
    fn once(
        &mut self,
        spec: &Spec,
        range: Range<usize>,
        ahead: usize,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        let cancel = self.options.cancel();
        let mut computed = self.engine.records_ahead(spec, range.clone(), ahead, cancel, progress)?;
        Checker { spec, configuration: self.configuration(), cancel }.check(range, &mut computed)?;
        Ok(computed)
    }

    /// What checks the records of [`Solver::records_beside`].
    #[must_use]
    pub fn checker(&self) -> Checker<'a> {
        Checker { spec: self.spec, configuration: self.configuration(), cancel: self.options.cancel() }
    }

    /// The least number of instances that keeps the engine busy: with fewer, cores or lanes are left without work. Where
    /// instances are so costly that a tile has few, a core takes no more than a tile at a time, so that a stop does not lose
    /// many.
    #[must_use]
    pub fn busy_with(&self, tile: usize) -> usize {
        self.engine.busy_with(tile, self.spec.analysis.starts.count())
    }

    /// The records of the instances `range` where some are `known`, which are not computed: of one start each before any check,
    /// for [`Solver::checker`], of several starts with their checks. See [`Solver::records_ahead`] for `ahead`; nothing is begun where
    /// some are known.
    ///
    /// # Errors
    /// Those of [`Solver::records`].
    pub fn records_beside(
        &mut self,
        range: Range<usize>,
        known: &[Option<Record>],
        ahead: usize,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        let one_start = self.spec.analysis.starts == Starts::One;
        let lacking = known.iter().filter(|known| known.is_none()).count();
        if lacking == known.len() && one_start {
            return self.engine.records_ahead(self.spec, range, ahead, self.options.cancel(), progress);
        } else if lacking == known.len() {
            return self.records(range, progress);
        }
        progress(range.len() - lacking);
        if one_start {
            self.one_start_beside(range, known, progress)
        } else {
            self.several_starts_beside(range, known, progress)
        }
    }

    /// The lacking instances as a sweep of their own.
    fn one_start_beside(
        &mut self,
        range: Range<usize>,
        known: &[Option<Record>],
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        let lacking: Vec<usize> =
            range.zip(known).filter(|(_, known)| known.is_none()).map(|(index, _)| index).collect();
        let fresh = if lacking.is_empty() {
            Computed { records: Vec::new(), stopped: None }
        } else {
            self.records_of(&subset(self.spec, &lacking), 0..lacking.len(), progress)?
        };
        let mut records = fresh.records.into_iter();
        let merged = known
            .iter()
            .map(|known| known.clone().or_else(|| records.next()).unwrap_or(Record::NOT_COMPUTED));
        Ok(Computed { records: merged.collect(), stopped: fresh.stopped })
    }

    /// The lacking instances stretch by stretch: where other starts lie depends on the number of an instance.
    fn several_starts_beside(
        &mut self,
        range: Range<usize>,
        known: &[Option<Record>],
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Computed> {
        let mut computed = Computed { records: Vec::with_capacity(range.len()), stopped: None };
        for stretch in known.chunk_by(|one, next| one.is_some() == next.is_some()) {
            let first = range.start + computed.records.len();
            if stretch[0].is_some() || computed.stopped.is_some() {
                let records = stretch.iter().map(|known| known.clone().unwrap_or(Record::NOT_COMPUTED));
                computed.records.extend(records);
                continue;
            }
            match self.records(first..first + stretch.len(), progress) {
                Ok(part) => {
                    computed.records.extend(part.records);
                    computed.stopped = part.stopped;
                }
                Err(why) => {
                    computed.stopped = Some(Stopped::try_from(why)?);
                    computed.records.resize(first - range.start + stretch.len(), Record::NOT_COMPUTED);
                }
            }
        }
        Ok(computed)
    }

    /// The engine with its settings, as one of the configurations whose accuracy is measured.
    fn configuration(&self) -> Configuration {
        Configuration::of(self.engine.as_ref(), self.spec.steps_per_period)
    }
}

/// Checks records of a sweep while others are computed.
#[derive(Debug)]
pub struct Checker<'a> {
    spec: &'a Spec,
    configuration: Configuration,
    cancel: &'a AtomicBool,
}

impl Checker<'_> {
    /// Checks the records of the instances `range`, of one start each, where the sweep is checked and they are all there; says in
    /// them where it was stopped.
    ///
    /// # Errors
    /// When a result is in doubt.
    pub fn check(&self, range: Range<usize>, computed: &mut Computed) -> Result<()> {
        if self.spec.analysis.checks()
            && self.spec.analysis.starts == Starts::One
            && computed.stopped.is_none()
        {
            computed.stopped =
                check(self.spec, range, &self.configuration, &mut computed.records, self.cancel)?;
        }
        Ok(())
    }
}
