//! The rows of the table of output columns, in the order of `map.csv`.
//!
//! A row: the analysis that has the column, its name and unit, where its values stand in a record, its name in print (long,
//! and short where that is another; symbols stand in braces), its meaning, and what more is to be said of it. Nothing else
//! lists columns.

use crate::engine::record::{By, Check, Record};
use crate::engine::regime::Regime;
use crate::model::kind::InstabilityType;
use crate::model::status::Status;
use crate::sweep::columns::class::Class;
use crate::sweep::columns::column::{Column, Group, Reading};
use crate::sweep::columns::values::Values::{Count, Flag, Name, Number, Share, Summary};
use crate::sweep::columns::values::{Kept, Place};

/// Types of instability.
pub static TYPE: Class = Class {
    first: 1,
    always: false,
    name: |position| InstabilityType::ALL.get(position).map(|kind| kind.name()),
    get: |record| record.kind.map(|kind| kind as usize),
    put: |record, position| record.kind = position.and_then(|at| InstabilityType::ALL.get(at).copied()),
};

/// Regimes.
pub static REGIME: Class = Class {
    first: 1,
    always: false,
    name: |position| Regime::ALL.get(position).map(|regime| regime.name()),
    get: |record| record.regime.map(|regime| regime as usize),
    put: |record, position| record.regime = position.and_then(|at| Regime::ALL.get(at).copied()),
};

/// How an instance has ended.
pub static STATUS: Class = Class {
    first: 1,
    always: true,
    name: |position| Status::IN_MAP.get(position).map(|status| status.name()),
    get: |record| Status::IN_MAP.iter().position(|status| *status == record.status),
    put: |record, position| {
        record.status = position.and_then(|at| Status::IN_MAP.get(at).copied()).unwrap_or_default();
    },
};

// The place of a status in its list is its code less that of the first.
const _: () = {
    let mut place = 0;
    while place < Status::IN_MAP.len() {
        assert!(Status::IN_MAP[place] as usize == place + 1);
        place += 1;
    }
};

/// How a response was found. Tiles tell it by the multiplier.
static FOUND_BY: Class = Class {
    first: 0,
    always: false,
    name: |position| ["integration", "shooting"].get(position).copied(),
    get: |record| {
        record
            .outcome
            .as_ref()
            .filter(|_| record.regime.is_some())
            .map(|outcome| usize::from(outcome.floquet.is_some()))
    },
    put: |_, _| {},
};

/// How many periods a small disturbance lasts, from the multiplier.
const DISTURBANCE: Place = Place {
    get: |record| record.outcome.as_ref()?.floquet.map(|floquet| -1.0 / floquet.ln()),
    put: |_, _| {},
};

/// A class of two: no and yes, as they are called.
macro_rules! flag {
    ($name:ident $field:ident $no:literal $yes:literal) => {
        static $name: Class = Class {
            first: 0,
            always: false,
            name: |position| [$no, $yes].get(position).copied(),
            get: |record| record.$field.map(usize::from),
            put: |record, position| record.$field = position.map(|position| position == 1),
        };
    };
}

flag!(SETTLED settled "unsettled" "settled");
flag!(BISTABLE bistable "monostable" "bistable");

/// A field of a part of a record.
macro_rules! field {
    ($part:ident $field:ident) => {
        Place {
            get: |record| record.$part.as_ref().and_then(|part| part.$field.number()),
            put: |record, number| {
                if let Some(part) = &mut record.$part {
                    part.$field = Kept::kept(number);
                }
            },
        }
    };
}

/// By what an instance was checked, and whether its record was taken from the check.
fn checked(record: &Record) -> Option<u64> {
    record.check.map(|check| match check {
        Check { by: By::Reference, .. } => 3,
        Check { taken: true, .. } => 2,
        Check { taken: false, .. } => 1,
    })
}

macro_rules! table {
    ($($group:ident $name:literal $unit:literal $values:expr, [$($print:literal),+], $meaning:literal $(.$more:ident($($how:expr)?))*;)*) => {
        /// What is computed of an instance.
        pub(super) static COMPUTED: &[Column] = &[$(
            Column::new(Group::$group, $name, $unit, $values, &[$($print),+], $meaning)$(.$more($($how)?))*
        ),*];

        /// Columns of the large start.
        pub(super) static LARGE: &[Column] = &[$(
            Column::new(
                Group::$group,
                concat!($name, "_large"),
                $unit,
                $values,
                &[$($print),+],
                concat!("from the large start: ", $meaning),
            )$(.$more($($how)?))*.of_large_start()
        ),*];
    };
}

