//! `squealmap init`: a commented sweep file to begin with. The shipped sweeps are inside the program.

use std::path::{Path, PathBuf};

use crate::cli::error::{Error, Result};
use crate::cli::output::{Output, list};
use crate::cli::talk::print;
use clap::{Args, ValueEnum};

/// A sweep to begin with.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum Preset {
    /// Stability over static friction, dynamic friction and belt velocity
    #[default]
    Map,
    /// A material file: stability over temperature and belt velocity
    Temperature,
    /// A small and a large start of every instance, and where they end differently
    Bistable,
    /// Many starts of every instance, and what fraction of them ends where
    Basin,
    /// A motion followed while a parameter rises and falls
    Hysteresis,
    /// The single mass on a belt
    SingleMass,
    /// Instances listed in a file instead of axes
    Tuples,
    /// One instance as a time series, with signals that `identify` reads
    Trace,
}

/// A file of a preset: its name here and its text.
type File = (&'static str, &'static str);

impl Preset {
    /// The shipped sweep: its name in the repository and its text.
    fn sweep(self) -> File {
        match self {
            Preset::Map => ("paper_map", include_str!("../../sweeps/paper_map.toml")),
            Preset::Temperature => ("temperature_map", include_str!("../../sweeps/temperature_map.toml")),
            Preset::Bistable => ("bistable_band", include_str!("../../sweeps/bistable_band.toml")),
            Preset::Basin => ("basin", include_str!("../../sweeps/basin.toml")),
            Preset::Hysteresis => ("hysteresis", include_str!("../../sweeps/hysteresis.toml")),
            Preset::SingleMass => ("mass_on_belt", include_str!("../../sweeps/mass_on_belt.toml")),
            Preset::Tuples => ("tuples", include_str!("../../sweeps/tuples.toml")),
            Preset::Trace => ("trace", include_str!("../../sweeps/trace.toml")),
        }
    }

    /// The file that the sweep names.
    fn beside(self) -> Option<File> {
        match self {
            Preset::Temperature => Some(("pad.csv", include_str!("../../sweeps/pad.csv"))),
            Preset::Tuples => Some(("tuples.csv", include_str!("../../sweeps/tuples.csv"))),
            Preset::Map
            | Preset::Bistable
            | Preset::Basin
            | Preset::Hysteresis
            | Preset::SingleMass
            | Preset::Trace => None,
        }
    }

    /// The name in the command.
    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// The command that does something with the sweep; `SWEEP` stands for its name.
    fn command(self) -> &'static str {
        match self {
            Preset::Hysteresis => "squealmap trace SWEEP --sweep-up-down belt_velocity=0.8..2.1 --points 53",
            Preset::Trace => "squealmap trace SWEEP --rate 20000",
            Preset::Map
            | Preset::Temperature
            | Preset::Bistable
            | Preset::Basin
            | Preset::SingleMass
            | Preset::Tuples => "squealmap run SWEEP",
        }
    }
}

/// Arguments of `init`.
#[derive(Debug, Args)]
pub(crate) struct Init {
    /// What the sweep shows
    #[arg(value_enum, default_value_t)]
    preset: Preset,
    /// Sweep file to be written, or a folder for it [default: <PRESET>.toml]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Init {
    pub(crate) fn execute(self) -> Result<()> {
        let name = format!("{}.toml", self.preset.name());
        let path = match self.output {
            Some(folder) if folder.is_dir() => folder.join(name),
            asked => asked.unwrap_or_else(|| name.into()),
        };
        let Some(name) = path.file_name().map(|name| name.to_string_lossy().into_owned()) else {
            return Err(Error::NoStem { path });
        };
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let (shipped, text) = self.preset.sweep();
        // The commands in its comments name the file as it is called in the repository.
        let text = text.replace(&format!("sweeps/{shipped}.toml"), &path.display().to_string());
        let text = text.replace(&format!("out/{shipped}"), &format!("out/{}", stem(&name)));
        let mut files = vec![(name.as_str(), text.into_bytes())];
        files.extend(self.preset.beside().map(|(name, text)| (name, text.as_bytes().to_vec())));
        if let Some((there, _)) = files.iter().find(|(name, _)| folder.join(name).symlink_metadata().is_ok())
        {
            return Err(Error::FileThere { path: folder.join(there) });
        }
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        let paths = Output::prepare(folder.to_owned(), &names)?.write(&files)?;
        let shown = path.display().to_string();
        print(&format!(
            "{}\ncheck it:      squealmap check {shown}\ncompute it:    {}\nits keys:      squealmap keys\n",
            list(&paths),
            self.preset.command().replace("SWEEP", &shown)
        ));
        Ok(())
    }
}

/// The name of a file without its ending.
fn stem(name: &str) -> &str {
    name.strip_suffix(".toml").unwrap_or(name)
}
