//! The folder with the results of one run.

mod entries;
mod kind;
mod lock;
mod replacement;

use std::path::{Path, PathBuf};
use std::{fs, io};

use entries::{names, remove_files, resolve_links};
use kind::is_lock_or_temporary;
use lock::FolderLock;
use replacement::{folder_of_new_results, path_of_new_results, path_of_old_results};

use crate::atomic::remove_file;
use crate::remedy::{PathKind, Remedy, Resolution};
use crate::{Error, replace_file};

pub use entries::{refuse_link, refuse_links, remove_unfinished_pages};
pub use kind::{Kind, REPORT, RESOLVED_CASE, input_name, is_derived_file};
pub use replacement::{recover, replace_folder};

/// A folder for the results of one run, locked against other processes.
///
/// A run writes the marker of its kind first, by which a later run recognises a folder that it may replace. Results that replace earlier
/// ones are written to `NAME.new` and replace them in [`ResultFolder::finish`]; until then the earlier results are unchanged.
#[derive(Debug)]
pub struct ResultFolder {
    /// Folder to which files are written.
    path: PathBuf,
    kind: Kind,
    lock: FolderLock,
    /// Folder of earlier results to be replaced, and its lock.
    replaces: Option<(PathBuf, FolderLock)>,
}

impl ResultFolder {
    /// Creates the folder of a run and its parents. An existing empty folder is used.
    ///
    /// A folder with results is refused unless `replace` is set; then new results are written beside it. A folder with other files only is
    /// always refused.
    ///
    /// # Errors
    ///
    /// If the folder may not be used, another process writes to it, or it cannot be created.
    pub fn create(path: impl AsRef<Path>, replace: bool) -> Result<Self, Error> {
        Self::create_of_kind(path, Kind::RUN, replace)
    }

    /// Creates a folder of another kind, whose marker the caller writes first.
    ///
    /// # Errors
    ///
    /// As for [`ResultFolder::create`].
    pub fn create_of_kind(
        path: impl AsRef<Path>,
        kind: Kind,
        replace: bool,
    ) -> Result<Self, Error> {
        let given = path.as_ref();
        Self::check_of_kind(given, kind, replace)?;
        let path = resolve_links(given);
        fs::create_dir_all(&path).map_err(Error::system("create", &path))?;
        let lock = lock_folder(&path, kind)?;
        // Another process may have filled the folder before it was locked.
        match FolderContent::usable_content(&path, given, kind, replace)? {
            FolderContent::Nothing => Ok(Self::lock_folder(path, kind, lock)),
            FolderContent::Results => Self::create_beside(path, kind, lock),
        }
    }

    /// Creates a new folder beside earlier results; files left there by a killed run are removed.
    fn create_beside(path: PathBuf, kind: Kind, lock: FolderLock) -> Result<Self, Error> {
        let new = path_of_new_results(&path)?;
        FolderContent::usable_content(&new, &new, kind, true)?;
        fs::create_dir_all(&new).map_err(Error::system("create", &new))?;
        let new_lock = lock_folder(&new, kind)?;
        replacement::clear(&new, kind)?;
        Ok(Self {
            replaces: Some((path, lock)),
            ..Self::lock_folder(new, kind, new_lock)
        })
    }

    fn lock_folder(path: PathBuf, kind: Kind, lock: FolderLock) -> Self {
        Self {
            path,
            kind,
            lock,
            replaces: None,
        }
    }

    /// Opens an existing folder with its files, to continue work in it.
    ///
    /// # Errors
    ///
    /// If another process writes to the folder, or the folder cannot be written.
    pub fn open(path: impl AsRef<Path>, kind: Kind) -> Result<Self, Error> {
        let path = resolve_links(path.as_ref());
        recover(&path, kind)?;
        let lock = lock_folder(&path, kind)?;
        Ok(Self::lock_folder(path, kind, lock))
    }

