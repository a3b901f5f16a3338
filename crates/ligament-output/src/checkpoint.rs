//! Checkpoint files: the complete state from which a run can be resumed.
//!
//! | bytes | what |
//! |---|---|
//! | 19 | `ligament checkpoint` |
//! | 4 | [`FORMAT`] |
//! | 8 | length of the rest without the digest |
//! | ... | version of the program, inputs, solution, results, notices |
//! | 8 | XXH64 of all before |
//!
//! Numbers are little-endian. A file is written under a temporary name and renamed when it is complete and synced to disk; the previous
//! checkpoint is kept, in case the newest one is damaged later.

use std::io;
use std::path::Path;

use ligament_analysis::serial;
use ligament_analysis::serial::Serial;
use twox_hash::XxHash64;

use crate::Error;
use crate::atomic::{read_bytes, remove_file, rotate_file};

/// File names of the newest checkpoint in a result folder, and of the previous one.
pub const NAMES: [&str; 2] = ["checkpoint.bin", "checkpoint.older.bin"];

/// Number of the format, which changes with every change of the content.
pub const FORMAT: u32 = 7;

const BEGINNING: &[u8; 19] = b"ligament checkpoint";

/// Bytes before the content.
const HEADER: usize = BEGINNING.len() + size_of::<u32>() + size_of::<u64>();

/// The state of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    /// Version of the program that wrote the checkpoint.
    pub version: String,
    /// All inputs of the run, as text.
    pub inputs: String,
    /// Solution and state of the driver.
    pub solution: Vec<u8>,
    /// State of the written results.
    pub results: Vec<u8>,
    /// Notices for the user so far.
    pub notices: Vec<String>,
}

serial!(Checkpoint {
    version,
    inputs,
    solution,
    results,
    notices
});

impl Checkpoint {
    /// Writes the checkpoint into a folder as the newest one, and returns its size in bytes.
    ///
    /// # Errors
    ///
    /// If the file cannot be written; the previous checkpoint then still exists.
    pub fn write(&self, folder: &Path) -> Result<usize, Error> {
        let mut bytes = BEGINNING.to_vec();
        FORMAT.write(&mut bytes);
        0_u64.write(&mut bytes);
        self.write_content(&mut bytes);
        let [newest, older] = NAMES.map(|name| folder.join(name));
        rotate_file(&newest, &older, &bytes)?;
        Ok(bytes.len())
    }

    fn write_content(&self, bytes: &mut Vec<u8>) {
        Serial::write(self, bytes);
        let length = (bytes.len() - HEADER) as u64;
        bytes[HEADER - size_of::<u64>()..HEADER].copy_from_slice(&length.to_le_bytes());
        XxHash64::oneshot(0, bytes).write(bytes);
    }

    /// The existing checkpoints of a folder, the newest first.
    pub fn list(folder: &Path) -> Vec<Result<Self, Error>> {
        let paths = NAMES.iter().map(|name| folder.join(name));
        let read = paths.map(|path| match read_bytes(&path) {
            Ok(bytes) => {
                Some(Self::from_bytes(&bytes).map_err(|reason| Error::Unreadable { path, reason }))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => Some(Err(Error::system("read", &path)(error))),
        });
        read.flatten().collect()
    }

    /// Removes the checkpoints of a folder.
    ///
    /// # Errors
    ///
    /// If the files cannot be removed.
    pub fn remove(folder: &Path) -> Result<(), Error> {
        let mut names = NAMES.iter();
        names.try_for_each(|name| remove_file(&folder.join(name)))
    }

    /// Parses a checkpoint; as the error the reason why the bytes are none.
    ///
    /// # Errors
    ///
    /// If the bytes are no checkpoint, of another format, or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let Some(mut rest) = bytes.strip_prefix(BEGINNING) else {
            return Err("it is no checkpoint of a run".to_owned());
        };
        let damaged = |_| "it is damaged".to_owned();
        let format = u32::read(&mut rest).map_err(damaged)?;
        if format != FORMAT {
            return Err(format!(
                "it is of format {format}, which another version of the program writes; this one reads format {FORMAT}"
            ));
        }
        let length = usize::read(&mut rest).map_err(damaged)?;
        let digested = HEADER
            .checked_add(length)
            .and_then(|end| bytes.split_at_checked(end));
        let Some((digested, mut digest)) = digested else {
            return Err(format!("it ends after {} bytes, too early", bytes.len()));
        };
        if u64::read(&mut digest) != Ok(XxHash64::oneshot(0, digested)) || !digest.is_empty() {
            return Err("it is damaged: its digest is another one".to_owned());
        }
        let mut content = &digested[HEADER..];
        let checkpoint = Self::read(&mut content).map_err(damaged)?;
        Ok(checkpoint)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::fs;

    use super::*;

    fn checkpoint(number: u8) -> Checkpoint {
        Checkpoint {
            version: "1.2.3".to_owned(),
            inputs: "title = \"a case\"".to_owned(),
            solution: vec![number; 300],
            results: vec![number; 20],
            notices: vec!["step 3: a notice".to_owned()],
        }
    }

    fn read(folder: &Path) -> Vec<Option<Checkpoint>> {
        Checkpoint::list(folder)
            .into_iter()
            .map(Result::ok)
            .collect()
    }

    #[test]
    fn two_generations_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(read(folder.path()), []);
        for number in 0..4 {
            checkpoint(number).write(folder.path()).unwrap();
            let expected = (number.saturating_sub(1)..=number).rev().map(checkpoint);
            assert_eq!(read(folder.path()), expected.map(Some).collect::<Vec<_>>());
        }
        Checkpoint::remove(folder.path()).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    /// Every cut and every changed bit is noticed, and the one before is still there.
    #[test]
    fn a_damaged_one_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        checkpoint(1).write(folder.path()).unwrap();
        checkpoint(2).write(folder.path()).unwrap();
        let path = folder.path().join(NAMES[0]);
        let whole = fs::read(&path).unwrap();
        for end in 0..whole.len() {
            assert!(
                Checkpoint::from_bytes(&whole[..end]).is_err(),
                "{end} bytes"
            );
        }
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 1 << (place % 8);
            assert!(Checkpoint::from_bytes(&changed).is_err(), "byte {place}");
        }
        let longer = [whole.as_slice(), b"more"].concat();
        assert!(Checkpoint::from_bytes(&longer).is_err());
        fs::write(&path, &whole[..100]).unwrap();
        assert_eq!(read(folder.path()), [None, Some(checkpoint(1))]);
    }

    #[test]
    fn another_format_is_named() {
        let folder = tempfile::tempdir().unwrap();
        checkpoint(1).write(folder.path()).unwrap();
        let mut bytes = fs::read(folder.path().join(NAMES[0])).unwrap();
        bytes[BEGINNING.len()] += 1;
        let reason = Checkpoint::from_bytes(&bytes).unwrap_err();
        assert!(
            reason.contains("format 8") && reason.contains("format 7"),
            "{reason}"
        );
        let reason = Checkpoint::from_bytes(b"step,load_factor").unwrap_err();
        assert_eq!(reason, "it is no checkpoint of a run");
    }
}
