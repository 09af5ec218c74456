//! Random sweeps of one instance as TOML, every number from the whole of its range.

use proptest::prelude::*;

/// A positive number about `usual`, within nine decades of it, or any.
fn positive(usual: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        8 => (-2.0..2.0_f64).prop_map(move |decades| usual * 10_f64.powf(decades)),
        3 => (-9.0..9.0_f64).prop_map(move |decades| usual * 10_f64.powf(decades)),
        1 => prop_oneof![
            (-307.0..308.0_f64).prop_map(|decades| 10_f64.powf(decades)),
            Just(f64::MAX),
            Just(f64::MIN_POSITIVE),
            Just(5e-324),
        ],
    ]
}

/// The same or 0.
fn not_negative(usual: f64) -> impl Strategy<Value = f64> {
    prop_oneof![8 => positive(usual), 1 => Just(0.0)]
}

/// The same with either sign.
fn any_sign(usual: f64) -> impl Strategy<Value = f64> {
    (not_negative(usual), any::<bool>()).prop_map(|(size, falls)| if falls { -size } else { size })
}

fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -0.6..0.6_f64,
        2 => -1.57..1.57_f64,
        1 => Just(0.0),
        1 => (-300.0..-1.0_f64).prop_map(|decades| 10_f64.powf(decades)),
        1 => prop_oneof![Just(1.570_796_326_794_896_2), Just(-1.570_796_326_794_896_2), Just(1.57)],
    ]
}

fn model() -> impl Strategy<Value = String> {
    (
        (positive(2.12), positive(0.18), positive(1e5), positive(1e5)),
        (not_negative(0.1), not_negative(0.1), positive(1000.0), angle()),
        (prop_oneof![Just(0.0), 0.0..=1.0_f64, Just(1.0)], any::<bool>()),
    )
        .prop_map(|((m1, m2, k1, k2), (c1, c2, force, theta), (restitution, friction))| {
            format!(
                "[model]\nm1 = {m1:e}\nm2 = {m2:e}\nk1 = {k1:e}\nk2 = {k2:e}\nc1 = {c1:e}\nc2 = {c2:e}\n\
                 f_ext = {force:e}\ntheta = {theta:e}\nrestitution = {restitution:e}\nimpact_friction = {friction}\n"
            )
        })
}

fn friction() -> impl Strategy<Value = String> {
    (0..4_u8, not_negative(0.3), not_negative(0.3), positive(1.0)).prop_map(|(law, mu_s, mu_d, scale)| {
        let both = format!("mu_s = {mu_s:e}\nmu_d = {mu_d:e}\n");
        let rest = match law {
            0 => format!("law = \"constant\"\n{both}"),
            1 => format!("law = \"bilinear\"\n{both}knee_velocity = {scale:e}\n"),
            2 => format!("law = \"exponential\"\n{both}stribeck_velocity = {scale:e}\n"),
            _ => format!("law = \"rational\"\nmu_s = {mu_s:e}\ndecay = {scale:e}\n"),
        };
        format!("[friction]\n{rest}")
    })
}

/// Whether there is a ramp, and the section.
fn belt() -> impl Strategy<Value = (bool, String)> {
    let ramp = prop::option::weighted(0.25, (not_negative(1.0), positive(0.1)));
    (not_negative(1.0), ramp).prop_map(|(velocity, ramp)| {
        let ramps = ramp.map_or_else(String::new, |(end, duration)| {
            format!("belt_velocity_end = {end:e}\nramp_duration = {duration:e}\n")
        });
        (ramp.is_some(), format!("[belt]\nbelt_velocity = {velocity:e}\n{ramps}"))
    })
}

fn start() -> impl Strategy<Value = String> {
    prop_oneof![
        (any_sign(0.1), any_sign(1e-3)).prop_map(|(velocity, displacement)| {
            format!("[start]\nkind = \"kick\"\nstart_velocity = {velocity:e}\nstart_displacement = {displacement:e}\n")
        }),
        positive(0.1).prop_map(|share| format!("[start]\nkind = \"mode\"\nstart_fraction = {share:e}\n")),
        (0.001..0.999_f64)
            .prop_map(|share| format!("[start]\nkind = \"mode\"\nstart_event_fraction = {share:e}\n")),
    ]
}

/// A run for a fixed time, on a belt with a ramp, where nothing settles.
const FIXED: &str = "[response]\nsettle = \"2 periods\"\nmeasure = \"3 periods\"\n";

/// Whether it goes on until settled, and the section: short runs, the shorter the finer their steps.
fn response() -> impl Strategy<Value = (bool, String)> {
    let steps = prop_oneof![4 => 4..100_u32, 1 => 100..100_001_u32];
    // Any number of seconds, too, as far as a sweep may ask for it.
    let seconds = prop::option::weighted(0.1, (not_negative(1e-2), positive(1e-2)));
    (steps, 0.0..20.0_f64, 0.01..20.0_f64, prop::bool::weighted(0.15), seconds).prop_map(
        |(steps, settle, measure, auto, seconds)| {
            let shorter = (100.0 / f64::from(steps)).min(1.0);
            let (settle, measure, auto) = (settle * shorter, measure * shorter, auto && steps < 100);
            let limit = format!("{} periods", settle + 0.1);
            let [settle, measure] = match seconds {
                Some((settle, measure)) => [settle, measure].map(|time| format!("{:e} s", time.min(1e9))),
                None => [settle, measure].map(|count| format!("{count} periods")),
            };
            let settle = if auto {
                format!("settle = \"auto\"\nsettle_limit = \"{limit}\"\n")
            } else {
                format!("settle = \"{settle}\"\n")
            };
            (auto, format!("[response]\n{settle}measure = \"{measure}\"\nsteps_per_period = {steps}\n"))
        },
    )
}

/// A valid sweep of one instance in parts: what instances of one sweep may differ in, model and friction and belt, and
/// what they share.
pub(crate) fn parts() -> impl Strategy<Value = (String, String)> {
    (model(), friction(), belt(), start(), response()).prop_map(
        |(model, friction, (ramps, belt), start, (auto, response))| {
            let response = if ramps && auto { FIXED.to_owned() } else { response };
            ([model, friction, belt].concat(), start + &response)
        },
    )
}
