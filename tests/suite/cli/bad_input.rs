//! Bad input: one sentence that says where, names key, value and limit, and what to do.

#![expect(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use std::path::Path;

use squealmap::sweep::spec::Spec;

const VALID: &str = "[friction]\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";

/// The message of a text that has to be refused.
fn refused(text: &str) -> String {
    refused_in(text, Path::new(""))
}

fn refused_in(text: &str, directory: &Path) -> String {
    let error = Spec::parse(text, "s.toml", directory).map(|_| ()).expect_err("the input is bad");
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message}");
    assert!(error.is_bad_input(), "{message}");
    if let Some(place) = error.place() {
        assert!(place.text().get(place.span()).is_some(), "{message}");
    }
    message
}

/// A sweep with files beside it.
fn refused_with(text: &str, files: &[(&str, &str)]) -> String {
    let directory = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(directory.path().join(name), content).unwrap();
    }
    let message = refused_in(text, directory.path());
    message.replace(&format!("{}/", directory.path().display()), "")
}

macro_rules! refuses {
    ($($name:ident: $text:expr => $message:expr;)*) => {
        $(#[test]
        fn $name() {
            assert_eq!(refused(&$text), $message);
        })*
    };
}

refuses! {
    unknown_key: "[friction]\nlaw = \"bilinear\"\nknee = 5\n"
        => "s.toml:3:1: unknown key `knee` in [friction]; did you mean `knee_velocity`?";
    unknown_key_of_another_section: "[model]\nmu_s = 0.4\n"
        => "s.toml:2:1: unknown key `mu_s` in [model]; it belongs to [friction]";
    unknown_section: "[modle]\nm1 = 2\n"
        => "s.toml:1:2: unknown key `modle` at the top level; did you mean `model`?";
    unknown_response_key: "[response]\nmesure = \"3 s\"\n"
        => "s.toml:2:1: unknown key `mesure` in [response]; did you mean `measure`?";
    unknown_law: "[friction]\nlaw = \"bilinaer\"\n"
        => "s.toml:2:7: unknown law `bilinaer` as `law` in [friction]; did you mean `bilinear`?";
    unknown_axis: "[axes]\nbelt_velocty = { values = [1] }\n"
        => "s.toml:2:1: unknown axis `belt_velocty` in [axes]; did you mean `belt_velocity`?";
    axis_that_cannot_vary: "[axes]\nsettle = { values = [1] }\n"
        => "s.toml:2:1: unknown axis `settle` in [axes]; this key holds for the whole sweep and cannot vary";
    unknown_axis_key: "[axes]\nmu_s = { from = 0, to = 1, steps = 3 }\n"
        => "s.toml:2:28: unknown key `steps` of axis `mu_s`; choose from from, to, points, scale and values";
    wrong_type_string: "[model]\nk1 = \"stiff\"\n"
        => "s.toml:2:6: `k1` in [model] must be a number, found the string \"stiff\"";
    wrong_type_section: "model = 3\n"
        => "s.toml:1:9: `model` must be a table, written as a line [model] above its keys, found the number 3";
    wrong_type_boolean: "[model]\nimpact_friction = 1\n"
        => "s.toml:2:19: `impact_friction` in [model] must be true or false, found the number 1";
    wrong_type_axis: "[axes]\nmu_s = [0.1, 0.2]\n"
        => "s.toml:2:8: axis `mu_s` must be a table { from, to, points } or { values = [...] }, found an array";
    wrong_type_value: "[axes]\nmu_s = { values = [0.1, \"0.2\"] }\n"
        => "s.toml:2:25: value 2 of axis `mu_s` must be a number, found the string \"0.2\"";
    not_a_number: "[model]\nc1 = nan\n"
        => "s.toml:2:6: `c1` in [model] is nan but must be a finite number not below 0";
    infinite: "[start]\nstart_velocity = -inf\n"
        => "s.toml:2:18: `start_velocity` in [start] is -inf but must be a finite number";
    beyond_floats: "[model]\nk1 = 1e999\n"
        => "s.toml:2:6: `k1` in [model] is 1e999 but must be a finite number greater than 0";
    negative_mass: "[model]\n  m1 = -1\n"
        => "s.toml:2:8: `m1` in [model] is -1 but must be a finite number greater than 0";
    zero_mass: "[model]\nm2 = 0\n"
        => "s.toml:2:6: `m2` in [model] is 0 but must be a finite number greater than 0";
    negative_friction: "[friction]\nmu_s = -0.1\n"
        => "s.toml:2:8: `mu_s` in [friction] is -0.1 but must be a finite number not below 0";
    negative_friction_on_an_axis: "[axes]\nmu_d = { values = [0.1, 0.2, -0.3] }\n"
        => "s.toml:2:30: value 3 of axis `mu_d` is -0.3 but must be a finite number not below 0";
    negative_end_of_an_axis: "[axes]\nmu_d = { from = -0.3, to = 1, points = 5 }\n"
        => "s.toml:2:17: `from` of axis `mu_d` is -0.3 but must be a finite number not below 0";
    restitution_above_one: "[model]\nrestitution = 1.1\n"
        => "s.toml:2:15: `restitution` in [model] is 1.1 but must be between 0 and 1";
    empty_axis: "[axes]\nmu_d = { values = [] }\n"
        => "s.toml:2:19: axis `mu_d` is empty; give at least one value";
    axis_of_no_points: "[axes]\nmu_d = { from = 0, to = 1, points = 0 }\n"
        => "s.toml:2:37: `points` of axis `mu_d` is 0 but must be an integer between 1 and 100000000";
    axis_of_half_points: "[axes]\nmu_d = { from = 0, to = 1, points = 2.5 }\n"
        => "s.toml:2:37: `points` of axis `mu_d` must be an integer between 1 and 100000000, found the number 2.5";
    single_point_of_a_range: "[axes]\nmu_d = { from = 0, to = 1, points = 1 }\n"
        => "s.toml:2:8: axis `mu_d` has 1 point(s) from 0 to 1; give 2 points or more";
    many_points_of_nothing: "[axes]\nmu_d = { from = 1, to = 1, points = 3 }\n"
        => "s.toml:2:8: axis `mu_d` has 3 point(s) from 1 to 1; give 1 point or different ends";
    axis_without_values: "[axes]\nmu_d = { from = 1, points = 3 }\n"
        => "s.toml:2:8: `to` is missing: axis `mu_d` does not say its values, so \
            write { from = …, to = …, points = … } or { values = […] }";
    values_beside_a_range: "[axes]\nmu_d = { values = [1], points = 3 }\n"
        => "s.toml:2:24: `points` of axis `mu_d` stands beside `values` of the same axis; remove one of them";
    log_from_zero: "[axes]\nc1 = { from = 0, to = 1, points = 3, scale = \"log\" }\n"
        => "s.toml:2:15: `from` of axis `c1` is 0 but must be greater than 0 for scale = \"log\"";
    product_overflow: "[axes]\nmu_s = { from = 0, to = 1, points = 100_000 }\nmu_d = { from = 0, to = 1, points = 100_000 }\nbelt_velocity = { from = 1, to = 2, points = 1_000 }\n"
        => "s.toml:4:17: the sweep has at least 10000000000000 instances but at most 1000000000000 are allowed; take fewer points";
    key_in_section_and_axes: format!("{VALID}[axes]\nmu_s = {{ values = [0.1] }}\n")
        => "s.toml:7:1: axis `mu_s` stands beside `mu_s` in [friction]; remove one of them";
    axes_and_points: "points = \"p.csv\"\n[axes]\nmu_s = { values = [0.1] }\n"
        => "s.toml:1:1: `points` stands beside [axes]; remove one of them";
    missing_points_file: "points = \"none.csv\"\n"
        => "s.toml:1:10: cannot read the points file `none.csv`: No such file or directory (os error 2)";
    duplicate_key: "[model]\nm1 = 1\nm1 = 2\n"
        => "s.toml:3:1: not valid TOML: duplicate key";
    no_belt_velocity: "[friction]\nmu_s = 0.4\nmu_d = 0.3\n"
        => "s.toml:1:1: `belt_velocity` is missing: every instance has a belt velocity, so give it in [belt] or vary it";
    missing_law_parameter: "[friction]\nlaw = \"exponential\"\nmu_s = 0.4\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n"
        => "s.toml:1:2: `stribeck_velocity` is missing: law `exponential` needs it, so give it in [friction] or vary it";
    missing_table: "[friction]\nlaw = \"table\"\n[belt]\nbelt_velocity = 3\n"
        => "s.toml:1:2: `table` is missing: law `table` needs it, so write table = \"mu.csv\" in [friction]";
    parameter_of_another_law: format!("{VALID}[axes]\ndecay = {{ values = [3] }}\n")
        => "s.toml:7:1: axis `decay` would have no effect: it is used only by the law rational; remove it or choose that";
    temperature_without_material: VALID.replace("[belt]", "temperature = 300\n[belt]")
        => "s.toml:4:15: `temperature` in [friction] would have no effect: it is used only by a `material`; \
            remove it or choose that";
    fraction_of_a_kick: format!("{VALID}[start]\nstart_fraction = 0.1\n")
        => "s.toml:7:18: `start_fraction` in [start] would have no effect: it is used only by kind = \"mode\" in [start]; \
            remove it or choose that";
    event_fraction_of_a_kick: format!("{VALID}[start]\nstart_event_fraction = 0.1\n")
        => "s.toml:7:24: `start_event_fraction` in [start] would have no effect: it is used only by kind = \"mode\" in \
            [start]; remove it or choose that";
    large_start_of_a_kick: format!("{VALID}[start]\nlarge_velocity = 1\n")
        => "s.toml:7:18: `large_velocity` in [start] would have no effect: it is used only by kind = \"both\" in [start]; \
            remove it or choose that";
    kick_of_a_mode: format!("{VALID}[start]\nkind = \"mode\"\nstart_velocity = 1\n")
        => "s.toml:8:18: `start_velocity` in [start] would have no effect: it is used only by kind = \"kick\", \"both\" or \
            \"box\" in [start]; remove it or choose that";
    box_without_a_bound: format!("{VALID}[start]\nkind = \"box\"\nbox_displacement_from = 0\nbox_displacement_to = 1\nbox_velocity_to = 1\n")
        => "s.toml:6:2: `box_velocity_from` is missing: kind = \"box\" in [start] draws starts between its bounds, so give \
            it in [start] or vary it";
    box_of_both: format!("{VALID}[start]\nkind = \"both\"\nbox_velocity_to = 1\n")
        => "s.toml:8:19: `box_velocity_to` in [start] would have no effect: it is used only by kind = \"box\" in [start]; \
            remove it or choose that";
    samples_of_a_kick: format!("{VALID}[start]\nbox_samples = 10\n")
        => "s.toml:7:15: `box_samples` in [start] would have no effect: it is used only by kind = \"box\" in [start]; \
            remove it or choose that";
    starts_without_a_response: format!("analysis = [\"linear\"]\n{VALID}[start]\nkind = \"both\"\n")
        => "s.toml:8:8: `kind = \"both\"` in [start] would have no effect: it is used only by \"response\" in `analysis`; \
            remove it or choose that";
    no_samples: "[start]\nkind = \"box\"\nbox_samples = 0\n"
        => "s.toml:3:15: `box_samples` in [start] is 0 but must be an integer between 1 and 1000000";
    axis_of_samples: "[axes]\nbox_samples = { values = [1, 2] }\n"
        => "s.toml:2:1: unknown axis `box_samples` in [axes]; this key holds for the whole sweep and cannot vary";
    unknown_start: "[start]\nkind = \"large\"\n"
        => "s.toml:2:8: unknown start `large` as `kind` in [start]; choose from kick, mode, both and box";
    two_fractions: format!("{VALID}[start]\nkind = \"mode\"\nstart_fraction = 0.1\nstart_event_fraction = 0.1\n")
        => "s.toml:8:18: `start_fraction` in [start] would have no effect: it is used only by a mode start without \
            `start_event_fraction`; remove it or choose that";
    event_fraction_of_one: format!("{VALID}[start]\nkind = \"mode\"\nstart_event_fraction = 1\n")
        => "s.toml:8:24: `start_event_fraction` in [start] is 1 but must be strictly between 0 and 1";
    half_a_ramp: format!("{VALID}ramp_duration = 10\n")
        => "s.toml:6:17: `belt_velocity_end` is missing: `ramp_duration` in [belt] describes a ramp, so give both or none, or with a material `temperature_end` and a duration";
    duration_without_unit: "[response]\nsettle = \"6\"\n"
        => "s.toml:2:10: `settle` in [response] is \"6\" but must be \"auto\", \"cycle\" or a string such as \"6 s\" or \"200 periods\", \
            not below 0 and at most 1e9";
    duration_as_number: "[response]\nsettle = 6\n"
        => "s.toml:2:10: `settle` in [response] must be \"auto\", \"cycle\" or a string such as \"6 s\" or \"200 periods\", \
            found the number 6";
    limit_of_a_fixed_time: format!("{VALID}[response]\nsettle = \"6 s\"\nsettle_limit = \"9 s\"\n")
        => "s.toml:8:1: `settle_limit` in [response] would have no effect: it is used only by settle = \"auto\" or \"cycle\" in [response]; \
            remove it or choose that";
    no_limit: format!("{VALID}[response]\nsettle = \"auto\"\nsettle_limit = \"0 s\"\n")
        => "s.toml:8:16: `settle_limit` in [response] is \"0 s\" but must be a string such as \"6 s\" or \"200 periods\", \
            greater than 0 and at most 1e9";
    cycles_on_a_ramp: format!("{VALID}belt_velocity_end = 0.5\nramp_duration = 10\n[response]\nsettle = \"cycle\"\n")
        => "s.toml:9:10: settle = \"cycle\" in [response] stands beside `ramp_duration` in [belt], during which nothing settles; \
            remove one of them";
    settling_on_a_ramp: format!("{VALID}belt_velocity_end = 0.5\nramp_duration = 10\n[response]\nsettle = \"auto\"\n")
        => "s.toml:9:10: settle = \"auto\" in [response] stands beside `ramp_duration` in [belt], during which nothing settles; \
            remove one of them";
    no_measuring_window: "[response]\nmeasure = \"0 s\"\n"
        => "s.toml:2:11: `measure` in [response] is \"0 s\" but must be a string such as \"6 s\" or \"200 periods\", \
            greater than 0 and at most 1e9";
    endless_window: "[response]\nmeasure = \"inf s\"\n"
        => "s.toml:2:11: `measure` in [response] is \"inf s\" but must be a string such as \"6 s\" or \"200 periods\", \
            greater than 0 and at most 1e9";
    too_few_steps: "[response]\nsteps_per_period = 2\n"
        => "s.toml:2:20: `steps_per_period` in [response] is 2 but must be an integer between 3 and 100000";
    no_analysis: "analysis = []\n"
        => "s.toml:1:12: `analysis` is empty; give at least \"linear\" or \"response\"";
    unknown_analysis: "analysis = [\"linaer\"]\n"
        => "s.toml:1:13: unknown analysis `linaer` as an element of `analysis`; did you mean `linear`?";
    columns_count_characters: "title = \"é\"\n[model]\n\"é\" = 1 # and theta\n"
        => "s.toml:3:1: unknown key `é` in [model]; choose from kind, modes, impact_friction, m1, m2, k1, k2, c1, c2, f_ext, theta, restitution, damping_ratio, damping_ratio_1, damping_ratio_2, damping_ratio_3, damping_ratio_4, damping_ratio_5, damping_ratio_6, damping_ratio_7, damping_ratio_8 and kn";
}

