//! Instances with several starts on the GPU: every start ends as with the reference, whatever the chunks.

use crate::Case;
use libtest_mimic::Failed;
use squealmap::engine::backend::Backend;
use squealmap::engine::options::Options;
use squealmap::engine::precision::Precision;
use squealmap::engine::record::Record;
use squealmap::sweep::map::Map;
use squealmap::sweep::run;
use squealmap::sweep::spec::Spec;

pub(crate) const CASES: &[Case] = &[("starts::all_starts_end_as_with_the_reference", all_starts)];

fn run(spec: &Spec, options: Options) -> Result<Map, Failed> {
    Ok(run::run(spec.clone(), &options, &|_| {})?)
}

/// Where all starts of a record have ended.
fn ends(record: &Record) -> String {
    let large = record.large().map(|large| (large.status, large.regime, large.settled));
    format!("{:?} {:?} {:?} {large:?}", record.bistable, record.regime, record.basin())
}

fn all_starts() -> Result<(), Failed> {
    let single = "[model]\nm1 = 0.9\nm2 = 0.1\nk1 = 1\nk2 = 1\nc1 = 0.1\nc2 = 0.1\nf_ext = 1\ntheta = 0\n[friction]\n\
        law = \"exponential\"\nmu_s = 1\nmu_d = 0.5\nstribeck_velocity = 0.5\n\
        [axes]\nbelt_velocity = { values = [0.7, 1.3, 1.6, 2.5] }\n";
    let boxed = "kind = \"box\"\nbox_samples = 8\nbox_displacement_from = -2.5\nbox_displacement_to = 1.5\n\
        box_velocity_from = 0\nbox_velocity_to = 2\n";
    // Chunks that part the starts of an instance.
    for (start, split) in [("kind = \"both\"\n", 5), (boxed, 20)] {
        let text = format!(
            "{single}[start]\n{start}[response]\nsettle = \"100 periods\"\nmeasure = \"40 periods\"\n"
        );
        let spec = Spec::parse(&text, "s.toml", ".".as_ref())?;
        let reference = run(&spec, Options { backend: Backend::Reference, ..Options::default() })?;
        let expected: Vec<String> = reference.records.iter().map(ends).collect();
        for verdict in [true, false] {
            assert!(reference.records.iter().any(|record| record.bistable == Some(verdict)), "{expected:?}");
        }
        for chunk in [None, Some(split)] {
            let options = Options {
                backend: Backend::Gpu,
                precision: Some(Precision::F32),
                chunk,
                ..Options::default()
            };
            let found: Vec<String> = run(&spec, options)?.records.iter().map(ends).collect();
            assert_eq!(found, expected, "{start}in chunks of {chunk:?}");
        }
    }
    Ok(())
}
