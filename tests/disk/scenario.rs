//! Commands, and the directories they begin in.

use std::path::Path;
use std::process::{Command, Output};

use crate::faulty::{COUNT, FAULT, Fault};

/// 40 instances, of which a tile has 10.
const SWEEP: &str = "title = \"Disk\"\n[friction]\nmu_s = 0.4\n[axes]\nmu_d = { from = 0.1, to = 0.4, points = 5 }\n\
    belt_velocity = { from = 1, to = 8, points = 8 }\n[response]\nsettle = \"2 periods\"\nmeasure = \"2 periods\"\n";

/// Eigenvalues of so many that a tile goes past the cache.
const LARGE: &str = "title = \"Large\"\nanalysis = [\"linear\"]\n[friction]\nmu_s = 0.4\n[axes]\n\
    mu_d = { from = 0.1, to = 0.4, points = 100 }\nbelt_velocity = { from = 1, to = 8, points = 130 }\n";

/// Few columns, of which each is a folder of files.
const SMALL: &str = "title = \"Small\"\nanalysis = [\"linear\"]\n[friction]\nmu_s = 0.4\n[axes]\n\
    mu_d = { from = 0.1, to = 0.4, points = 4 }\nbelt_velocity = { from = 1, to = 8, points = 5 }\n";

const RUN: &str = "run s.toml --backend cpu --tile 10 --threads 1";

const RUN_SMALL: &str = "run small.toml --backend cpu --tile 10 --threads 1 -o out/s";

const REFINE: &str = "refine s.toml --backend cpu --coarse 4 --sample 4 --tile 8 --threads 1 -o out/s";

/// A command whose disk fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scenario {
    /// A sweep in an empty place.
    Run,
    /// One of which half the tiles are there, and results of them.
    Resume,
    /// Large tiles.
    Large,
    /// A complete sweep whose table was damaged.
    Repair,
    /// The lines of a map.
    Refine,
    /// Those of one that was refined otherwise.
    RefineAgain,
    /// A refined map whose table was damaged.
    RefineRepair,
    /// Two halves brought together.
    Merge,
    /// Tiles as other formats.
    Csv,
    Zarr,
    ZarrAgain,
    Netcdf,
    Parquet,
    /// Figures.
    Plot,
    Trace,
    /// Of another instance than the one before.
    TraceAgain,
}

impl Scenario {
    /// Whether its command takes more than 160 operations: seconds, of which every one is tried.
    pub(crate) fn is_long(self) -> bool {
        matches!(
            self,
            Scenario::RefineRepair
                | Scenario::Zarr
                | Scenario::ZarrAgain
                | Scenario::Netcdf
                | Scenario::Parquet
        )
    }

    pub(crate) const ALL: [Scenario; 16] = [
        Scenario::Run,
        Scenario::Resume,
        Scenario::Large,
        Scenario::Repair,
        Scenario::Refine,
        Scenario::RefineAgain,
        Scenario::RefineRepair,
        Scenario::Merge,
        Scenario::Csv,
        Scenario::Zarr,
        Scenario::ZarrAgain,
        Scenario::Netcdf,
        Scenario::Parquet,
        Scenario::Plot,
        Scenario::Trace,
        Scenario::TraceAgain,
    ];

    pub(crate) fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// The command.
    pub(crate) fn command(self) -> &'static str {
        match self {
            Scenario::Run | Scenario::Resume => RUN,
            Scenario::Large => "run large.toml --backend cpu --tile 6500 --threads 1 -o out/s",
            Scenario::Repair | Scenario::RefineRepair => "verify out/s --repair --threads 1",
            Scenario::Refine | Scenario::RefineAgain => REFINE,
            Scenario::Merge => "merge out/s part0 part1",
            Scenario::Csv => "export out/s --format csv --force -o out/s/copy.csv",
            Scenario::Zarr | Scenario::ZarrAgain => "export out/s --format zarr",
            Scenario::Netcdf => "export out/s --format netcdf",
            Scenario::Parquet => "export out/s --format parquet",
            Scenario::Plot => "plot out/s",
            Scenario::Trace | Scenario::TraceAgain => "trace s.toml --at mu_d=0.2,belt_velocity=3 -o out/s",
        }
    }

    /// Commands that lead to where it begins.
    fn before(self) -> &'static [&'static str] {
        match self {
            Scenario::Run | Scenario::Large | Scenario::Refine | Scenario::Trace => &[],
            Scenario::Resume => &["run s.toml --backend cpu --tile 10 --shard 0/2"],
            Scenario::Merge => &[
                "run s.toml --backend cpu --tile 10 --shard 0/2 -o part0",
                "run s.toml --backend cpu --tile 10 --shard 1/2 -o part1",
            ],
            Scenario::RefineAgain => {
                &["refine s.toml --backend cpu --coarse 2 --sample 0 --tile 8 --threads 1 -o out/s"]
            }
            Scenario::RefineRepair => &[REFINE],
            Scenario::TraceAgain => &["trace s.toml --at mu_d=0.3,belt_velocity=1 -o out/s"],
            Scenario::Zarr => &[RUN_SMALL],
            Scenario::ZarrAgain => &[RUN_SMALL, "export out/s --format zarr"],
            Scenario::Repair | Scenario::Csv | Scenario::Netcdf | Scenario::Parquet | Scenario::Plot => {
                &[RUN]
            }
        }
    }

    /// Makes the place in which it begins.
    pub(crate) fn prepare(self, directory: &Path) {
        std::fs::write(directory.join("s.toml"), SWEEP).unwrap();
        std::fs::write(directory.join("large.toml"), LARGE).unwrap();
        std::fs::write(directory.join("small.toml"), SMALL).unwrap();
        for command in self.before() {
            let ended = call(directory, command, Fault::None, 0);
            assert!(ended.status.success(), "{command}: {}", String::from_utf8_lossy(&ended.stderr));
        }
        let damaged = match self {
            Scenario::Repair => Some("out/s/map.csv"),
            Scenario::RefineRepair => Some("out/s/points.csv"),
            _ => None,
        };
        if let Some(table) = damaged {
            let table = directory.join(table);
            let bytes = std::fs::read(&table).unwrap();
            std::fs::write(&table, &bytes[..bytes.len() / 2]).unwrap();
        }
    }
}

/// Calls the program in a directory, with a fault at an operation of its disk.
pub(crate) fn call(directory: &Path, command: &str, fault: Fault, at: u64) -> Output {
    Command::new(std::env::current_exe().unwrap())
        .args(command.split(' '))
        .current_dir(directory)
        .env(FAULT, format!("{} {at}", fault.name()))
        .env_remove(COUNT)
        .output()
        .unwrap()
}

/// A place on a disk in memory, where there is one.
pub(crate) fn place() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

/// How many operations a command takes.
pub(crate) fn operations(directory: &Path, command: &str) -> u64 {
    let count = directory.join("count");
    let ended = Command::new(std::env::current_exe().unwrap())
        .args(command.split(' '))
        .current_dir(directory)
        .env(FAULT, "None 0")
        .env(COUNT, &count)
        .output()
        .unwrap();
    assert!(ended.status.success(), "{command}: {}", String::from_utf8_lossy(&ended.stderr));
    let text = std::fs::read_to_string(&count).unwrap();
    std::fs::remove_file(count).unwrap();
    text.parse().unwrap()
}
