//! A folder one file of which is another: the input is the name of the file, a line feed and its content.

use std::fs;
use std::path::{Path, PathBuf};

use crate::arrays;

/// A folder with the files that belong into it.
pub(crate) struct Folder {
    path: PathBuf,
    files: Vec<(String, Vec<u8>)>,
}

impl Folder {
    /// The folder as it is.
    pub(crate) fn read(path: PathBuf) -> Self {
        let mut files = Vec::new();
        let mut folders = vec![path.clone()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
                if entry.path().is_dir() {
                    folders.push(entry.path());
                    continue;
                }
                let name = entry.path().strip_prefix(&path).unwrap().to_owned();
                let content = fs::read(entry.path()).unwrap();
                files.push((name.into_os_string().into_string().unwrap(), content));
            }
        }
        files.sort();
        Self { path, files }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Each file that is read, and each array of a VTU file by itself, as it is and without a number: changed in the
    /// file, its checksum would be all that is read.
    pub(crate) fn seeds(&self, is_read: impl Fn(&str) -> bool) -> Vec<Vec<u8>> {
        let mut seeds = Vec::new();
        for (name, content) in self.files.iter().filter(|it| is_read(&it.0)) {
            seeds.push([name.as_bytes(), b"\n", content].concat());
            if name.ends_with(".vtu") {
                for (number, array) in arrays::opened(content).into_iter().enumerate() {
                    let seed =
                        |bytes: &[u8]| [format!("{name}#{number}\n").as_bytes(), bytes].concat();
                    seeds.extend([seed(&array), seed(&vec![u8::MAX; array.len()])]);
                }
            }
        }
        seeds
    }

    /// Makes the folder anew, with the file that an input is; gives whether it is one of its files.
    pub(crate) fn make(&self, input: &[u8]) -> bool {
        let mut parts = input.splitn(2, |byte| *byte == b'\n');
        let word = String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
        let content = parts.next().unwrap_or_default();
        let (name, array) = match word.split_once('#') {
            Some((name, number)) => (name, number.parse().ok()),
            None => (word.as_str(), None),
        };
        let Some((name, whole)) = self.files.iter().find(|it| it.0 == name) else {
            return false;
        };
        self.restore();
        let content = match array {
            Some(number) => arrays::exchanged(whole, number, content),
            None => content.to_owned(),
        };
        fs::write(self.path.join(name), content).unwrap();
        true
    }

    /// Makes the folder anew as it was.
    pub(crate) fn restore(&self) {
        if self.path.exists() {
            fs::remove_dir_all(&self.path).unwrap();
        }
        for (name, content) in &self.files {
            let path = self.path.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        }
    }
}
