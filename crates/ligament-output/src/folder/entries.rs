//! What a folder of results holds. It may come from anybody: a link in the place of one of the program's own files is refused, so
//! that nothing leads elsewhere.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::Path;

use super::kind::Kind;
use crate::Error;

/// Names of what a folder holds.
///
/// # Errors
///
/// If the folder cannot be listed.
pub(super) fn names(folder: &Path) -> Result<Vec<OsString>, Error> {
    let entries = fs::read_dir(folder).map_err(Error::system("list", folder))?;
    let names: io::Result<Vec<OsString>> = entries.map(|it| it.map(|it| it.file_name())).collect();
    names.map_err(Error::system("list", folder))
}

/// Fails where a link is in the place of a file or folder.
///
/// # Errors
///
/// With its path.
pub fn refuse_link(path: &Path) -> Result<(), Error> {
    match fs::symlink_metadata(path) {
        Ok(found) if found.is_symlink() => Err(Error::Link(path.to_path_buf())),
        _ => Ok(()),
    }
}

/// Fails where a link is in the place of one of the program's own files in a folder of results; without such a folder there is
/// none.
///
/// # Errors
///
/// With the path of the link, or if the folder cannot be listed.
pub fn refuse_links(folder: &Path, kind: Kind) -> Result<(), Error> {
    if !folder.is_dir() {
        return Ok(());
    }
    for name in names(folder)? {
        let text = name.to_string_lossy();
        if kind.may_remove(&text) || (kind.holds_run)(&text) {
            refuse_link(&folder.join(&name))?;
        }
    }
    Ok(())
}
