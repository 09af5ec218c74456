//! A directory made ready for the tiles of a sweep.

use std::io;
use std::path::Path;

use crate::disk;
use crate::store::claim::Claim;
use crate::store::description::Description;
use crate::store::directory::{DESCRIPTION, Note, Store, TILES};
use crate::store::error::{Error, Result};
use crate::store::folder::Folder;
use crate::store::occupant::Occupant;
use squealmap_input::quote::SAID;
use squealmap_input::quote::clipped;

impl Store {
    /// Opens a directory for the tiles of a sweep; it may hold some of them already. A sweep of a single tile
    /// that stands there gives way: it is cheap to compute again.
    ///
    /// # Errors
    /// When it holds whole tiles of another sweep, or a description of another version, or cannot be written.
    pub fn begin(directory: &Path, description: Description, note: Note) -> Result<Store> {
        let folder = Folder::new(directory, TILES);
        folder.make()?;
        let cannot = |why: io::Error| folder.refused(&why);
        let store = Store { directory: directory.to_owned(), description };
        match Store::open(directory) {
            Ok(other) if store.is_same(&other) => {
                if other.description.is_written_as(&store.description) {
                    return Ok(store);
                }
                // The same tiles with another title, or of a version that had no checksum here.
            }
            Ok(other) => {
                let (done, total) = (other.done()?, other.description.tiling.count());
                let kept = other.kept_instances()?;
                if total > 1 && done + kept > 0 {
                    let there =
                        Occupant::of_run(directory)?.map(|there| there.to_string()).unwrap_or_default();
                    return Err(Error::OtherSweep { path: directory.to_owned(), there });
                }
                disk::remove_if_there(&other.path(0)).map_err(cannot)?;
                disk::remove_if_there(&other.path_of_some(0)).map_err(cannot)?;
            }
            Err(Error::NoTiles { .. }) => store.refuse_whole_strangers()?,
            Err(Error::BadDescription { why, .. }) => {
                store.refuse_whole_strangers()?;
                let why = clipped(&why, SAID);
                folder.expel(DESCRIPTION, &format!("{why}; it is written again"), note)?;
            }
            Err(why) => return Err(why),
        }
        let path = directory.join(TILES).join(DESCRIPTION);
        // Another process that holds the claim writes the same.
        if let Some(mut claim) = Claim::take(&path).map_err(cannot)? {
            let mut file = io::BufWriter::new(claim.emptied().map_err(cannot)?);
            store.description.write(&mut file).and_then(|()| io::Write::flush(&mut file)).map_err(cannot)?;
            drop(file);
            claim.publish().map_err(cannot)?;
        }
        Ok(store)
    }

    /// Refuses a directory without a description in which somebody has computed another sweep.
    fn refuse_whole_strangers(&self) -> Result<()> {
        self.strangers()?.into_iter().try_for_each(|name| match self.whole(&name)? {
            Some(sweep) if sweep != self.description.id => {
                Err(Error::StrangeTile { path: self.folder().path(&name) })
            }
            _ => Ok(()),
        })
    }
}
