//! Length and digest of a written file, to detect later changes.

use std::fs::File;
use std::hash::Hasher;
use std::io::{self, Read};
use std::path::Path;

use serde::{Deserialize, Serialize};
use twox_hash::XxHash64;

/// Length and digest of the beginning of a written file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileDigest {
    /// Length, bytes.
    pub length: u64,
    /// XXH64 digest of these bytes.
    pub digest: u64,
}

/// Size of a buffer for reading, bytes.
const AT_ONCE: usize = 1 << 16;

impl FileDigest {
    /// Length and digest of a whole file.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub(crate) fn of_file(path: &Path) -> io::Result<Self> {
        let (digest, length) = digest_of_beginning(path, u64::MAX)?;
        let digest = digest.finish();
        Ok(Self { length, digest })
    }

    /// Reason why a file no longer begins as it was written; `None` if it does.
    pub(crate) fn mismatch(self, path: &Path) -> Option<String> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let length = self.length;
        match digest_of_beginning(path, length) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Some(format!("{name} is missing"))
            }
            Err(error) => Some(format!("{name} cannot be read: {error}")),
            Ok((_, found)) if found < length => Some(format!(
                "{name} has {found} bytes where it had {length} when its checkpoint was written"
            )),
            Ok((digest, _)) => (digest.finish() != self.digest).then(|| {
                format!(
                    "{name} was changed since: its first {length} bytes are not those that the run wrote; put back what was \
                     there, or run the case anew"
                )
            }),
        }
    }
}

/// Digest of at most `most` bytes at the beginning of a file, which can be continued, and the number of bytes.
pub(crate) fn digest_of_beginning(path: &Path, most: u64) -> io::Result<(XxHash64, u64)> {
    let mut digest = XxHash64::with_seed(0);
    let mut file = File::open(path)?.take(most);
    let (mut bytes, mut length) = (vec![0; AT_ONCE], 0);
    loop {
        match file.read(&mut bytes)? {
            0 => return Ok((digest, length)),
            count => {
                digest.write(&bytes[..count]);
                length += count as u64;
            }
        }
    }
}
