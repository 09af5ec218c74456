//! A start on the mode at a fraction of the amplitude of its first event, seen in the reference's trajectory.

use crate::common::near;
use squealmap::model::Param;
use squealmap::study::trace::run::trace;
use squealmap::sweep::spec::Spec;

const FRACTION: f64 = 0.5;

/// Trajectory of the first period: the largest `ẋ2` and the smallest normal force, each over what it may be:
/// the belt velocity, the force at the equilibrium.
fn first_period(mu_s: f64, mu_d: f64, belt_velocity: f64) -> [f64; 2] {
    let text = format!(
        "[friction]\nlaw = \"bilinear\"\nmu_s = {mu_s}\nmu_d = {mu_d}\n[belt]\nbelt_velocity = {belt_velocity}\n\
         [start]\nkind = \"mode\"\nstart_event_fraction = {FRACTION}\n\
         [response]\nsettle = \"0 s\"\nmeasure = \"1 periods\"\n[axes]\ntheta = {{ values = [0.01] }}\n"
    );
    let spec = Spec::parse(&text, "s.toml", std::path::Path::new(".")).expect("a valid sweep");
    let trace = trace(&spec, &spec.instance(0), 400);
    let equilibrium = spec.instance(0).params.get(Param::FExt).expect("a force");
    let velocity = trace.rows.iter().map(|row| row.velocity[0]).fold(f64::MIN, f64::max);
    let force = trace.rows.iter().map(|row| row.normal_force).fold(f64::MAX, f64::min);
    [velocity / belt_velocity, force / equilibrium]
}

#[test]
fn the_first_event_is_named_by_what_limits_the_motion() {
    // Slow belt: the mass comes to rest on it before anything else.
    let [velocity, force] = first_period(0.2, 0.2, 0.1);
    near("belt velocity", velocity, FRACTION, 0.01);
    assert!(force > 0.5);
    // Fast belt, much friction: the contact opens.
    let [velocity, force] = first_period(0.8, 0.8, 60.0);
    near("normal force", force, 1.0 - FRACTION, 0.06);
    assert!(velocity < 0.5 * FRACTION, "{velocity}");
    // Just above the knee of the law.
    let [velocity, _] = first_period(0.1, 0.05, 5.4);
    near("knee", velocity * 5.4, FRACTION * 0.4, 0.01);
}