    /// Opens the folder of a stopped run with its files. Where the run was to replace earlier results, both paths `NAME` and `NAME.new`
    /// open the new results, which replace the earlier ones in [`ResultFolder::finish`].
    ///
    /// # Errors
    ///
    /// As for [`ResultFolder::open`].
    pub fn open_resumed(path: impl AsRef<Path>) -> Result<Self, Error> {
        let (path, kind) = (resolve_links(path.as_ref()), Kind::RUN);
        recover(&path, kind)?;
        let holds_results = |it: &PathBuf| it.join(kind.marker).is_file();
        let old = folder_of_new_results(&path)
            .filter(holds_results)
            .unwrap_or(path);
        let lock = lock_folder(&old, kind)?;
        let Some(new) = path_of_new_results(&old).ok().filter(holds_results) else {
            return Ok(Self::lock_folder(old, kind, lock));
        };
        let new_lock = lock_folder(&new, kind)?;
        Ok(Self {
            replaces: Some((old, lock)),
            ..Self::lock_folder(new, kind, new_lock)
        })
    }

    /// Path of a folder for reading, to which no process writes; an interrupted replacement is completed first.
    ///
    /// # Errors
    ///
    /// If another process writes to the folder.
    pub fn path_for_reading(path: impl AsRef<Path>) -> Result<PathBuf, Error> {
        let path = resolve_links(path.as_ref());
        recover(&path, Kind::RUN)?;
        FolderLock::check(&path)?;
        Ok(path)
    }

    /// Fails as [`ResultFolder::create`] would, without creating anything: a check before a run starts.
    ///
    /// # Errors
    ///
    /// If the folder may not be used, or another process writes to it.
    pub fn check(path: &Path, replace: bool) -> Result<(), Error> {
        Self::check_of_kind(path, Kind::RUN, replace)
    }

    fn check_of_kind(given: &Path, kind: Kind, replace: bool) -> Result<(), Error> {
        let path = resolve_links(given);
        recover(&path, kind)?;
        FolderLock::check(&path)?;
        if let FolderContent::Results = FolderContent::usable_content(&path, given, kind, replace)?
        {
            path_of_old_results(&path)?;
            let new = path_of_new_results(&path)?;
            FolderLock::check(&new)?;
            FolderContent::usable_content(&new, &new, kind, true)?;
        }
        Ok(())
    }

    /// Folder to which files are written: `NAME.new` as long as earlier results exist.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Folder of earlier results to be replaced.
    pub fn replaces(&self) -> Option<&Path> {
        self.replaces.as_ref().map(|(folder, _)| folder.as_path())
    }

    /// The path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a file in the folder atomically, replacing an earlier file of that name.
    ///
    /// # Errors
    ///
    /// If the file cannot be written.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), Error> {
        replace_file(&self.file(name), contents.as_ref())
    }

    /// Removes a file of the folder, if it exists.
    ///
    /// # Errors
    ///
    /// If the file cannot be removed.
    pub fn remove(&self, name: &str) -> Result<(), Error> {
        remove_file(&self.file(name))
    }

    /// Removes files that were derived from the earlier results of the run, such as the files of its cracks.
    ///
    /// # Errors
    ///
    /// If the files cannot be listed or removed.
    pub fn remove_derived_files(&self) -> Result<(), Error> {
        remove_files(&self.path, is_derived_file)
    }

    /// Completes the folder: its results replace earlier ones.
    ///
    /// Files that are not the program's are kept; a link to a folder remains a link.
    ///
    /// # Errors
    ///
    /// If the results cannot be moved; they then remain where they were written.
    pub fn finish(mut self) -> Result<(), Error> {
        let Some((folder, mut old_lock)) = self.replaces.take() else {
            return Ok(());
        };
        replace_folder(&self.path, &folder, self.kind, || Ok(()))?;
        // The lock's file was removed with the old results.
        old_lock.set_folder(&self.path);
        self.lock.set_folder(&folder);
        Ok(())
    }
}

