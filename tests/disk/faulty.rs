//! A disk that fails at one of its operations.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use squealmap::disk::{Disk, How, System};

/// Where a child learns what is to fail, and where it writes how many operations there were.
pub(crate) const FAULT: &str = "SQUEALMAP_TEST_FAULT";
pub(crate) const COUNT: &str = "SQUEALMAP_TEST_COUNT";

/// The exit code of a process that the disk ended.
pub(crate) const CRASHED: i32 = 99;

/// A way to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Nothing fails.
    None,
    /// The operation fails.
    Error,
    /// The disk is full from it on.
    Full,
    /// A signal interrupts it.
    Interrupted,
    /// A write or read takes only a part.
    Short,
    /// A part is written before the error.
    Torn,
    /// The process ends before it.
    Killed,
    /// The machine ends before it: what was not synced is lost, names and bytes.
    Crash,
    /// The same where names last and bytes do not.
    CrashOfBytes,
}

impl Fault {
    pub(crate) const ALL: [Fault; 8] = [
        Fault::Error,
        Fault::Full,
        Fault::Interrupted,
        Fault::Short,
        Fault::Torn,
        Fault::Killed,
        Fault::Crash,
        Fault::CrashOfBytes,
    ];

    pub(crate) fn name(self) -> String {
        format!("{self:?}")
    }
}

/// What has changed and is not on the disk for sure.
enum Change {
    Made(PathBuf),
    MadeFolder(PathBuf),
    Renamed { from: PathBuf, to: PathBuf, before: Option<Vec<u8>> },
    Removed { path: PathBuf, before: Vec<u8> },
    RemovedFolder(PathBuf),
}

impl Change {
    /// The folder whose names it changed.
    fn folder(&self) -> &Path {
        let path = match self {
            Change::Made(path)
            | Change::MadeFolder(path)
            | Change::RemovedFolder(path)
            | Change::Renamed { to: path, .. }
            | Change::Removed { path, .. } => path,
        };
        path.parent().unwrap_or(Path::new(""))
    }

    fn undo(self) {
        // What lies in a folder that is gone was undone before.
        let _ = match self {
            Change::Made(path) => fs::remove_file(path),
            Change::MadeFolder(path) => fs::remove_dir(path),
            Change::Renamed { from, to, before } => {
                fs::rename(&to, from).and_then(|()| before.map_or(Ok(()), |bytes| fs::write(to, bytes)))
            }
            Change::Removed { path, before } => fs::write(path, before),
            Change::RemovedFolder(path) => fs::create_dir(path),
        };
    }
}

#[derive(Default)]
struct Journal {
    operations: u64,
    changes: Vec<Change>,
    /// Files with bytes that are not synced, as they were when they last were.
    synced: BTreeMap<PathBuf, Vec<u8>>,
}

impl Journal {
    /// What a crash does: files have the bytes again that they had when they were last synced; `names` too.
    fn forget(&mut self, names: bool) {
        for (path, bytes) in std::mem::take(&mut self.synced) {
            if path.exists() {
                fs::write(path, bytes).unwrap();
            }
        }
        while let Some(change) = self.changes.pop().filter(|_| names) {
            change.undo();
        }
    }
}

/// The disk.
pub(crate) struct Faulty {
    fault: Fault,
    /// The operation that fails, from 1 on.
    at: u64,
    count: Option<PathBuf>,
    journal: Mutex<Journal>,
}

/// What an operation is to do.
enum Order {
    Go,
    /// It writes or reads a part and says so, or fails then.
    Part(Option<io::Error>),
}

impl Faulty {
    /// The disk that the environment asks for.
    pub(crate) fn asked_for() -> Option<Faulty> {
        let asked = std::env::var(FAULT).ok()?;
        let (name, at) = asked.split_once(' ')?;
        let fault = Fault::ALL.into_iter().find(|fault| fault.name() == name).unwrap_or(Fault::None);
        let count = std::env::var_os(COUNT).map(PathBuf::from);
        Some(Faulty { fault, at: at.parse().ok()?, count, journal: Mutex::default() })
    }

    /// A disk that fails at nothing.
    pub(crate) fn watching() -> Faulty {
        Faulty { fault: Fault::None, at: 0, count: None, journal: Mutex::default() }
    }

    /// What a crash does.
    pub(crate) fn forget(&self, names: bool) {
        self.journal.lock().unwrap().forget(names);
    }

