//! What f32 did not bring to its end, once more in f64.

use std::sync::atomic::AtomicBool;

use squealmap::engine::backend::Backend;
use squealmap::engine::lanes::again::records_again;
use squealmap::engine::options::Options;
use squealmap::engine::record::Record;
use squealmap::model::status::Status;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

/// A record that may be another in f64 is none where that is not found out: it would be kept as one.
#[test]
fn what_is_stopped_before_f64_is_not_computed() {
    let text = "[friction]\nmu_s = 0.4\nmu_d = 0.3\nknee_velocity = 5.0\n[axes]\n\
                belt_velocity = { values = [1.0, 2.0, 3.0] }\n[response]\nsettle = \"5 periods\"\nmeasure = \"5 periods\"\n";
    let mut spec = Spec::parse(text, "sweep.toml", ".".as_ref()).expect("a sweep");
    spec.analysis.checked = false;
    let options = Options { backend: Backend::Cpu, ..Options::default() };
    let right = run::run(spec.clone(), &options, &|_| {}).expect("a map").records;
    let mut found = right.clone();
    found[1].status = Status::EventLimit;
    for stopped in [false, true] {
        let mut records = found.clone();
        records_again(&spec, 0, &mut records, &AtomicBool::new(stopped));
        assert_eq!((&records[0], &records[2]), (&right[0], &right[2]));
        assert_eq!(records[1], if stopped { Record::NOT_COMPUTED } else { right[1].clone() });
    }
}