/// Locks a folder without links among its result files; removes unfinished files of killed processes.
fn lock_folder(folder: &Path, kind: Kind) -> Result<FolderLock, Error> {
    refuse_links(folder, kind)?;
    let lock = FolderLock::take(folder)?;
    // No other process writes files of this kind here while this one has the lock.
    remove_files(folder, |name| kind.is_unfinished(name))?;
    Ok(lock)
}

/// Content of a path to which a run may write its results.
enum FolderContent {
    /// No folder, or an empty one.
    Nothing,
    /// Results that are to be replaced.
    Results,
}

impl FolderContent {
    /// Content of a path, if a run may write there; `given` is the user's form of the path.
    fn usable_content(path: &Path, given: &Path, kind: Kind, replace: bool) -> Result<Self, Error> {
        let metadata = match fs::metadata(path) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::Nothing),
            Err(error) => return Err(Error::system("look at", path)(error)),
        };
        let (given, marker) = (given.to_path_buf(), kind.marker);
        let elsewhere = |way| Remedy::OtherPath(PathKind::Folder, way);
        if !metadata.is_dir() {
            return Err(Error::NotAFolder(given, elsewhere(None)));
        }
        let entries = fs::read_dir(path).map_err(Error::system("list", path))?;
        let mut names = entries.flatten().map(|entry| entry.file_name());
        // A run that was killed before its first output leaves only these.
        let is_trace = |name: &str| name.starts_with('.') && kind.may_remove(name);
        if names.all(|name| is_trace(&name.to_string_lossy())) {
            return Ok(Self::Nothing);
        }
        match path.join(marker).is_file() {
            true if replace => Ok(Self::Results),
            true => Err(Error::ResultsExist(
                given,
                elsewhere(Some(Resolution::Replace)),
            )),
            false => Err(Error::NotAResultFolder {
                path: given,
                marker,
                remedy: elsewhere(Some(Resolution::Remove)),
            }),
        }
    }
}

