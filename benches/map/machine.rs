//! What was measured on, and when.

use std::fs::read_to_string;

use crate::date::date;
use crate::peak::Peak;
use squealmap::engine::precision::Precision;
use squealmap::version::COMMIT;

/// Features of a CPU that matter here, as Linux names them.
const FEATURES: [&str; 6] = ["sse2", "avx2", "fma", "avx512f", "neon", "asimd"];

/// The machine, its measured peak, and the state of the code.
pub(crate) struct Machine {
    /// Day of the run, `YYYY-MM-DD`.
    pub(crate) date: String,
    /// Git commit of the library.
    pub(crate) commit: &'static str,
    /// Model of the CPU.
    pub(crate) cpu: String,
    /// Its features.
    pub(crate) features: String,
    /// Threads that compute.
    pub(crate) threads: usize,
    /// FMA peak of one core in f32 and f64.
    pub(crate) peaks: [Peak; 2],
}

impl Machine {
    /// Looks at the machine and measures its peak.
    ///
    /// # Errors
    /// When the peak is not plausible.
    pub(crate) fn new() -> Result<Machine, String> {
        let info = read_to_string("/proc/cpuinfo").unwrap_or_default();
        let value = |key: &str| {
            let line = info.lines().find(|line| line.starts_with(key))?;
            Some(line.split_once(':')?.1.trim().to_owned())
        };
        let family = |key: &str| value(key).unwrap_or_else(|| "?".to_owned());
        let flags = value("flags").or_else(|| value("Features")).unwrap_or_default();
        let has = |feature: &&str| flags.split_whitespace().any(|flag| flag == *feature);
        let name = value("model name").unwrap_or_else(|| std::env::consts::ARCH.to_owned());
        Ok(Machine {
            date: date(),
            commit: COMMIT.unwrap_or("unknown"),
            cpu: format!("{name}, family {} model {}", family("cpu family"), family("model\t")),
            features: FEATURES.into_iter().filter(has).collect::<Vec<_>>().join(" "),
            threads: rayon::current_num_threads(),
            peaks: [Peak::measure(Precision::F32)?, Peak::measure(Precision::F64)?],
        })
    }

    /// The measured peak of one core, flop per second.
    pub(crate) fn peak(&self, precision: Precision) -> Peak {
        self.peaks[usize::from(precision == Precision::F64)]
    }

    /// Measures the peak again and keeps the better: a machine that others use shows it only now and then.
    ///
    /// # Errors
    /// When the peak is not plausible.
    pub(crate) fn measure_again(&mut self) -> Result<(), String> {
        for (peak, precision) in self.peaks.iter_mut().zip([Precision::F32, Precision::F64]) {
            let again = Peak::measure(precision)?;
            if again.flops > peak.flops {
                *peak = again;
            }
        }
        Ok(())
    }

    /// The part of a file name that says which kind of machine it is.
    pub(crate) fn kind(&self) -> String {
        let letters = |text: &str| text.to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "-");
        let mut kind = letters(&self.cpu);
        while kind.contains("--") {
            kind = kind.replace("--", "-");
        }
        kind.trim_matches('-').to_owned()
    }
}
