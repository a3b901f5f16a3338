//! Checkpoint files: the complete state from which a run can be resumed.
//!
//! | bytes | what |
//! |---|---|
//! | 19 | `ligament checkpoint` |
//! | 4 | [`FORMAT`] |
//! | 8 | length of the content |
//! | ... | content: version of the program, inputs, results, messages, solution |
//! | 8 | XXH64 of the content |
//!
//! Numbers are little-endian. The solution is streamed into the file and from it, so that its bytes are never in memory as a whole. A file
//! is written under a temporary name and renamed when it is complete and synced to disk; the previous checkpoint is kept, in case the
//! newest one is damaged later.

use std::fs::File;
use std::hash::Hasher;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;

use ligament_analysis::Message;
use ligament_analysis::serial::{Damaged, Serial, Sink};
use serde::{Deserialize, Serialize};
use twox_hash::XxHash64;

use crate::Error;
use crate::atomic::{open_regular, remove_file, rotate_file};

/// File names of the newest checkpoint in a result folder, and of the previous one.
pub const NAMES: [&str; 2] = ["checkpoint.bin", "checkpoint.older.bin"];

/// Number of the format, which changes with every change of the content.
pub const FORMAT: u32 = 14;

const BEGINNING: &[u8; 19] = b"ligament checkpoint";

/// Bytes before the content.
const HEADER: u64 = (BEGINNING.len() + size_of::<u32>() + size_of::<u64>()) as u64;

/// Bytes of the digest behind the content.
const DIGEST: u64 = size_of::<u64>() as u64;

/// Number of bytes that are written or read at a time.
const AT_ONCE: usize = 1 << 16;

/// The state of a run except its solution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Version of the program that wrote the checkpoint.
    pub version: String,
    /// All inputs of the run, as text.
    pub inputs: String,
    /// State of the written results.
    pub results: Vec<u8>,
    /// Messages to the user so far.
    pub messages: Vec<Message>,
}

/// Place of the solution and of the state of the driver in the file of a checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredSolution {
    /// Index in [`NAMES`] of the file.
    file: usize,
    /// First byte and length.
    bytes: [u64; 2],
}

impl StoredSolution {
    /// Opens the solution in the folder of the results.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub fn open(&self, folder: &Path) -> Result<impl Read + use<>, Error> {
        let path = folder.join(NAMES[self.file]);
        let [start, length] = self.bytes;
        let open = || {
            let mut file = open_regular(&path)?;
            file.seek(SeekFrom::Start(start))?;
            Ok(BufReader::with_capacity(AT_ONCE, file).take(length))
        };
        open().map_err(Error::system("read", &path))
    }
}

impl Checkpoint {
    /// Writes the checkpoint into a folder as the newest one, with a function that writes the solution.
    ///
    /// # Errors
    ///
    /// If the file cannot be written; the previous checkpoint then still exists.
    pub fn write(&self, folder: &Path, solution: impl FnOnce(&mut dyn Sink)) -> Result<(), Error> {
        let [newest, older] = NAMES.map(|name| folder.join(name));
        rotate_file(&newest, &older, |file| {
            let mut header = BEGINNING.to_vec();
            header.extend(FORMAT.to_le_bytes());
            header.extend(0_u64.to_le_bytes());
            file.write_all(&header)?;
            let mut content = ContentWriter::new(file);
            Serial::write(self, &mut content);
            solution(&mut content);
            let (length, digest) = content.finish()?;
            file.write_all(&digest.to_le_bytes())?;
            file.seek(SeekFrom::Start(HEADER - size_of::<u64>() as u64))?;
            file.write_all(&length.to_le_bytes())
        })
    }

