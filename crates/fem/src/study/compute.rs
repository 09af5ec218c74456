//! The computation of a study, step by step.

use std::time::Instant;

use faer::c64;

use super::Study;
use super::growth::grows;
use super::mechanisms::{Alone, mechanisms};
use super::modal::Modal;
use super::projected::Projected;
use super::space::{MORE, ROUNDS, spread_over};
use super::transitions::{Search, Transition};
use super::variation::{Variation, variation};
use crate::Error;
use crate::assembly::{Numbering, Pencil, Rows, assemble};
use crate::modes::{
    Basis, Factor, Ordering, RealModes, count_below, damp, lift, loss_ratios, lowest, pairs, refine,
};
use crate::statics::settle;
use crate::sweep::{Mode, Range, sweep};

/// A complex mode on all nodes, turned so that its largest component is real and 1.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Coefficient of friction.
    pub mu: f64,
    /// The mode, counted from 0.
    pub mode: usize,
    /// Growth rate and angular frequency, 1/s.
    pub lambda: c64,
    /// Displacements of the nodes.
    pub displacement: Vec<[c64; 3]>,
}

/// What the static step gives.
#[derive(Debug, Clone)]
pub struct Pressed {
    /// Sum of the normal forces, N.
    pub force: f64,
    /// Contact points that gape and are left out.
    pub open: usize,
    /// Displacements of the nodes, m.
    pub displacement: Vec<[f64; 3]>,
}

/// The results of a study.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Number of unknowns.
    pub unknowns: usize,
    /// Points of contact that stay closed.
    pub points: usize,
    /// The static step, where anything presses.
    pub pressed: Option<Pressed>,
    /// Frequencies of all real modes without friction that were computed, Hz.
    pub real: Vec<f64>,
    /// Vectors of the space on which friction was solved.
    pub vectors: usize,
    /// Entries of the factor of the stiffness matrix.
    pub entries: usize,
    /// The modes that were asked for, over `Study::mus`.
    pub modes: Vec<Mode>,
    /// Growth rates of each of them, over the same values, with one mechanism alone.
    pub alone: Vec<Vec<Alone>>,
    /// Frequencies of the real modes without the stress of the static step, Hz, where it stiffens the bodies.
    pub unstressed: Option<Vec<f64>>,
    /// Damping ratios of the real modes, where they are damped one by one or by their materials' losses.
    pub ratios: Vec<f64>,
    /// Another parameter, where it is varied.
    pub variation: Option<Variation>,
    /// Whether anything damps.
    pub damped: bool,
    /// Where modes become unstable or stable.
    pub transitions: Vec<Transition>,
    /// Sentences on what was not found.
    pub remarks: Vec<String>,
    /// Shapes of modes.
    pub shapes: Vec<Shape>,
    /// The projected problem, where it is asked for.
    pub modal: Option<Modal>,
    /// Names of the steps and their seconds.
    pub seconds: Vec<(&'static str, f64)>,
}

impl Outcome {
    /// The largest residual of all modes.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.modes.iter().flat_map(|mode| &mode.states).map(|state| state.residual).fold(0.0, f64::max)
    }

    /// Whether a mode grows at the value of μ with this index.
    #[must_use]
    pub fn grows(&self, mode: usize, index: usize) -> bool {
        grows(self.modes[mode].states[index].lambda, self.damped)
    }

    /// Whether it decays by more than rounding: where nothing damps, as the twin −λ̄ of a mode that grows.
    #[must_use]
    pub fn decays(&self, mode: usize, index: usize) -> bool {
        grows(-self.modes[mode].states[index].lambda.conj(), false)
    }
}

/// Seconds of each step, and what is said before it.
struct Clock<'a> {
    say: &'a mut dyn FnMut(&str),
    since: Instant,
    seconds: Vec<(&'static str, f64)>,
}

impl Clock<'_> {
    fn step<T>(&mut self, name: &'static str, work: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        (self.say)(name);
        self.since = Instant::now();
        let done = work();
        self.seconds.push((name, self.since.elapsed().as_secs_f64()));
        done
    }
}