table! {
    Linear "type" "" Name(&TYPE), ["Type"], "type of instability by complex eigenvalues and attribution";
    Linear "growth_rate" "1/s" Number(field!(linear growth_rate)), ["Growth rate {σ}", "{σ}"], "largest real part of the eigenvalues, both mechanisms present".read_by(Reading::Sign);
    Linear "frequency" "Hz" Number(field!(linear frequency)), ["Frequency of the least stable mode", "{f}"], "imaginary part of that eigenvalue over 2 pi; empty where nothing damps and nothing grows, as no mode leads there";
    Linear "phase" "deg" Number(field!(linear phase)), ["Phase of {ÿ_1} against {ẍ_2} in the mode", "{φ}, mode"], "phase of y1'' against x2'' in that mode; negative when y1'' lags";
    Linear "growth_rate_flat" "1/s" Number(field!(linear growth_rate_flat)), ["Growth rate without the friction slope", "{σ}, no slope"], "growth rate with the friction slope set to 0 (mode coupling alone)".read_by(Reading::Sign);
    Linear "growth_rate_frozen" "1/s" Number(field!(linear growth_rate_frozen)), ["Growth rate at constant normal force", "{σ}, constant {N}"], "growth rate with the normal force frozen (negative slope alone)".read_by(Reading::Sign);
    Response "regime" "" Name(&REGIME), ["Regime"], "what the system does in the measuring window";
    Response "x2_mean" "m" Number(field!(outcome x2_mean)), ["Mean of {x_2}"], "mean of x2".window();
    Response "x2_std" "m" Number(field!(outcome x2_std)), ["Standard deviation of {x_2}", "Std. of {x_2}"], "standard deviation of x2".vibration();
    Response "y1_mean" "m" Number(field!(outcome y1_mean)), ["Mean of {y_1}"], "mean of y1".window();
    Response "y1_std" "m" Number(field!(outcome y1_std)), ["Standard deviation of {y_1}", "Std. of {y_1}"], "standard deviation of y1".vibration();
    Response "ax_rms" "m/s^2" Number(field!(outcome ax_rms)), ["Root mean square of {ẍ_2}", "Rms of {ẍ_2}"], "root mean square of x2''".vibration();
    Response "ay_rms" "m/s^2" Number(field!(outcome ay_rms)), ["Root mean square of {ÿ_1}", "Rms of {ÿ_1}"], "root mean square of y1''".vibration();
    Response "ax_peak" "m/s^2" Number(field!(outcome ax_peak)), ["Largest |{ẍ_2}|"], "largest |x2''|".vibration();
    Response "ay_peak" "m/s^2" Number(field!(outcome ay_peak)), ["Largest |{ÿ_1}|"], "largest |y1''|".vibration();
    Response "friction_mean" "" Number(field!(outcome friction_mean)), ["Mean friction coefficient {T}/{N}", "Mean {T}/{N}"], "time integral of T over time integral of N, as they are between impacts, whose impulses are left out".window();
    Response "n_peak" "N" Number(field!(outcome n_peak)), ["Largest normal force {N}", "Largest {N}"], "largest normal force".window();
    Response "response_frequency" "Hz" Number(field!(outcome response_frequency)), ["Response frequency", "{f}, response"], "upward zero crossings of x2' over the time from the first to the last; while the temperature changes, less the drift of the equilibrium".window();
    Response "phase_cycle" "deg" Number(field!(outcome phase_cycle)), ["Phase of {ÿ_1} against {ẍ_2} in the response", "{φ}, response"], "phase of y1'' against x2'' at the response frequency".window();
    Response "growth_rate_measured" "1/s" Number(field!(outcome growth_rate_measured)), ["Growth rate before the first event", "{σ}, measured"], "growth rate before the first event, of all modes that the start excites; none where a curved law limits the motion without one".read_by(Reading::Sign);
    Response "frequency_measured" "Hz" Number(field!(outcome frequency_measured)), ["Frequency before the first event", "{f}, measured"], "frequency before the first contact event";
    Response "phase_measured" "deg" Number(field!(outcome phase_measured)), ["Phase of {ÿ_1} against {ẍ_2} before the first event", "{φ}, measured"], "phase of y1'' against x2'' before the first contact event";
    Response "stick" "" Number(field!(outcome stick)), ["Fraction of time in stick", "Stick"], "fraction of the window in stick".window();
    Response "free" "" Number(field!(outcome free)), ["Fraction of time in free flight", "Free flight"], "fraction of the window in free flight".window();
    Response "reverse" "" Number(field!(outcome reverse)), ["Fraction of time in reversed slip", "Reversed slip"], "fraction of the window in reversed slip".window();
    Response "impacts_per_second" "1/s" Number(field!(outcome impacts_per_second)), ["Impacts per second", "Impacts"], "impacts per second, counting every bounce down to a rebound of 1e-6 ω0 F_ext/k2".window();
    Response "energy_gaining_impacts" "" Count(field!(outcome energy_gaining_impacts)), ["Impacts that gained energy"], "impacts of the whole run that gained energy; only the reference counts them".hidden();
    Response "settled" "" Flag(&SETTLED), ["Settled"], "1 when the two halves of the window agree (until settled: when the windows do), else 0";
    Settling "settling_time" "s" Number(field!(outcome settling_time)), ["Settling time"], "start of the last window of a run until settled";
    Cycles "found_by" "" Name(&FOUND_BY), ["Found by"], "how the response was found: shooting (a fixed point of the return map, the window is one period) or integration (as settle auto)";
    Cycles "period" "s" Number(field!(outcome period)), ["Period {T} of the limit cycle", "{T}"], "period of the limit cycle that shooting found";
    Cycles "cycle_returns" "" Count(field!(outcome cycle_returns)), ["Returns in a period"], "upward zero crossings of x2' in a period: more than 1 after a period doubling, or with several impacts";
    Cycles "floquet" "" Number(field!(outcome floquet)), ["Largest Floquet multiplier {|λ|}", "{|λ|}"], "largest modulus of the Floquet multipliers: what is left of a small disturbance after one period";
    Cycles "floquet_angle" "deg" Number(field!(outcome floquet_angle)), ["Angle of that multiplier"], "its angle, 0 to 180: a stable cycle ends at 0 by a fold, at 180 by a period doubling, else in a torus".read_by(Reading::HalfTurn);
    Cycles "disturbance_periods" "" Number(DISTURBANCE), ["Periods that a disturbance lasts", "Memory"], "periods after which a small disturbance has fallen to 1/e, -1/ln(floquet)".read_by(Reading::Ratios);
    Checks "checked" "" Summary(checked), ["Checked"], "1: computed again in f64 with fine steps; 2: the same, and near a border between labels, so that the row is that result; 3: computed again by the reference; else empty";
    Checks "check_error" "" Number(field!(check error)), ["Relative error that a check found", "Error"], "worst relative error of x2_std, ax_rms, ay_rms and response_frequency against that, of a settled oscillation";
    Response "simulated_time" "s" Number(field!(outcome simulated_time)), ["Simulated time"], "simulated time";
    Response "steps" "" Count(field!(outcome steps)), ["Steps"], "steps taken, those ended by an event included";
    Starts "bistable" "" Flag(&BISTABLE), ["Bistable"], "1 where starts end differently: in sliding, in an oscillation, stuck, or (small and large) in oscillations with amplitudes more than 5 % apart; empty where one has not settled";
    Basin "basin_equilibrium" "" Share(|basin| &mut basin.equilibrium), ["Starts in a box that end in sliding", "Sliding"], "fraction p of the starts in the box that end in a stable sliding equilibrium; its standard error is sqrt(p (1 - p)/box_samples)";
    Basin "basin_oscillation" "" Share(|basin| &mut basin.oscillation), ["Starts in a box that end in oscillation", "Oscillation"], "fraction p of the starts in the box that end in a settled oscillation; its standard error is sqrt(p (1 - p)/box_samples)";
    Basin "basin_other" "" Share(|basin| &mut basin.other), ["Starts in a box that end otherwise", "Otherwise"], "fraction of the starts in the box that end stuck or have not settled";
    Basin "basin_failed" "" Share(|basin| &mut basin.failed), ["Starts in a box that failed", "Failed"], "fraction of the starts in the box whose response failed";
    Always "status" "" Name(&STATUS), ["Status"], "how the instance ended; not_computed: the run was stopped before it";
}
