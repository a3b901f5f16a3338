//! Input files of the user.

use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Reads the bytes of a file.
///
/// # Errors
///
/// If the file cannot be read, or is a pipe or a device, which may never end.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    require_end(path)?;
    fs::read(path)
}

/// Opens a file.
///
/// # Errors
///
/// As for [`read`].
pub(crate) fn open(path: &Path) -> io::Result<File> {
    require_end(path)?;
    File::open(path)
}

/// Refuses a pipe or a device, which may never end.
fn require_end(path: &Path) -> io::Result<()> {
    let kind = fs::metadata(path)?.file_type();
    if !kind.is_file() && !kind.is_dir() {
        let reason = "it is a pipe or a device, which may never end: save what it gives to a file";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
    }
    Ok(())
}

/// Reads the text of a file.
///
/// # Errors
///
/// As for [`read`], and if the file is not UTF-8.
pub fn read_text(path: &Path) -> io::Result<String> {
    String::from_utf8(read(path)?).map_err(|_| {
        io::Error::new(
            io::ErrorKind::InvalidData,
            "stream did not contain valid UTF-8",
        )
    })
}