/// Computes a study; `say` is called with the name of each step when it begins.
///
/// # Errors
/// A body that can move without a force, a contact that opens altogether, modes that do not converge or of which one is missing.
pub fn compute(study: &Study, say: &mut dyn FnMut(&str)) -> Result<Outcome, Error> {
    let mut clock = Clock { say, since: Instant::now(), seconds: Vec::new() };
    let friction = &study.document.friction;
    let asked = &study.document.modes;
    let (mut plain, mut model) = (None, study.model.clone());
    let (numbering, mut pencil, pressed, per_slope) = if study.is_pressed() {
        let settled = clock
            .step("static step", || settle(&study.model, &study.faces, &study.loads, friction.static_mu))
            .map_err(|why| of_load(study, why))?;
        let per_slope = settled.surface.matrix(&settled.pressures);
        let stiffened = if asked.stressed { Some(settled.stiffened()?) } else { None };
        let force = settled.force;
        model = settled.model;
        let pressed = Pressed { force, open: settled.open.len(), displacement: settled.displacement };
        let pencil = match stiffened {
            Some(stiffened) => {
                plain = Some(settled.pencil);
                stiffened
            }
            None => settled.pencil,
        };
        (settled.numbering, pencil, Some(pressed), per_slope)
    } else {
        let (numbering, pencil) = clock.step("matrices", || assemble(&study.model))?;
        (numbering, pencil, None, Rows::default())
    };
    let slope =
        if friction.slope == 0.0 { Rows::default() } else { per_slope.clone().scaled(friction.slope) };
    let ordering = Ordering::best(&pencil.stiffness.pattern, &numbering.places(&study.model.mesh))?;
    let factor = clock.step("factor", || Factor::new(&ordering, &pencil.stiffness, &pencil.mass, 0.0))?;
    let (real, count) =
        clock.step("real modes", || real_modes(&pencil, &ordering, &factor, asked.count, asked.band[1]))?;
    let frequencies = real.frequencies();
    let unstressed = match &plain {
        Some(plain) => Some(clock.step("modes without the stress", || {
            let factor = Factor::new(&ordering, &plain.stiffness, &plain.mass, 0.0)?;
            Ok(lowest(plain, &factor, count)?.frequencies())
        })?),
        None => None,
    };
    let ratios = damping_ratios(study, &numbering, &real)?;
    damp(&mut pencil, &real, &ratios)?;
    let damped = pencil.is_damped() || !slope.rows.is_empty();
    clock.step("count of modes", || complete(&pencil, &ordering, &frequencies, count))?;
    let mut basis = Basis::new(&pencil, &real.shapes);
    let some = spread_over(&study.mus);
    clock.step("space for friction", || {
        refine(&pencil, &factor, &mut basis, &some, &slope, count, 0.1 * asked.residual, ROUNDS).map(drop)
    })?;
    let range = Range { mus: &study.mus, slope: &slope, count, bound: asked.residual };
    let modes = clock.step("sweep over friction", || sweep(&pencil, &ordering, &factor, &basis, range))?;
    if !modes.iter().any(|mode| super::band::in_band(study, mode)) {
        let what = format!(
            "none of the {count} modes that are followed lies in the band; the highest has {:.1} Hz: lower the band, or ask for more modes",
            frequencies[count - 1]
        );
        return Err(Error::at("modes.band", what));
    }
    let alone = clock.step("one mechanism alone", || mechanisms(&basis, &slope, &study.mus, &modes))?;
    let search = Search { pencil: &pencil, ordering: &ordering, factor: &factor, range, damped };
    let (transitions, remarks) = clock.step("critical friction", || search.all(&mut basis, &modes))?;
    let wanted = wanted(study, &modes, &transitions, damped);
    let shapes = clock.step("shapes", || shapes(&numbering, &basis, &slope, study, &modes, &wanted))?;
    let modal = if study.document.output.modal {
        let load = pressed.as_ref().map_or(0.0, |pressed| pressed.force);
        let (basis, slope, per_slope) = (&basis, &slope, &per_slope);
        let projected =
            Projected { study, model: &model, pencil: &pencil, basis, slope, per_slope, count, load };
        Some(clock.step("projected problem", || projected.modal())?)
    } else {
        None
    };
    let variation = match &study.document.vary {
        Some(vary) => Some(clock.step("variation", || variation(study, vary, count))?),
        None => None,
    };
    Ok(Outcome {
        unknowns: pencil.size(),
        points: pencil.slip.rows.len(),
        pressed,
        real: frequencies,
        vectors: basis.vectors.ncols(),
        entries: ordering.entries(),
        modes,
        alone,
        unstressed,
        ratios,
        variation,
        damped,
        transitions,
        remarks,
        shapes,
        modal,
        seconds: clock.seconds,
    })
}

/// What is wrong with the contact, said of what presses it.
fn of_load(study: &Study, why: Error) -> Error {
    match why {
        Error::Contact { what } => Error::at(study.presser().as_deref().unwrap_or("loads"), what),
        other => other,
    }
}

/// Damping ratios of the real modes: those that are given, and by the losses of the materials.
fn damping_ratios(study: &Study, numbering: &Numbering, real: &RealModes) -> Result<Vec<f64>, Error> {
    let given = &study.document.modes.damping_ratios;
    // Materials of the description stand first, in this order.
    let mut loss: Vec<f64> = study.document.materials.values().map(|material| material.loss_factor).collect();
    if loss.iter().all(|loss| *loss == 0.0) {
        return Ok(given.clone());
    }
    loss.resize(study.model.materials.len(), 0.0);
    let mut ratios = loss_ratios(&study.model, numbering, real, &loss)?;
    ratios.iter_mut().zip(given).for_each(|(ratio, given)| *ratio += given);
    if let Some(k) = ratios.iter().position(|ratio| *ratio >= 1.0) {
        let what = format!(
            "with half the loss of its materials the ratio of mode {} is {:.3}, it must be below 1: give less of one of both",
            k + 1,
            ratios[k]
        );
        return Err(Error::at("modes.damping_ratios", what));
    }
    Ok(ratios)
}