/// Copies the files of a folder with the results of a run into another one, where earlier results are replaced if `replace` is set.
///
/// # Errors
///
/// If a process writes to either folder, the other one may not be used, or a file cannot be copied.
pub fn copy_results(from: &Path, to: &Path, replace: bool) -> Result<(), Error> {
    recover(from, Kind::RUN)?;
    FolderLock::check(from)?;
    refuse_links(from, Kind::RUN)?;
    let into = ResultFolder::create(to, replace)?;
    let mut names = names(from)?;
    // First the file by which a folder is recognised.
    names.sort_by_key(|name| name.to_str() != Some(Kind::RUN.marker));
    for name in names {
        let (source, target) = (from.join(&name), into.path().join(&name));
        let is_trace = name.to_str().is_some_and(is_lock_or_temporary);
        if !is_trace && source.is_file() {
            fs::copy(&source, &target).map_err(Error::system("copy", &source))?;
        }
    }
    into.finish()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    /// A parent folder and in it the path `results`, holding the given files.
    fn results_with(files: &[&str]) -> (TempDir, PathBuf) {
        let parent = tempfile::tempdir().unwrap();
        let path = parent.path().join("results");
        fs::create_dir(&path).unwrap();
        for file in files {
            fs::write(path.join(file), "old").unwrap();
        }
        (parent, path)
    }

    fn n_entries(path: &Path) -> usize {
        fs::read_dir(path).unwrap().count()
    }

    #[test]
    fn creates_parents_and_writes_texts() {
        let parent = tempfile::tempdir().unwrap();
        let folder = ResultFolder::create(parent.path().join("a/b"), false).unwrap();
        folder.write("summary.json", "{}").unwrap();
        folder.write("summary.json", "{\"volume\": 1.0}").unwrap();
        let text = fs::read_to_string(folder.path().join("summary.json")).unwrap();
        assert_eq!(text, "{\"volume\": 1.0}");
        drop(folder);
        assert_eq!(n_entries(&parent.path().join("a/b")), 1);
    }

    #[test]
    fn uses_an_empty_folder() {
        for replace in [false, true] {
            let (_parent, path) = results_with(&[]);
            ResultFolder::create(&path, replace).unwrap();
        }
    }

    #[test]
    fn refuses_results_without_replace() {
        let (_parent, path) = results_with(&[RESOLVED_CASE]);
        let error = ResultFolder::create(&path, false).unwrap_err();
        assert!(matches!(&error, Error::ResultsExist(p, _) if *p == path));
        let source = std::error::Error::source(&error).unwrap();
        let remedy = Remedy::OtherPath(PathKind::Folder, Some(Resolution::Replace));
        assert_eq!(source.downcast_ref(), Some(&remedy));
        assert_eq!(n_entries(&path), 1);
    }

    fn names_in(path: &Path) -> Vec<String> {
        let entries = fs::read_dir(path).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Replaces the results in a folder completely.
    fn replace(path: &Path) {
        let folder = ResultFolder::create(path, true).unwrap();
        folder.write(RESOLVED_CASE, "new").unwrap();
        folder.finish().unwrap();
    }

    #[test]
    fn earlier_results_stay_until_the_new_ones_are_complete() {
        let (parent, path) = results_with(&[RESOLVED_CASE, "fields_0000.vtu"]);
        ResultFolder::check(&path, true).unwrap();
        assert_eq!(n_entries(&path), 2, "a check touches nothing");
        let folder = ResultFolder::create(&path, true).unwrap();
        folder.write(RESOLVED_CASE, "new").unwrap();
        assert_eq!(folder.path(), parent.path().join("results.new"));
        drop(folder);
        assert_eq!(names_in(&path), [RESOLVED_CASE, "fields_0000.vtu"]);
        replace(&path);
        assert_eq!(names_in(&path), [RESOLVED_CASE]);
        assert_eq!(fs::read_to_string(path.join(RESOLVED_CASE)).unwrap(), "new");
        assert_eq!(n_entries(parent.path()), 1, "the old results are gone");
    }

    #[test]
    fn files_of_others_stay() {
        let foreign = ["history.ods", "thesis.tex"];
        let (parent, path) = results_with(&[RESOLVED_CASE, "history.csv", foreign[0], foreign[1]]);
        fs::create_dir(path.join("pictures")).unwrap();
        fs::write(path.join("pictures/a.png"), "old").unwrap();
        replace(&path);
        let left = [RESOLVED_CASE, foreign[0], "pictures", foreign[1]];
        assert_eq!(names_in(&path), left);
        assert!(path.join("pictures/a.png").is_file());
        assert_eq!(n_entries(parent.path()), 1);
    }

    #[test]
    fn one_process_writes_to_a_folder_at_a_time() {
        for old in [&[][..], &[RESOLVED_CASE]] {
            let (_parent, path) = results_with(old);
            let first = ResultFolder::create(&path, true).unwrap();
            for error in [
                ResultFolder::check(&path, true).unwrap_err(),
                ResultFolder::create(&path, true).unwrap_err(),
                ResultFolder::open(&path, Kind::RUN).unwrap_err(),
            ] {
                let message = error.to_string();
                assert!(
                    message.contains(&std::process::id().to_string()),
                    "{message}"
                );
            }
            drop(first);
            ResultFolder::create(&path, true).unwrap();
        }
    }

    #[test]
    fn what_a_kill_leaves_does_not_lock() {
        let (_parent, path) = results_with(&[".lock", ".case.resolved.toml.17.partial"]);
        ResultFolder::create(&path, false).unwrap();
    }

    #[test]
    fn a_replacement_that_was_cut_short_goes_on() {
        // Killed between the two renames, with the new results and without any.
        for new in [true, false] {
            let (parent, path) = results_with(&[RESOLVED_CASE, "thesis.tex", ".replaced"]);
            fs::rename(&path, parent.path().join("results.replaced")).unwrap();
            if new {
                fs::create_dir(parent.path().join("results.new")).unwrap();
                fs::write(parent.path().join("results.new").join(RESOLVED_CASE), "new").unwrap();
            }
            let error = ResultFolder::check(&path, false).unwrap_err();
            assert!(matches!(error, Error::ResultsExist(..)));
            let text = fs::read_to_string(path.join(RESOLVED_CASE)).unwrap();
            assert_eq!(text, if new { "new" } else { "old" });
            assert!(path.join("thesis.tex").is_file());
            assert_eq!(n_entries(parent.path()), 1);
        }
    }

    #[test]
    fn a_run_that_was_to_replace_results_is_resumed_by_either_name() {
        for name in ["results", "results.new"] {
            let (parent, path) = results_with(&[RESOLVED_CASE]);
            let folder = ResultFolder::create(&path, true).unwrap();
            folder.write(RESOLVED_CASE, "new").unwrap();
            drop(folder);
            let folder = ResultFolder::open_resumed(parent.path().join(name)).unwrap();
            assert_eq!(folder.path(), parent.path().join("results.new"));
            folder.finish().unwrap();
            assert_eq!(fs::read_to_string(path.join(RESOLVED_CASE)).unwrap(), "new");
            assert_eq!(n_entries(parent.path()), 1);
        }
    }

    #[test]
    fn a_trailing_separator_does_not_matter() {
        let (parent, path) = results_with(&[RESOLVED_CASE]);
        replace(&path.join(""));
        assert_eq!(fs::read_to_string(path.join(RESOLVED_CASE)).unwrap(), "new");
        assert_eq!(n_entries(parent.path()), 1);
    }

    #[test]
    fn never_removes_other_files() {
        for replace in [false, true] {
            let (_parent, path) = results_with(&["thesis.tex"]);
            let error = ResultFolder::create(&path, replace).unwrap_err();
            assert!(matches!(error, Error::NotAResultFolder { .. }));
            assert_eq!(fs::read_to_string(path.join("thesis.tex")).unwrap(), "old");
        }
    }

    #[test]
    fn a_folder_named_like_a_marker_is_no_marker() {
        let (_parent, path) = results_with(&[]);
        fs::create_dir(path.join("summary.json")).unwrap();
        let error = ResultFolder::create(&path, true).unwrap_err();
        assert!(matches!(error, Error::NotAResultFolder { .. }));
    }

    #[test]
    fn refuses_a_file_in_its_place() {
        for replace in [false, true] {
            let parent = tempfile::tempdir().unwrap();
            let path = parent.path().join("results");
            fs::write(&path, "a file").unwrap();
            let error = ResultFolder::create(&path, replace).unwrap_err();
            assert!(matches!(error, Error::NotAFolder(..)));
            assert_eq!(fs::read_to_string(&path).unwrap(), "a file");
        }
    }

    #[test]
    fn refuses_when_the_place_aside_is_taken() {
        let (parent, path) = results_with(&[RESOLVED_CASE]);
        let aside = parent.path().join("results.replaced");
        fs::create_dir(&aside).unwrap();
        let error = ResultFolder::create(&path, true).unwrap_err();
        assert!(matches!(error, Error::ReplacedExists(p, _) if p == aside));
        assert_eq!(n_entries(&path), 1);
    }

    #[test]
    fn refuses_to_replace_a_path_without_a_name() {
        let (_parent, path) = results_with(&[RESOLVED_CASE]);
        fs::create_dir(path.join("sub")).unwrap();
        let error = ResultFolder::create(path.join("sub/.."), true).unwrap_err();
        assert!(matches!(error, Error::UnnamedFolder(..)));
        assert_eq!(n_entries(&path), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_linked_folder_stays_a_link() {
        let (parent, path) = results_with(&[RESOLVED_CASE, "history.csv"]);
        let link = parent.path().join("link");
        std::os::unix::fs::symlink(&path, &link).unwrap();
        replace(&link.join(""));
        assert_eq!(fs::read_link(&link).unwrap(), path);
        assert_eq!(names_in(&path), [RESOLVED_CASE]);
        assert_eq!(n_entries(parent.path()), 2);
    }
}
