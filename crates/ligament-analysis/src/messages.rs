//! Values of any size that a process sends to others, as bytes in messages of bounded size.

use std::io::{self, Read};

use ligament_model::communicator::Communicator;

use crate::serial::{Damaged, Serial, Sink};

/// Largest number of bytes of a message.
pub const LONGEST: usize = 1 << 20;

/// Route of a value between processes.
#[derive(Debug, Clone, Copy)]
pub enum Way {
    /// From rank 0 to all ranks.
    ToAll,
    /// From one rank to another.
    Between {
        /// Rank that sends the value.
        from: usize,
        /// Rank that receives it.
        to: usize,
    },
}

/// The messages of a value, one at a time.
struct Messages<'a> {
    communicator: &'a dyn Communicator,
    way: Way,
    /// The message that is written or read.
    bytes: Vec<u8>,
    /// Number of its bytes that have been read.
    taken: usize,
}

impl<'a> Messages<'a> {
    fn new(communicator: &'a dyn Communicator, way: Way) -> Self {
        Self {
            communicator,
            way,
            bytes: Vec::new(),
            taken: 0,
        }
    }

    fn exchange(&mut self) {
        match self.way {
            Way::ToAll => self.communicator.broadcast(&mut self.bytes),
            Way::Between { from, to } => self.communicator.transfer(from, to, &mut self.bytes),
        }
    }
}

impl Sink for Messages<'_> {
    fn put(&mut self, mut bytes: &[u8]) {
        while !bytes.is_empty() {
            let room = LONGEST - self.bytes.len();
            let (first, rest) = bytes.split_at(room.min(bytes.len()));
            self.bytes.extend_from_slice(first);
            bytes = rest;
            if self.bytes.len() == LONGEST {
                self.exchange();
                self.bytes.clear();
            }
        }
    }
}

impl Read for Messages<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.taken == self.bytes.len() && !into.is_empty() {
            self.exchange();
            self.taken = 0;
        }
        let count = (&self.bytes[self.taken..]).read(into)?;
        self.taken += count;
        Ok(count)
    }
}

/// Sends the value that `write` writes.
pub fn send(communicator: &dyn Communicator, way: Way, write: impl FnOnce(&mut dyn Sink)) {
    let mut messages = Messages::new(communicator, way);
    write(&mut messages);
    if !messages.bytes.is_empty() {
        messages.exchange();
    }
}

/// Receives the value that `read` reads, the counterpart of [`send`].
///
/// # Errors
///
/// If the received bytes encode no such value.
pub fn receive<T>(
    communicator: &dyn Communicator,
    way: Way,
    read: impl FnOnce(&mut dyn Read) -> Result<T, Damaged>,
) -> Result<T, Damaged> {
    read(&mut Messages::new(communicator, way))
}

/// The value of rank 0 on all ranks; collective.
///
/// # Errors
///
/// If the received bytes encode no such value.
pub fn of_first<T: Serial>(communicator: &dyn Communicator, own: T) -> Result<T, Damaged> {
    if communicator.is_root() {
        send(communicator, Way::ToAll, |out| own.write(out));
        return Ok(own);
    }
    receive(communicator, Way::ToAll, T::read)
}
