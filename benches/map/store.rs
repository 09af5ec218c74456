//! Rows into `benches/results/map-<machine>.csv`: one file per kind of machine, the newest row of every case.

use std::error::Error;
use std::path::PathBuf;

use crate::flops;
use crate::kept::keep;
use crate::machine::Machine;
use crate::row::Row;

/// The columns that say which case a row is; the others are replaced by a later run.
const KEY: [&str; 5] = ["engine", "scalar", "steps_per_period", "instances", "adapter"];

const VALUES: [&str; 23] = [
    "date",
    "commit",
    "cpu",
    "features",
    "threads",
    "order",
    "wall_s",
    "cpu_s",
    "instances_per_s",
    "instances_per_cpu_s",
    "steps_per_instance",
    "steps_per_s",
    "steps_per_cpu_s",
    "flops_per_step",
    "peak_flops_per_core",
    "share_of_peak",
    "share_of_peak_all_modes",
    "over_scalar",
    "x2_std_error_median",
    "x2_std_error_p99",
    "labels_differ",
    "failed",
    "peak_memory_mib",
];

/// Keeps the rows; returns the file.
pub(crate) fn store(rows: &[Row], machine: &Machine) -> Result<PathBuf, Box<dyn Error>> {
    let header: Vec<&str> = KEY.iter().chain(&VALUES).copied().collect();
    let fields = |row: &Row| row.key().into_iter().chain(values(row, rows, machine)).collect();
    keep(&format!("map-{}.csv", machine.kind()), &header, KEY.len(), rows.iter().map(fields))
}

/// The values of a row in the order of [`VALUES`].
fn values(row: &Row, rows: &[Row], machine: &Machine) -> Vec<String> {
    let known = |value: Option<f64>| value.map(|value| format!("{value:.4e}")).unwrap_or_default();
    let number = |value: f64| known(Some(value));
    let order = row.case.order();
    let share = row.share_of_peak(machine);
    vec![
        machine.date.clone(),
        machine.commit.to_owned(),
        machine.cpu.clone(),
        machine.features.clone(),
        machine.threads.to_string(),
        order.to_string(),
        number(row.best.wall),
        known(row.best.cpu),
        number(row.per_second()),
        known(row.per_cpu_second()),
        number(row.steps_per_instance()),
        number(row.steps_per_second()),
        known(row.steps_per_cpu_second()),
        number(flops::contact_only(order)),
        known(row.on_cpu.then(|| machine.peak(row.case.arithmetic()).flops)),
        known(share.map(|[contact_only, _]| contact_only)),
        known(share.map(|[_, all_modes]| all_modes)),
        known(row.over_scalar(rows)),
        number(row.errors.median),
        number(row.errors.p99),
        number(row.errors.labels),
        row.failed.to_string(),
        known(row.memory),
    ]
}