#[test]
fn broken_toml_says_where() {
    let message = refused("[model]\nm1 = = 2\n");
    assert!(message.starts_with("s.toml:2:6: not valid TOML: "), "{message}");
}

#[test]
fn a_missing_sweep_file_is_named() {
    let error = Spec::read(Path::new("no/such.toml")).map(|_| ()).expect_err("the file does not exist");
    assert_eq!(
        error.to_string(),
        "cannot read the sweep file `no/such.toml`: No such file or directory (os error 2)"
    );
}

const TUPLES: &str = "points = \"t.csv\"\n[friction]\nmu_d = 0.3\n[belt]\nbelt_velocity = 3\n";

#[test]
fn rows_are_checked_with_line_and_column() {
    let rows = |content| refused_with(TUPLES, &[("t.csv", content)]);
    assert_eq!(
        rows("# a comment\nmu_s,theta\n0.4,0.1\n\n0.4\n"),
        "t.csv:5:1: the row has 1 field(s) but the header has 2; give one field per column"
    );
    assert_eq!(
        rows("mu_s\n0.4\n-1\n"),
        "t.csv:3:1: column `mu_s` is -1 but must be a finite number not below 0"
    );
    assert_eq!(
        rows("mu_s,theta\n0.4, 2\n"),
        "t.csv:2:6: column `theta` is 2 but must be strictly between \
        -1.5707963267948966 and 1.5707963267948966"
    );
    assert_eq!(rows("mu_s,theta\n0.4,\n"), "t.csv:2:5: column `theta` must be a number, found an empty cell");
    assert_eq!(rows("mu_s\r\n0.4\r\nhigh\r\n"), "t.csv:3:1: column `mu_s` must be a number, found `high`");
    assert_eq!(
        rows("mu_s\nNaN\n"),
        "t.csv:2:1: column `mu_s` is NaN but must be a finite number not below 0"
    );
    assert_eq!(rows("mus\n0.4\n"), "t.csv:1:1: unknown column `mus` in the header; did you mean `mu_s`?");
    assert_eq!(
        rows("mu_s,mu_s\n0.4,0.4\n"),
        "t.csv:1:6: column `mu_s` stands beside a column of the same name; remove one of them"
    );
    assert_eq!(rows("mu_s\n"), "t.csv:1:1: the file has a header but no rows; give at least one row");
    assert_eq!(rows("mu_s\r0.4\rhigh\r"), "t.csv:3:1: column `mu_s` must be a number, found `high`");
    assert_eq!(rows(""), "t.csv:1:1: the file is empty; give at least a header and one row");
    assert_eq!(
        rows("mu_s,mu_d\n0.4,0.3\n"),
        "t.csv:1:6: column `mu_d` stands beside `mu_d` in [friction]; remove one of them"
    );
    assert_eq!(
        rows("mu_s,law\n0.4,\"bilinear\n"),
        "t.csv:2:5: a double quote is opened but not closed in this row; close it"
    );
    assert_eq!(
        rows("mu_s,law\n0.4,linear\n"),
        "t.csv:2:5: unknown law `linear` in column `law`; did you mean `bilinear`?"
    );
    assert_eq!(
        rows("mu_s,law\n0.4,bilinear\n0.3,exponential\n"),
        "s.toml:2:2: `stribeck_velocity` is missing: law `exponential` needs it, so give it in [friction] or vary it"
    );
}

