//! The folder that holds the results of one run.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::atomic::replace_file;

/// The file that every run writes first; it shows that a folder holds results and nothing else.
pub const RESOLVED_CASE: &str = "case.resolved.toml";

/// A folder for the results of one run, new or empty when created.
///
/// A run writes [`RESOLVED_CASE`] first: by it a later run recognises the folder as one it may replace. What is no run
/// has another such file, its marker.
#[derive(Debug)]
pub struct ResultFolder {
    path: PathBuf,
}

impl ResultFolder {
    /// Creates the folder and its parents. An existing empty folder is used as it is.
    ///
    /// A folder with results is refused unless `replace` is set; then it is moved aside to `NAME.replaced`, the new
    /// folder is created and the old one removed. A folder with other files is refused in any case.
    pub fn create(path: impl Into<PathBuf>, replace: bool) -> Result<Self, Error> {
        Self::create_marked(path, RESOLVED_CASE, replace)
    }

    /// Creates a folder that is recognised by another file than [`RESOLVED_CASE`], which the caller writes first.
    pub fn create_marked(
        path: impl Into<PathBuf>,
        marker: &'static str,
        replace: bool,
    ) -> Result<Self, Error> {
        let path = path.into();
        match Occupant::admitted(&path, marker, replace)? {
            Occupant::Nothing => create_folder(&path)?,
            Occupant::EmptyFolder => {}
            Occupant::Results => replace_folder(&path)?,
        }
        Ok(Self { path })
    }

    /// A folder that is there already, with what it holds: for work that is taken up again.
    pub fn existing(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// Fails as [`ResultFolder::create`] would, and touches nothing: for a run to ask before its work begins.
    pub fn check(path: &Path, replace: bool) -> Result<(), Error> {
        Occupant::admitted(path, RESOLVED_CASE, replace).map(|_| ())
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The path of a file in the folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// Writes a text file in the folder atomically, replacing an earlier one of that name.
    pub fn write_text(&self, name: &str, text: &str) -> Result<(), Error> {
        replace_file(&self.file(name), text.as_bytes())
    }
}

/// The occupant of the place of a result folder, where a run may put its results.
enum Occupant {
    Nothing,
    EmptyFolder,
    /// Results, to be replaced.
    Results,
}

impl Occupant {
    fn admitted(path: &Path, marker: &'static str, replace: bool) -> Result<Self, Error> {
        let metadata = match fs::metadata(path) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::Nothing),
            Err(error) => return Err(Error::system("look at", path)(error)),
        };
        let path_buf = path.to_path_buf();
        if !metadata.is_dir() {
            return Err(Error::NotAFolder(path_buf));
        }
        let mut entries = fs::read_dir(path).map_err(Error::system("list", path))?;
        if entries.next().is_none() {
            return Ok(Self::EmptyFolder);
        }
        match path.join(marker).is_file() {
            true if replace => Ok(Self::Results),
            true => Err(Error::ResultsExist(path_buf)),
            false => Err(Error::NotAResultFolder {
                path: path_buf,
                marker,
            }),
        }
    }
}

/// Replaces a result folder by an empty one. The old results are removed last, so a failure on the way keeps them.
fn replace_folder(path: &Path) -> Result<(), Error> {
    let aside = replaced_path(path)?;
    // `exists` would follow a dangling link.
    if fs::symlink_metadata(&aside).is_ok() {
        return Err(Error::ReplacedExists(aside));
    }
    fs::rename(path, &aside).map_err(Error::system("move aside", path))?;
    if let Err(error) = create_folder(path) {
        // Back to where it was, if that still works; the failure to report is the first one.
        let _ = fs::rename(&aside, path);
        return Err(error);
    }
    fs::remove_dir_all(&aside).map_err(Error::system("remove", &aside))
}

/// The sibling `NAME.replaced` of a folder `NAME`.
fn replaced_path(path: &Path) -> Result<PathBuf, Error> {
    let name = path.file_name();
    let name = name.ok_or_else(|| Error::UnnamedFolder(path.to_path_buf()))?;
    let mut replaced = OsString::from(name);
    replaced.push(".replaced");
    Ok(path.with_file_name(replaced))
}

fn create_folder(path: &Path) -> Result<(), Error> {
    fs::create_dir_all(path).map_err(Error::system("create", path))
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
        folder.write_text("summary.json", "{}").unwrap();
        folder
            .write_text("summary.json", "{\"volume\": 1.0}")
            .unwrap();
        let text = fs::read_to_string(folder.path().join("summary.json")).unwrap();
        assert_eq!(text, "{\"volume\": 1.0}");
        assert_eq!(n_entries(folder.path()), 1);
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
        assert!(matches!(&error, Error::ResultsExist(p) if *p == path));
        let message = error.to_string();
        assert!(
            message.contains("--out") && message.contains("--force"),
            "{message}"
        );
        assert_eq!(n_entries(&path), 1);
    }

    #[test]
    fn replaces_results() {
        let (parent, path) = results_with(&[RESOLVED_CASE, "fields_0000.vtu"]);
        ResultFolder::check(&path, true).unwrap();
        assert_eq!(n_entries(&path), 2, "a check touches nothing");
        ResultFolder::create(&path, true).unwrap();
        assert_eq!(n_entries(&path), 0);
        assert_eq!(n_entries(parent.path()), 1, "the old results are gone");
    }

    #[test]
    fn a_trailing_separator_does_not_matter() {
        let (parent, path) = results_with(&[RESOLVED_CASE]);
        ResultFolder::create(path.join(""), true).unwrap();
        assert_eq!(n_entries(&path), 0);
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
            assert!(matches!(error, Error::NotAFolder(_)));
            assert_eq!(fs::read_to_string(&path).unwrap(), "a file");
        }
    }

    #[test]
    fn refuses_when_the_place_aside_is_taken() {
        let (parent, path) = results_with(&[RESOLVED_CASE]);
        let aside = parent.path().join("results.replaced");
        fs::create_dir(&aside).unwrap();
        let error = ResultFolder::create(&path, true).unwrap_err();
        assert!(matches!(error, Error::ReplacedExists(p) if p == aside));
        assert_eq!(n_entries(&path), 1);
    }

    #[test]
    fn refuses_to_replace_a_path_without_a_name() {
        let (_parent, path) = results_with(&[RESOLVED_CASE]);
        fs::create_dir(path.join("sub")).unwrap();
        let error = ResultFolder::create(path.join("sub/.."), true).unwrap_err();
        assert!(matches!(error, Error::UnnamedFolder(_)));
        assert_eq!(n_entries(&path), 2);
    }

    #[cfg(unix)]
    #[test]
    fn replacing_a_link_keeps_what_it_points_to() {
        let (parent, path) = results_with(&[RESOLVED_CASE]);
        let link = parent.path().join("link");
        std::os::unix::fs::symlink(&path, &link).unwrap();
        ResultFolder::create(&link, true).unwrap();
        assert_eq!(n_entries(&link), 0);
        assert_eq!(n_entries(&path), 1);
    }
}