    /// The existing checkpoints of a folder with the places of their solutions, the newest first.
    pub fn list(folder: &Path) -> Vec<Result<(Self, StoredSolution), Error>> {
        let read = NAMES.iter().enumerate().map(|(file, name)| {
            let path = folder.join(name);
            let opened = open_regular(&path).and_then(|it| Ok((it.metadata()?.len(), it)));
            match opened {
                Ok((length, opened)) => Some(match Self::parse(opened, length) {
                    Ok((checkpoint, bytes)) => Ok((checkpoint, StoredSolution { file, bytes })),
                    Err(reason) => Err(Error::Unreadable { path, reason }),
                }),
                Err(error) if error.kind() == io::ErrorKind::NotFound => None,
                Err(error) => Some(Err(Error::system("read", &path)(error))),
            }
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

    /// Reads a checkpoint of a number of bytes; returns it with the first byte and the length of its solution, or as the error the reason
    /// why the bytes are no checkpoint.
    ///
    /// # Errors
    ///
    /// If the bytes are no checkpoint, of another format, or damaged.
    pub fn parse(from: impl Read, n_bytes: u64) -> Result<(Self, [u64; 2]), String> {
        let mut from = BufReader::with_capacity(AT_ONCE, from);
        let mut beginning = [0; BEGINNING.len()];
        if from.read_exact(&mut beginning).is_err() || beginning != *BEGINNING {
            return Err("it is no checkpoint of a run".to_owned());
        }
        let damaged = |_| "it is damaged".to_owned();
        let format = read_bytes(&mut from).map(u32::from_le_bytes);
        let format = format.map_err(damaged)?;
        if format != FORMAT {
            return Err(format!(
                "it is of format {format}, which another version of the program writes; this one reads format {FORMAT}"
            ));
        }
        let length = read_bytes(&mut from).map(u64::from_le_bytes);
        let length = length.map_err(damaged)?;
        let in_file = n_bytes.saturating_sub(HEADER + DIGEST);
        if in_file < length {
            return Err(format!("it ends after {n_bytes} bytes, too early"));
        }
        let mut content = DigestReader::new((&mut from).take(length));
        let checkpoint = Self::read(&mut content).map_err(damaged)?;
        let before = length - content.from.limit();
        let rest = io::copy(&mut content, &mut io::sink());
        let digest = content.digest.finish();
        if rest.is_err()
            || in_file != length
            || read_bytes(&mut from).map(u64::from_le_bytes).ok() != Some(digest)
        {
            return Err("it is damaged: its digest is another one".to_owned());
        }
        Ok((checkpoint, [HEADER + before, length - before]))
    }
}

/// Reads the next N bytes.
fn read_bytes<const N: usize>(from: &mut impl Read) -> Result<[u8; N], Damaged> {
    let mut bytes = [0; N];
    let read = from.read_exact(&mut bytes);
    read.map(|()| bytes).map_err(|_| Damaged)
}

/// Writer of the content of a checkpoint, which keeps its length and digest.
struct ContentWriter<'a> {
    file: &'a mut File,
    /// Bytes that are not yet in the file.
    waiting: Vec<u8>,
    digest: XxHash64,
    /// Number of bytes in the file.
    length: u64,
    /// First error of the file, after which no more bytes are written.
    result: io::Result<()>,
}

impl<'a> ContentWriter<'a> {
    fn new(file: &'a mut File) -> Self {
        Self {
            file,
            waiting: Vec::new(),
            digest: XxHash64::with_seed(0),
            length: 0,
            result: Ok(()),
        }
    }

    fn flush(&mut self) {
        self.digest.write(&self.waiting);
        self.length += self.waiting.len() as u64;
        if self.result.is_ok() {
            self.result = self.file.write_all(&self.waiting);
        }
        self.waiting.clear();
    }

    /// Writes the rest of the content to the file; returns length and digest of the whole content.
    fn finish(mut self) -> io::Result<(u64, u64)> {
        self.flush();
        self.result?;
        Ok((self.length, self.digest.finish()))
    }
}

impl Sink for ContentWriter<'_> {
    fn put(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
        if self.waiting.len() >= AT_ONCE {
            self.flush();
        }
    }
}

/// A stream with the digest of the bytes read so far.
struct DigestReader<R> {
    from: R,
    digest: XxHash64,
}

impl<R> DigestReader<R> {
    fn new(from: R) -> Self {
        Self {
            from,
            digest: XxHash64::with_seed(0),
        }
    }
}

impl<R: Read> Read for DigestReader<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.from.read(buffer)?;
        self.digest.write(&buffer[..count]);
        Ok(count)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use std::fs;

    use super::*;

    fn checkpoint(number: u8) -> Checkpoint {
        Checkpoint {
            version: "1.2.3".to_owned(),
            inputs: "title = \"a case\"".to_owned(),
            results: vec![number; 20],
            messages: vec![Message::new("kind", "a message").in_step(3)],
        }
    }

    /// A solution filled with a number, longer than what is written at a time.
    fn solution(number: u8) -> Vec<u8> {
        vec![number; 3 * AT_ONCE + 100]
    }

    fn written(folder: &Path, number: u8, solution: &[u8]) {
        let in_pieces = |out: &mut dyn Sink| solution.chunks(1000).for_each(|it| out.put(it));
        checkpoint(number).write(folder, in_pieces).unwrap();
    }

    fn read(folder: &Path) -> Vec<Option<(Checkpoint, Vec<u8>)>> {
        let with_solution = |(checkpoint, stored): (Checkpoint, StoredSolution)| {
            let mut solution = Vec::new();
            (stored.open(folder).unwrap())
                .read_to_end(&mut solution)
                .unwrap();
            (checkpoint, solution)
        };
        let listed = Checkpoint::list(folder).into_iter();
        listed.map(|it| it.ok().map(with_solution)).collect()
    }

    fn parsed(bytes: &[u8]) -> Result<(Checkpoint, [u64; 2]), String> {
        Checkpoint::parse(bytes, bytes.len() as u64)
    }

    #[test]
    fn two_generations_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(read(folder.path()), []);
        for number in 0..4 {
            written(folder.path(), number, &solution(number));
            let expected = (number.saturating_sub(1)..=number).rev();
            let expected = expected.map(|it| Some((checkpoint(it), solution(it))));
            assert_eq!(read(folder.path()), expected.collect::<Vec<_>>());
        }
        Checkpoint::remove(folder.path()).unwrap();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    /// Every cut and every changed bit is detected, and the previous checkpoint is still readable.
    #[test]
    fn a_damaged_one_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        for number in [1, 2] {
            written(folder.path(), number, &[number; 300]);
        }
        let path = folder.path().join(NAMES[0]);
        let whole = fs::read(&path).unwrap();
        for end in 0..whole.len() {
            assert!(parsed(&whole[..end]).is_err(), "{end} bytes");
        }
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 1 << (place % 8);
            assert!(parsed(&changed).is_err(), "byte {place}");
        }
        let longer = [whole.as_slice(), b"more"].concat();
        assert!(parsed(&longer).is_err());
        fs::write(&path, &whole[..100]).unwrap();
        assert_eq!(
            read(folder.path()),
            [None, Some((checkpoint(1), vec![1; 300]))]
        );
    }

    #[test]
    fn another_format_is_named() {
        let folder = tempfile::tempdir().unwrap();
        written(folder.path(), 1, &[]);
        let mut bytes = fs::read(folder.path().join(NAMES[0])).unwrap();
        bytes[BEGINNING.len()] += 1;
        let reason = parsed(&bytes).unwrap_err();
        assert!(
            reason.contains(&format!("format {FORMAT}"))
                && reason.contains(&format!("format {}", FORMAT + 1)),
            "{reason}"
        );
        let reason = parsed(b"step,load_factor").unwrap_err();
        assert_eq!(reason, "it is no checkpoint of a run");
    }
}
