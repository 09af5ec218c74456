//! The hunts of a batch for their cycles: the flights of all of them together, in double precision.

use crate::engine::cycle::candidate::{CLOSES, Cycle};
use crate::engine::cycle::hunt::Hunt;
use crate::engine::cycle::point::{Freedom, Point, Return};
use crate::engine::cycle::pursuit::{GROWS, MANY, Pursuit, STEPS_PER_PERIOD, TOLERANCE};
use crate::engine::kernel::scalar::Real;
use crate::engine::lanes::contact::FREE;
use crate::engine::lanes::contact::State;
use crate::engine::lanes::flight::state_at;
use crate::engine::lanes::job::{Job, Part};
use crate::engine::lanes::march::Settings;
use crate::engine::lanes::{Lanes, ORDER};
use crate::engine::method::pace::Turns;
use crate::engine::outcome::Outcome;
use crate::engine::plan::Plan;
use crate::model::instance::Instance;
use crate::model::status::Status;

/// The hunts of some runs.
pub struct Hunts<'a> {
    runs: Vec<Run>,
    /// Whether the runs are all those of single masses.
    single: bool,
    settings: Settings<'a>,
    plan: Plan,
}

/// The hunts of one run.
#[derive(Default)]
struct Run {
    pursuit: Pursuit,
    /// Its instance, ready to fly.
    craft: Option<Job<f64>>,
    found: Option<Outcome>,
    /// Whether it has settled without, and leaves no unstable cycle.
    has_settled: bool,
    /// Steps and scaled time of all flights.
    flown: (u64, f64),
}