#[test]
fn materials_are_checked() {
    let sweep = |friction: &str| {
        format!("[friction]\nmaterial = \"pad.csv\"\n{friction}\n[belt]\nbelt_velocity = 3\n")
    };
    let pad = "temperature,mu_s,mu_d\n100,0.1,0.1\n300,0.2,0.1\n";
    let check = |friction: &str, pad: &str| refused_with(&sweep(friction), &[("pad.csv", pad)]);
    assert_eq!(
        check("mu_s = 0.4\ntemperature = 200", pad),
        "s.toml:3:8: `mu_s` in [friction] stands beside material `pad.csv`, which is to give it; remove one of them"
    );
    assert_eq!(
        check("", pad),
        "s.toml:1:2: `temperature` is missing: material `pad.csv` is read at a temperature, so \
         give it in [friction] or vary it"
    );
    assert_eq!(
        check("temperature = 301", pad),
        "s.toml:3:15: `temperature` is 301 but material `pad.csv` covers 100 to 300 °C; \
         stay inside or set outside = \"clamp\" in [friction]"
    );
    assert_eq!(
        check("temperature = 200", "temperature,mu_s,mu_d\n300,0.1,0.1\n100,0.2,0.1\n"),
        "pad.csv:3:1: `temperature` is 100 after 300 but must rise from row to row; sort the rows"
    );
    assert_eq!(
        check("temperature = 200", "temperature,mu_s\n100,0.1\n"),
        "s.toml:1:2: `mu_d` is missing: law `bilinear` needs it, so give material `pad.csv` such a column"
    );
    assert_eq!(
        check("temperature = 200", "temprature,mu_s\n100,0.1\n"),
        "pad.csv:1:1: unknown column `temprature` in the header; did you mean `temperature`?"
    );
    assert_eq!(
        check("temperature = 200", "mu_d,mu_s\n0.1,0.1\n"),
        "pad.csv:1:1: `temperature` is missing: a material has such a column, so add it to the header and to every row"
    );
    let axis = format!("{}[axes]\ntemperature = {{ values = [100, 200, 400] }}\n", sweep(""));
    assert_eq!(
        refused_with(&axis, &[("pad.csv", pad)]),
        "s.toml:7:37: `temperature` is 400 but material `pad.csv` covers 100 to 300 °C; \
         stay inside or set outside = \"clamp\" in [friction]"
    );
}

