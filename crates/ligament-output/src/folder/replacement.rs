//! Replacement of earlier results by complete new ones.
//!
//! New results of a folder `NAME` are written to `NAME.new` beside it. When they are complete, `NAME` is renamed to `NAME.replaced` and
//! `NAME.new` to `NAME`; then files that are not the program's are moved, and the rest of the old folder is removed. A kill between these
//! steps leaves both complete, and [`recover`] finishes the replacement.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use super::entries::{names, refuse_link};
use super::kind::{Kind, REPLACED};
use crate::Error;
use crate::atomic::rename;
use crate::remedy::{PathKind, Remedy, Resolution};
use crate::replace_file;

/// A folder with `suffix` behind its name.
///
/// # Errors
///
/// If the path has no name, such as `..`.
pub(super) fn sibling(folder: &Path, suffix: &str) -> Result<PathBuf, Error> {
    let name = folder.file_name();
    let remedy = Remedy::OtherPath(PathKind::Folder, None);
    let name = name.ok_or_else(|| Error::UnnamedFolder(folder.to_path_buf(), remedy))?;
    let mut longer = OsString::from(name);
    longer.push(suffix);
    Ok(folder.with_file_name(longer))
}

/// Path to which new results of a folder are written.
///
/// # Errors
///
/// If the path has no name, or is a link.
pub(super) fn path_of_new_results(folder: &Path) -> Result<PathBuf, Error> {
    let new = sibling(folder, ".new")?;
    refuse_link(&new)?;
    Ok(new)
}

/// The folder whose new results are written to this folder; `None` for other names.
pub(super) fn folder_of_new_results(new: &Path) -> Option<PathBuf> {
    let name = new.file_name()?.to_str()?.strip_suffix(".new")?;
    Some(new.with_file_name(name))
}

/// Path to which old results are moved; it must not exist.
pub(super) fn path_of_old_results(folder: &Path) -> Result<PathBuf, Error> {
    let aside = sibling(folder, ".replaced")?;
    // `exists` would follow a dangling link.
    match fs::symlink_metadata(&aside) {
        Ok(_) => {
            let remedy = Remedy::OtherPath(PathKind::Folder, Some(Resolution::Remove));
            Err(Error::ReplacedExists(aside, remedy))
        }
        Err(_) => Ok(aside),
    }
}

/// Replaces a folder by another one; calls `meanwhile` between the two renames, while the path does not exist.
///
/// # Errors
///
/// If the path is a link, or a folder cannot be renamed; the old results are then unchanged. Files that cannot be removed remain in
/// `NAME.replaced`.
pub fn replace_folder(
    new: &Path,
    folder: &Path,
    kind: Kind,
    meanwhile: impl FnOnce() -> Result<(), Error>,
) -> Result<(), Error> {
    // The target of a link must not be replaced.
    refuse_link(folder)?;
    let aside = path_of_old_results(folder)?;
    let mark = folder.join(REPLACED);
    replace_file(&mark, b"")?;
    fs::rename(folder, &aside).map_err(Error::system("move aside", folder))?;
    let put = meanwhile().and_then(|()| rename(new, folder));
    if let Err(error) = put {
        // The old folder is restored if possible; the first failure is reported.
        let _ = fs::rename(&aside, folder);
        return Err(error);
    }
    move_foreign(&aside, folder, kind)
}

/// Completes a replacement that was interrupted by a kill.
///
/// # Errors
///
/// If a file or folder cannot be renamed or removed.
pub fn recover(folder: &Path, kind: Kind) -> Result<(), Error> {
    let Ok(aside) = sibling(folder, ".replaced") else {
        return Ok(());
    };
    if !aside.join(REPLACED).is_file() || fs::symlink_metadata(&aside).is_ok_and(|it| !it.is_dir())
    {
        return Ok(());
    }
    if fs::symlink_metadata(folder).is_err() {
        let new = path_of_new_results(folder)?;
        // The old results are restored if there are no new ones.
        let whole = if new.join(kind.marker).is_file() {
            &new
        } else {
            &aside
        };
        rename(whole, folder)?;
    }
    match aside.is_dir() {
        true => move_foreign(&aside, folder, kind),
        false => Ok(()),
    }
}

/// Removes the program's files from a folder, moves all others to another folder, and removes the old folder.
fn move_foreign(old: &Path, new: &Path, kind: Kind) -> Result<(), Error> {
    let mut own = Vec::new();
    for name in names(old)? {
        let (from, to) = (old.join(&name), new.join(&name));
        let text = name.to_string_lossy();
        let is_folder = fs::symlink_metadata(&from).is_ok_and(|it| it.is_dir());
        let is_taken = fs::symlink_metadata(&to).is_ok();
        if is_folder && (kind.holds_run)(&text) {
            fs::create_dir_all(&to).map_err(Error::system("create", &to))?;
            move_foreign(&from, &to, Kind::RUN)?;
            if is_empty(&to) {
                fs::remove_dir(&to).map_err(Error::system("remove", &to))?;
            }
        } else if !is_folder && (is_taken || kind.may_remove(&text)) {
            own.push(from);
        } else if !is_taken {
            rename(&from, &to)?;
        }
    }
    // The mark is removed last, so that an interruption is detected.
    own.sort_by_key(|path| path.ends_with(REPLACED));
    for path in own {
        fs::remove_file(&path).map_err(Error::system("remove", &path))?;
    }
    fs::remove_dir(old).map_err(Error::system("remove", old))
}

/// Removes the program's files from a folder; all others are kept.
pub(super) fn clear(folder: &Path, kind: Kind) -> Result<(), Error> {
    let mut names = names(folder)?;
    // The marker is removed last, so that an interrupted removal can be repeated.
    names.sort_by_key(|name| name == kind.marker);
    for name in names {
        let (path, text) = (folder.join(&name), name.to_string_lossy());
        let is_folder = fs::symlink_metadata(&path).is_ok_and(|it| it.is_dir());
        if is_folder && (kind.holds_run)(&text) {
            clear(&path, Kind::RUN)?;
            // A folder with other files is kept.
            let _ = fs::remove_dir(&path);
        } else if !is_folder && text != super::kind::LOCK && kind.may_remove(&text) {
            fs::remove_file(&path).map_err(Error::system("remove", &path))?;
        }
    }
    Ok(())
}

fn is_empty(folder: &Path) -> bool {
    fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_none())
}
