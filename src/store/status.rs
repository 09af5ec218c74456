//! How far a directory of tiles has come.

use std::time::{Duration, SystemTime};

use crate::disk::{Handle, How, door};
use crate::store::claim::PART;
use crate::store::directory::{Store, TILES};
use crate::store::error::{Error, Result};
use crate::store::folder::BAD;
use crate::store::tile::Fault;

/// The rate is that of so many of the last tiles.
const RECENT: usize = 64;

/// How far a directory has come.
#[derive(Clone, Debug, PartialEq)]
pub struct Status {
    /// Tiles that are there, of their full length.
    pub done: usize,
    /// The instances of these tiles.
    pub instances: usize,
    /// Instances beside them that stopped runs have kept.
    pub kept: usize,
    /// Tiles that processes are computing.
    pub in_work: usize,
    /// How many files were set aside.
    pub set_aside: usize,
    /// Bad tiles that are still in their place, with what is wrong.
    pub bad: Vec<(String, Fault)>,
    /// Instances per second of the last tiles, all processes together; `None` of fewer than two.
    pub rate: Option<f64>,
}

impl Status {
    /// Looks at a directory; nothing is changed. With `verify` every tile is read and its checksum compared, else
    /// only its length.
    ///
    /// # Errors
    /// When the directory cannot be read.
    pub fn new(store: &Store, verify: bool) -> Result<Status> {
        let description = &store.description;
        let mut status =
            Status { done: 0, instances: 0, kept: 0, in_work: 0, set_aside: 0, bad: Vec::new(), rate: None };
        let mut times: Vec<(SystemTime, usize)> = Vec::new();
        for number in store.numbers()? {
            let (path, label) = (store.path(number), description.tile(number));
            let Ok(file) = path.metadata() else { continue };
            let found = usize::try_from(file.len()).unwrap_or(usize::MAX);
            let fault = if verify {
                store.read(number).err()
            } else if found == 0 {
                Some(Fault::Empty)
            } else {
                (found != label.size()).then_some(Fault::Length { found, wanted: label.size() })
            };
            if let Some(fault) = fault {
                status.bad.push((path.display().to_string(), fault));
                continue;
            }
            status.done += 1;
            status.instances += label.bounds.len();
            if let Ok(time) = file.modified() {
                times.push((time, label.bounds.len()));
            }
        }
        status.rate = rate(times);
        let tiles = store.directory.join(TILES);
        let list = |path: &std::path::Path| door().names(path);
        let unreadable = |why: std::io::Error| Error::OutputDirectory {
            path: store.directory.clone(),
            why: why.to_string(),
        };
        // A file that is being written is locked; one that a killed process left is not.
        status.in_work = list(&tiles)
            .map_err(unreadable)?
            .into_iter()
            .filter(|name| name.to_string_lossy().ends_with(PART))
            .filter(|name| Handle::open(&tiles.join(name), How::Read).is_ok_and(|file| file.is_locked()))
            .count();
        status.set_aside = list(&tiles.join(BAD)).map_or(0, |names| names.len());
        status.kept = store.kept_instances()?;
        Ok(status)
    }

    /// The time that the rest of `total` instances takes at this rate; `None` when nothing is in work.
    #[must_use]
    pub fn left(&self, total: usize) -> Option<Duration> {
        let rate = self.rate.filter(|_| self.in_work > 0)?;
        Duration::try_from_secs_f64(total.saturating_sub(self.instances) as f64 / rate).ok()
    }
}

/// Instances per second from the first of the last tiles to the last.
fn rate(mut times: Vec<(SystemTime, usize)>) -> Option<f64> {
    times.sort_unstable();
    let recent = &times[times.len().saturating_sub(RECENT)..];
    let ((first, _), (last, _)) = (recent.first()?, recent.last()?);
    let seconds = last.duration_since(*first).ok()?.as_secs_f64();
    let instances: usize = recent[1..].iter().map(|(_, count)| count).sum();
    (seconds > 0.0).then(|| instances as f64 / seconds)
}