#[test]
fn friction_tables_are_checked() {
    let sweep = "[friction]\nlaw = \"table\"\ntable = \"mu.csv\"\n[belt]\nbelt_velocity = 3\n";
    let check = |table: &str| refused_with(sweep, &[("mu.csv", table)]);
    assert_eq!(
        check("velocity,mu\n1,0.4\n2,0.3\n"),
        "mu.csv:2:1: the first `velocity` is 1 but must be 0, where the table gives the limit of stick"
    );
    assert_eq!(
        check("velocity,mu\n0,0.4\n2,0.3\n2,0.2\n"),
        "mu.csv:4:1: `velocity` is 2 after 2 but must rise from row to row; sort the rows"
    );
    assert_eq!(
        check("velocity,mu\n0,0.4\n1,-0.3\n"),
        "mu.csv:3:3: column `mu` is -0.3 but must be a finite number not below 0"
    );
    assert_eq!(
        check("velocity,mu\n0,0.4\n"),
        "mu.csv:2:1: the number of rows of a friction table is 1 but must be at least 2; \
         for one value choose law = \"constant\""
    );
    assert_eq!(
        check("velocity,friction\n0,0.4\n"),
        "mu.csv:1:10: unknown column `friction` in the header; choose from velocity and mu"
    );
}

