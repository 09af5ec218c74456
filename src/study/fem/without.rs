//! In the place of bodies, where the crate that knows them is left out: nothing.

use crate::results::figure::look::Look;
use crate::results::read::folder::Folder;
use crate::study::error::Result;

/// The bodies of a study, of which there are none without the feature `fem`.
#[derive(Clone, Debug)]
pub(crate) enum Bodies {}

impl Bodies {
    pub(crate) fn read(folder: Folder<'_>, files: [&str; 2]) -> Result<Bodies> {
        let why = "this is built without the feature `fem`, which draws it; build it with that";
        Err(folder.bad(files[0], why).into())
    }

    pub(crate) fn title(&self) -> &str {
        match *self {}
    }

    pub(crate) fn mesh_svg(&self, _: &Look<'_>) -> String {
        match *self {}
    }

    pub(crate) fn shapes_svg(&self, _: &Look<'_>) -> Option<String> {
        match *self {}
    }
}
