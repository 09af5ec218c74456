//! `squealmap completions` and `squealmap man`: what a shell and `man` know of the commands, made from their definition.

use std::path::PathBuf;

use crate::cli::error::Result;
use crate::cli::output::{Output, cannot, list};
use crate::cli::talk;
use crate::cli::talk::print;
use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man;

/// The name of the program.
const NAME: &str = "squealmap";

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell that is to complete commands and options
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    pub(crate) fn execute(self, mut definition: clap::Command) {
        let mut text = Vec::new();
        clap_complete::generate(self.shell, &mut definition, NAME, &mut text);
        talk::product(&String::from_utf8_lossy(&text));
    }
}

/// Arguments of `man`.
#[derive(Debug, Args)]
pub(crate) struct ManPages {
    /// Directory for the pages, one for the program and one for each command
    #[arg(value_name = "DIR")]
    directory: PathBuf,
}

impl ManPages {
    pub(crate) fn execute(self, mut all: clap::Command) -> Result<()> {
        all.build();
        let mut pages = vec![(format!("{NAME}.1"), all.clone())];
        for command in all.get_subcommands().filter(|command| !command.is_hide_set()) {
            pages.push((format!("{NAME}-{}.1", command.get_name()), command.clone()));
        }
        let mut files = Vec::new();
        for (name, command) in pages {
            let mut bytes = Vec::new();
            Man::new(command).render(&mut bytes).map_err(|why| cannot(&self.directory.join(&name), &why))?;
            files.push((name, bytes));
        }
        let files: Vec<(&str, Vec<u8>)> =
            files.iter().map(|(name, bytes)| (name.as_str(), bytes.clone())).collect();
        let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
        let paths = Output::prepare(self.directory, &names)?.write(&files)?;
        print(&list(&paths));
        Ok(())
    }
}