#[test]
fn at_is_checked() {
    let directory = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/sweeps"));
    let spec = Spec::read(&directory.join("paper_map.toml")).unwrap();
    let at = |pairs: &str| spec.instance_at(pairs).map(|_| ()).expect_err("the pairs are bad").to_string();
    assert_eq!(
        at("mu_s=0.4"),
        "--at: no value for `mu_d` and `belt_velocity`, which the sweep varies; add mu_d=0,belt_velocity=0.5"
    );
    assert_eq!(at("mus=0.4"), "--at: unknown parameter `mus` in the pairs; did you mean `mu_s`?");
    assert_eq!(at("mu_s=-1"), "--at: `mu_s` is -1 but must be a finite number not below 0");
    assert_eq!(at("mu_s=a"), "--at: `mu_s` must be a number, found `a`");
    assert_eq!(
        at("mu_s"),
        "--at: `mu_s` has no value; write name=value pairs such as mu_s=0.4,belt_velocity=3"
    );
    assert_eq!(
        at("mu_s=1,mu_s=2"),
        "--at: `mu_s=2` names a parameter for the second time; \
         write name=value pairs such as mu_s=0.4,belt_velocity=3"
    );
    assert_eq!(
        at("mu_s=1,mu_d=1,belt_velocity=1,law=exponential"),
        "--at: `stribeck_velocity` is missing: law `exponential` needs it, so add stribeck_velocity=…"
    );
    assert_eq!(
        at("settle=1"),
        "--at: unknown parameter `settle` in the pairs; \
         this key holds for the whole sweep and is set in the sweep file"
    );
    let idle = |pair: &str| at(&format!("mu_s=0.4,mu_d=0.3,belt_velocity=3,{pair}"));
    assert_eq!(
        idle("stribeck_velocity=1"),
        "--at: `stribeck_velocity` would have no effect: it is used only by the law exponential; \
         remove it or choose that"
    );
    assert_eq!(
        idle("law=constant,knee_velocity=4"),
        "--at: `knee_velocity` would have no effect: it is used only by the law bilinear; \
         remove it or choose that"
    );
    assert_eq!(
        idle("temperature=100"),
        "--at: `temperature` would have no effect: it is used only by a `material`; remove it or choose that"
    );
    assert_eq!(
        idle("start_fraction=0.1"),
        "--at: `start_fraction` would have no effect: it is used only by kind = \"mode\" in [start]; \
         remove it or choose that"
    );
    // What the sweep varies has to be named, also where the law of this instance does not read it.
    for pair in ["law=rational,decay=0.1", "law=constant", "knee_velocity=4", "start_displacement=1e-3"] {
        let pairs = format!("mu_s=0.4,mu_d=0.3,belt_velocity=3,{pair}");
        assert!(spec.instance_at(&pairs).is_ok(), "{pair}");
    }
}