impl<'a> Hunts<'a> {
    /// None so far.
    #[must_use]
    pub fn new(count: usize, single: bool, settings: Settings<'a>) -> Hunts<'a> {
        let plan =
            Plan { steps_per_period: settings.plan.steps_per_period.max(STEPS_PER_PERIOD), ..*settings.plan };
        Hunts { runs: (0..count).map(|_| Run::default()).collect(), single, settings, plan }
    }

    /// What a run came to, where its cycle was found.
    #[must_use]
    pub fn found(&self, index: usize) -> Option<Outcome> {
        self.runs[index].found
    }

    /// Looks for the cycles of those jobs that may be close to one. True when some have put off their windows, to look once
    /// more before.
    pub fn hunt<T: Lanes>(&mut self, jobs: &mut [Job<T>], instances: &[&Instance]) -> bool {
        let prey: Vec<usize> =
            (0..jobs.len()).filter(|at| jobs[*at].may_cycle() && self.runs[*at].pursuit.goes_on()).collect();
        let transients = self.go_on(&prey, jobs, instances);
        let cycles = self.cycles(&prey, &transients, jobs);
        let mut waits = false;
        for (at, job) in jobs.iter_mut().enumerate() {
            // Before its first event a motion may only be growing.
            let grows = job.runs() && !job.may_cycle();
            let early = self.runs[at].pursuit.goes_on() && job.marks[0] < GROWS;
            waits |= grows && early && job.wait(GROWS - job.time);
        }
        for (at, outcome) in prey.iter().zip(self.outcomes(&prey, cycles, jobs)) {
            jobs[*at].is_over = outcome.is_some();
            self.runs[*at].found = outcome;
            if outcome.is_none() {
                waits |= jobs[*at].wait(self.runs[*at].pursuit.wait());
            }
        }
        waits
    }

    /// Looks at those jobs whose windows agree since they were last looked at. What leaves an unstable cycle, about which it may turn
    /// for long, goes on; true when there is one.
    pub fn doubt<T: Lanes>(&mut self, jobs: &mut [Job<T>], instances: &[&Instance]) -> bool {
        let settled: Vec<usize> = (0..jobs.len())
            .filter(|at| jobs[*at].may_cycle() && jobs[*at].has_settled() && !self.runs[*at].has_settled)
            .collect();
        let flown = self.ahead(&settled, jobs, instances, |_| MANY);
        let mut hunts = Vec::new();
        for (at, flown) in settled.iter().zip(&flown) {
            let Some(returns) = flown.first().and_then(Job::returned) else { continue };
            let (freedom, belt) = (freedom(&jobs[*at], returns), jobs[*at].scene.belt(0.0).velocity);
            let hunt = self.runs[*at].pursuit.doubts(returns, freedom, belt);
            hunts.extend(hunt.map(|hunt| (*at, hunt)));
        }
        self.hunt_down(hunts);
        let mut goes_on = false;
        for (at, flown) in settled.iter().zip(&flown) {
            let run = &mut self.runs[*at];
            let leaves = |returns| run.pursuit.leaves(returns);
            run.has_settled = !flown.first().and_then(Job::returned).is_some_and(leaves);
            goes_on |= !run.has_settled && jobs[*at].reopen();
        }
        goes_on
    }

    /// The cycles that some jobs come to, as their `transients` show.
    fn cycles<T: Real>(
        &mut self,
        prey: &[usize],
        transients: &[Option<Vec<Return>>],
        jobs: &[Job<T>],
    ) -> Vec<Option<Cycle>> {
        let mut hunts: Vec<(usize, Hunt)> = Vec::new();
        for (at, transient) in prey.iter().zip(transients) {
            let Some(returns) = transient else { continue };
            let freedom = freedom(&jobs[*at], returns);
            let (now, belt) = (jobs[*at].time, jobs[*at].scene.belt(0.0).velocity);
            let hunt = self.runs[*at].pursuit.begin(returns, freedom, now, belt);
            hunts.extend(hunt.map(|hunt| (*at, hunt)));
        }
        self.hunt_down(hunts);
        let ways = prey.iter().zip(transients).map(|(at, transient)| {
            let way = self.runs[*at].pursuit.way(transient.as_ref()?, jobs[*at].time);
            way.map(|(points, returns)| (*at, points, returns))
        });
        let ways: Vec<Option<(usize, Vec<Point>, usize)>> = ways.collect();
        let asked: Vec<_> = ways
            .iter()
            .flatten()
            .map(|(at, points, returns)| (*at, points.iter().map(state_at).collect(), *returns))
            .collect();
        let mut flown = self.fly(&asked).into_iter();
        ways.into_iter()
            .map(|way| {
                let (at, points, _) = way?;
                let flights = flown.next()?;
                let returns: Vec<_> = flights.iter().map(Job::returned).collect();
                self.runs[at].pursuit.arrives(&points, &returns)
            })
            .collect()
    }

    /// Follows what hunts ask for until they have their candidates, or none.
    fn hunt_down(&mut self, mut hunts: Vec<(usize, Hunt)>) {
        let mut next: Vec<_> = hunts.iter().map(|(_, hunt)| hunt.request()).collect();
        while !hunts.is_empty() {
            let mut asked = Vec::new();
            let mut on = Vec::new();
            for ((at, hunt), next) in hunts.into_iter().zip(next) {
                if let Some((points, returns)) = self.runs[at].pursuit.take(next) {
                    asked.push((at, points.iter().map(state_at).collect(), returns));
                    on.push((at, hunt));
                }
            }
            let flown = self.fly(&asked);
            hunts = on;
            next = hunts
                .iter_mut()
                .zip(flown)
                .map(|((_, hunt), flown)| {
                    let returns = flown.iter().map(|flight| flight.returned().map(<[_]>::to_vec));
                    hunt.take(returns.collect::<Option<Vec<_>>>().as_deref())
                })
                .collect();
        }
    }

    /// Lets some jobs go on for some returns, which it gives.
    fn go_on<T: Lanes>(
        &mut self,
        prey: &[usize],
        jobs: &mut [Job<T>],
        instances: &[&Instance],
    ) -> Vec<Option<Vec<Return>>> {
        let flown = self.ahead(prey, jobs, instances, Pursuit::looks_at);
        prey.iter()
            .zip(flown)
            .map(|(at, flown)| {
                let flight = flown.first()?;
                let returns = flight.returned()?.to_vec();
                // What the flight is counted for goes on as part of the run.
                let (steps, time) = &mut self.runs[*at].flown;
                (*steps, *time) = (*steps - flight.steps, *time - flight.time);
                jobs[*at].go_on_from(flight);
                Some(returns)
            })
            .collect()
    }

    /// Follows some jobs from where they are for some returns each.
    fn ahead<T: Lanes>(
        &mut self,
        prey: &[usize],
        jobs: &[Job<T>],
        instances: &[&Instance],
        count: impl Fn(&Pursuit) -> usize,
    ) -> Vec<Vec<Job<f64>>> {
        let turns = Turns::new(ORDER, TOLERANCE);
        let mut asked = Vec::with_capacity(prey.len());
        for at in prey {
            let run = &mut self.runs[*at];
            let scene = || jobs[*at].scene.clone();
            run.craft.get_or_insert_with(|| Job::new(instances[*at], scene(), &self.plan, &turns));
            asked.push((*at, vec![jobs[*at].exact_state()], count(&run.pursuit)));
        }
        self.fly(&asked)
    }

    /// Follows states of some jobs for some returns each.
    fn fly(&mut self, asked: &[(usize, Vec<State<f64>>, usize)]) -> Vec<Vec<Job<f64>>> {
        let mut flights: Vec<Job<f64>> = Vec::new();
        for (at, states, returns) in asked {
            let Some(craft) = &self.runs[*at].craft else { continue };
            flights.extend(states.iter().map(|state| craft.flying(*state, *returns)));
        }
        self.run(&mut flights, Part::Return);
        let mut flights = flights.into_iter();
        asked
            .iter()
            .map(|(at, states, _)| {
                let some: Vec<Job<f64>> = flights.by_ref().take(states.len()).collect();
                let (steps, time) = &mut self.runs[*at].flown;
                for flight in &some {
                    *steps += flight.steps;
                    *time += flight.time;
                }
                some
            })
            .collect()
    }

    fn run(&self, flights: &mut [Job<f64>], part: Part) {
        let settings = Settings { plan: &self.plan, tolerance: TOLERANCE, ..self.settings };
        <f64 as Lanes>::run(flights, &[part], self.single, settings);
    }

    /// The outcomes of jobs on their cycles: one period of each is measured.
    fn outcomes<T: Real>(
        &mut self,
        prey: &[usize],
        cycles: Vec<Option<Cycle>>,
        jobs: &[Job<T>],
    ) -> Vec<Option<Outcome>> {
        let found: Vec<(usize, Cycle)> =
            prey.iter().zip(cycles).filter_map(|(at, cycle)| Some((*at, cycle?))).collect();
        let ready = found.iter().filter_map(|(at, cycle)| {
            let mut job = self.runs[*at].craft.as_ref()?.flying(state_at(&cycle.start), 0);
            job.growing = false;
            job.seen.growth = jobs[*at].seen.growth;
            job.open_period(cycle.period);
            Some(job)
        });
        let mut measured: Vec<Job<f64>> = ready.collect();
        self.run(&mut measured, Part::Window);
        for (job, (_, cycle)) in measured.iter_mut().zip(&found) {
            let ended = job.state.status == Status::Unwritten;
            job.is_over = !(ended && cycle.closes(job.state.body.p, job.state.body.v, CLOSES));
            job.close_period();
        }
        self.run(&mut measured, Part::Phase);
        let mut outcomes = prey.iter().map(|_| None).collect::<Vec<_>>();
        for (job, (at, cycle)) in measured.iter().zip(&found) {
            let Some(place) = prey.iter().position(|prey| prey == at).filter(|_| !job.is_over) else {
                continue;
            };
            let (steps, time) = self.runs[*at].flown;
            let units = &jobs[*at].scene.units;
            let outcome = job.outcome(&self.plan);
            outcomes[place] = (outcome.status == Status::Ok).then(|| Outcome {
                steps: jobs[*at].steps + steps + job.steps,
                simulated_time: (jobs[*at].time + time + 2.0 * cycle.period) * units.time,
                ..outcome.on_cycle(cycle, jobs[*at].time, units)
            });
        }
        outcomes
    }
}

/// The free coordinates of a job whose last returns these are: each its own, whatever its neighbours are.
fn freedom<T: Real>(job: &Job<T>, returns: &[Return]) -> Freedom {
    Freedom::of(&returns[returns.len() - 1].point, job.scene.model.s == 0.0, FREE)
}

impl<T: Real> Job<T> {
    /// Whether it is on its way.
    fn runs(&self) -> bool {
        self.state.status == Status::Unwritten && !self.is_over
    }

    /// Whether it may be on its way to a cycle, or has come there: it has met an event, or may oscillate without.
    fn may_cycle(&self) -> bool {
        self.runs() && (!self.growing || !self.law().is_straight()) && self.time > 0.0
    }
}
