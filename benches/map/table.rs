//! Rows as Markdown, ready for `docs/performance.md`.

use std::fmt::{Display, Formatter, Result};

use crate::engine::Engine;
use crate::machine::Machine;
use crate::row::Row;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;

/// Everything that is printed: a table of each map, the cost over their size.
pub(crate) struct Tables<'a> {
    pub(crate) rows: &'a [Row],
    pub(crate) machine: &'a Machine,
}

/// The columns of a map's table.
const HEADER: &str = "\
| engine | scalar | order, steps per period | instances/s | per CPU-second | 10⁶ steps per CPU-second \
| share of peak, % (all modes) | × scalar | error of std x2, p50 / p99, % | labels that differ, % |
|---|---|---|---|---|---|---|---|---|---|";

impl Display for Tables<'_> {
    fn fmt(&self, f: &mut Formatter) -> Result {
        self.heading(f)?;
        let mut sizes: Vec<usize> = self.rows.iter().map(|row| row.instances).collect();
        sizes.dedup();
        sizes.iter().try_for_each(|size| self.map(f, *size))?;
        self.costs(f, &sizes)
    }
}

/// A value that may be unknown, with `digits` decimals.
fn known(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
}

impl Tables<'_> {
    /// Where and when, and the peak.
    fn heading(&self, f: &mut Formatter) -> Result {
        let machine = self.machine;
        write!(f, "{}, commit {}, {} ", machine.date, machine.commit, machine.cpu)?;
        write!(f, "({}), {} threads. FMA peak of a core:", machine.features, machine.threads)?;
        for precision in [Precision::F32, Precision::F64] {
            let peak = machine.peak(precision);
            let giga = peak.flops / 1e9;
            write!(f, " {precision} {giga:.1} Gflop/s ({} lanes, ", peak.lanes)?;
            write!(f, "{:.1} multiply-adds in flight).", peak.in_flight)?;
        }
        writeln!(f)
    }

    /// All cases on one map.
    fn map(&self, f: &mut Formatter, size: usize) -> Result {
        writeln!(f, "\n{size} instances:\n\n{HEADER}")?;
        let mut judged = 0;
        for row in self.rows.iter().filter(|row| row.instances == size) {
            self.line(f, row)?;
            judged = row.errors.judged;
        }
        writeln!(f, "\nErrors of {judged} instances against the reference at 24 steps per period.")
    }

    /// One case.
    fn line(&self, f: &mut Formatter, row: &Row) -> Result {
        let share = row.share_of_peak(self.machine);
        let [contact_only, all] =
            [0, 1].map(|count| known(share.map(|share: [f64; 2]| 100.0 * share[count]), 1));
        write!(f, "| {} ", row.case.engine.name())?;
        if !row.adapter.is_empty() {
            write!(f, "on {} ", row.adapter)?;
        }
        write!(f, "| {} | {}, ", row.case.scalar(), row.case.order())?;
        write!(f, "{} | {:.0} ", row.case.steps_per_period, row.per_second())?;
        write!(f, "| {} ", known(row.per_cpu_second(), 0))?;
        write!(f, "| {} ", known(row.steps_per_cpu_second().map(|steps| steps / 1e6), 2))?;
        write!(f, "| {contact_only} ({all}) ")?;
        write!(f, "| {} ", known(row.over_scalar(self.rows), 1))?;
        let errors = row.errors;
        write!(f, "| {:.1e} / {:.1e} ", 100.0 * errors.median, 100.0 * errors.p99)?;
        write!(f, "| {:.2}", 100.0 * errors.labels)?;
        if row.failed > 0 {
            write!(f, ", {} not `ok`", row.failed)?;
        }
        writeln!(f, " |")
    }

    /// CPU time per instance over the size of the map, and memory.
    fn costs(&self, f: &mut Formatter, sizes: &[usize]) -> Result {
        write!(f, "\nCPU time per instance, µs:\n\n| engine |")?;
        sizes.iter().try_for_each(|size| write!(f, " {size} |"))?;
        write!(f, "\n|---|")?;
        sizes.iter().try_for_each(|_| write!(f, "---|"))?;
        writeln!(f)?;
        let mut cases: Vec<_> =
            self.rows.iter().map(|row| row.case).filter(|case| case.engine == Engine::Simd).collect();
        cases.sort_by_key(|case| (case.precision.to_string(), case.steps_per_period));
        cases.dedup();
        for case in cases {
            write!(f, "| simd {}, {} steps |", case.precision, case.steps_per_period)?;
            for size in sizes {
                let found = self.rows.iter().find(|row| row.case == case && row.instances == *size);
                let micro = found.and_then(Row::per_cpu_second).map(|rate| 1e6 / rate);
                write!(f, " {} |", known(micro, 1))?;
            }
            writeln!(f)?;
        }
        write!(f, "| peak memory so far, MiB |")?;
        for size in sizes {
            let of_size = self.rows.iter().filter(|row| row.instances == *size);
            let memory = of_size.filter_map(|row| row.memory).reduce(f64::max);
            write!(f, " {} |", known(memory, 0))?;
        }
        let bytes = size_of::<Record>();
        writeln!(f, "\n\nThe benchmark keeps no records; a sweep keeps {bytes} bytes of each instance.")
    }
}