/// Real modes, more than are followed, and how many are followed: `count`, or as many as lie below a frequency (Hz).
fn real_modes(
    pencil: &Pencil,
    ordering: &Ordering,
    factor: &Factor,
    count: usize,
    highest: f64,
) -> Result<(RealModes, usize), Error> {
    let size = pencil.size();
    let count = if highest.is_finite() { count.min(count_below(pencil, ordering, highest)?) } else { count };
    if count == 0 {
        let what = format!("no mode lies below {highest} Hz: raise the end of the band");
        return Err(Error::at("modes.band", what));
    }
    if count > size {
        let what =
            format!("{count} modes are asked for, but the model has {size} unknowns: ask for 1 to {size}");
        return Err(Error::at("modes.count", what));
    }
    Ok((lowest(pencil, factor, (count + MORE).min(size))?, count))
}

/// Checks by Sylvester's law of inertia that no mode is missing among those that are followed.
fn complete(pencil: &Pencil, ordering: &Ordering, frequencies: &[f64], count: usize) -> Result<(), Error> {
    /// Two frequencies that are nearer than this are one for a shift between them.
    const APART: f64 = 1e-7;
    let gap = (count..frequencies.len()).find(|k| frequencies[*k] > frequencies[k - 1] * (1.0 + APART));
    let Some(above) = gap else { return Ok(()) };
    let found = count_below(pencil, ordering, f64::midpoint(frequencies[above - 1], frequencies[above]))?;
    if found == above {
        return Ok(());
    }
    let what = format!(
        "{above} real modes were found below {:.1} Hz, where there are {found}: ask for a few more or fewer modes",
        frequencies[above]
    );
    Err(Error::Solver { what })
}

/// Which shapes are made: those asked for of all modes, else those of the modes with a transition, at the first coefficient of friction and
/// at the last one at which one of them grows.
fn wanted(study: &Study, modes: &[Mode], transitions: &[Transition], damped: bool) -> Vec<(usize, usize)> {
    let asked = &study.document.output.shapes_at;
    if !asked.is_empty() {
        let index = |mu: &f64| study.mus.iter().position(|known| (known - mu).abs() <= 1e-12);
        return asked
            .iter()
            .filter_map(index)
            .flat_map(|i| (0..modes.len()).map(move |mode| (mode, i)))
            .filter(|(mode, _)| super::band::in_band(study, &modes[*mode]))
            .collect();
    }
    let mut concerned: Vec<usize> = transitions.iter().flat_map(|t| t.modes.iter().copied()).collect();
    concerned.sort_unstable();
    concerned.dedup();
    // Where any of them is unstable for the last time.
    let unstable = |i: usize| concerned.iter().any(|mode| grows(modes[*mode].states[i].lambda, damped));
    let mut ends = vec![0];
    ends.extend((1..study.mus.len()).rfind(|i| unstable(*i)));
    ends.into_iter().flat_map(|i| concerned.iter().map(move |mode| (*mode, i))).collect()
}

fn shapes(
    numbering: &Numbering,
    basis: &Basis,
    slope: &Rows,
    study: &Study,
    modes: &[Mode],
    wanted: &[(usize, usize)],
) -> Result<Vec<Shape>, Error> {
    let mut found = Vec::with_capacity(wanted.len());
    for (mode, i) in wanted {
        let (mu, state) = (study.mus[*i], &modes[*mode].states[*i]);
        let all = pairs(&basis.at(mu, slope))?;
        let apart = |lambda: c64| (lambda - state.lambda).norm();
        let Some(pair) = all.iter().min_by(|a, b| apart(a.lambda).total_cmp(&apart(b.lambda))) else {
            continue;
        };
        let [real, imaginary] = lift(basis, &pair.vector).map(|part| numbering.spread(&part));
        let raw = real.iter().zip(&imaginary).map(|(a, b)| [0, 1, 2].map(|i| c64::new(a[i], b[i])));
        found.push(Shape { mu, mode: *mode, lambda: state.lambda, displacement: turned(raw.collect()) });
    }
    Ok(found)
}

/// The same mode with a largest component of 1.
fn turned(raw: Vec<[c64; 3]>) -> Vec<[c64; 3]> {
    let largest = raw.iter().flatten().copied().max_by(|a, b| a.norm().total_cmp(&b.norm()));
    match largest.filter(|z| z.norm() > 0.0) {
        Some(largest) => raw.into_iter().map(|u| u.map(|z| z / largest)).collect(),
        None => raw,
    }
}