    /// Counts an operation, and says what it is to do; `takes_room` where it takes room on the disk.
    fn ask(&self, journal: &mut Journal, takes_room: bool) -> io::Result<Order> {
        journal.operations += 1;
        if let Some(count) = &self.count {
            // Without cutting it, which a disk takes its time for.
            let file = File::options().create(true).write(true).truncate(false).open(count).unwrap();
            (&file).write_all(journal.operations.to_string().as_bytes()).unwrap();
        }
        let error = || io::Error::from_raw_os_error(5);
        let now = journal.operations == self.at;
        match self.fault {
            Fault::Full if takes_room && journal.operations >= self.at => {
                Err(io::Error::from_raw_os_error(28))
            }
            Fault::Error if now => Err(error()),
            Fault::Interrupted if now => Err(io::ErrorKind::Interrupted.into()),
            Fault::Short if now => Ok(Order::Part(None)),
            Fault::Torn if now => Ok(Order::Part(Some(error()))),
            Fault::Killed if now => std::process::exit(CRASHED),
            Fault::Crash | Fault::CrashOfBytes if now => {
                journal.forget(self.fault == Fault::Crash);
                std::process::exit(CRASHED);
            }
            _ => Ok(Order::Go),
        }
    }

    /// Counts an operation that does all or nothing.
    fn whole(&self, journal: &mut Journal, takes_room: bool) -> io::Result<()> {
        match self.ask(journal, takes_room)? {
            Order::Part(Some(why)) => Err(why),
            _ => Ok(()),
        }
    }
}

/// Remembers the bytes of a file before the first change since it was synced.
fn remember(journal: &mut Journal, path: &Path) {
    journal.synced.entry(path.to_owned()).or_insert_with(|| fs::read(path).unwrap_or_default());
}

impl Disk for Faulty {
    fn open(&self, path: &Path, how: How) -> io::Result<File> {
        let mut journal = self.journal.lock().unwrap();
        let is_new = how == How::Write && !path.exists();
        self.whole(&mut journal, is_new)?;
        let file = System.open(path, how)?;
        if is_new {
            journal.changes.push(Change::Made(path.to_owned()));
        }
        Ok(file)
    }

    fn read(&self, file: &File, path: &Path, bytes: &mut [u8]) -> io::Result<usize> {
        let mut journal = self.journal.lock().unwrap();
        match self.ask(&mut journal, false)? {
            Order::Part(Some(why)) => Err(why),
            Order::Part(None) => {
                let part = bytes.len().div_ceil(2).min(7);
                System.read(file, path, &mut bytes[..part])
            }
            Order::Go => System.read(file, path, bytes),
        }
    }

    fn write(&self, mut file: &File, path: &Path, bytes: &[u8]) -> io::Result<usize> {
        let mut journal = self.journal.lock().unwrap();
        let order = self.ask(&mut journal, true)?;
        remember(&mut journal, path);
        let part = match order {
            Order::Go => bytes,
            Order::Part(_) => &bytes[..bytes.len().div_ceil(2)],
        };
        let written = file.write(part)?;
        if let Order::Part(Some(why)) = order { Err(why) } else { Ok(written) }
    }

    fn resize(&self, file: &File, path: &Path, length: u64) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, length > 0)?;
        remember(&mut journal, path);
        System.resize(file, path, length)
    }

    fn sync(&self, _file: &File, path: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, true)?;
        // Nothing of the machine's own disk is waited for: what a crash forgets is this disk's.
        journal.synced.remove(path);
        Ok(())
    }

    fn sync_folder(&self, path: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, false)?;
        let path = if path == Path::new(".") { Path::new("") } else { path };
        journal.changes.retain(|change| change.folder() != path);
        Ok(())
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, true)?;
        let before = fs::read(to).ok();
        System.rename(from, to)?;
        let moved = journal.synced.extract_if(.., |path, _| path.starts_with(from)).collect::<Vec<_>>();
        for (path, bytes) in moved {
            let inside = path.strip_prefix(from).unwrap();
            let now = if inside == Path::new("") { to.to_owned() } else { to.join(inside) };
            journal.synced.insert(now, bytes);
        }
        journal.changes.push(Change::Renamed { from: from.to_owned(), to: to.to_owned(), before });
        Ok(())
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, false)?;
        let before = fs::read(path).unwrap_or_default();
        System.remove(path)?;
        journal.synced.remove(path);
        journal.changes.push(Change::Removed { path: path.to_owned(), before });
        Ok(())
    }

    fn make_folder(&self, path: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, true)?;
        System.make_folder(path)?;
        journal.changes.push(Change::MadeFolder(path.to_owned()));
        Ok(())
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, false)?;
        System.remove_folder(path)?;
        journal.changes.push(Change::RemovedFolder(path.to_owned()));
        Ok(())
    }

    fn names(&self, path: &Path) -> io::Result<Vec<OsString>> {
        let mut journal = self.journal.lock().unwrap();
        self.whole(&mut journal, false)?;
        System.names(path)
    }
}
