//! Values as bytes, bit for bit, for the checkpoints of a run and for messages between processes.
//!
//! Values are written in the format of `postcard`. A long list of points or bonds has a mark of one bit for each value, and then the values that
//! are not the usual one, so that properties of few bonds take little space; it is written and read in slices, so that it need not be in
//! memory as bytes. Reading never takes more memory than a multiple of the available bytes.

use std::io::Read;

use postcard::{de_flavors, ser_flavors};
use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

/// Error of bytes that end too early or do not encode the value to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("it ends too early, or holds what no such file holds")]
pub struct Damaged;

/// Number of values of a long list that are written together. It is a multiple of 8, so that the marks of a slice fill whole bytes.
pub const SLICE: usize = 1 << 18;

/// Receiver of bytes.
pub trait Sink {
    /// Appends some bytes.
    fn put(&mut self, bytes: &[u8]);
}

impl Sink for Vec<u8> {
    fn put(&mut self, bytes: &[u8]) {
        self.extend_from_slice(bytes);
    }
}

/// The sink of a process that takes part in writing and keeps no bytes.
impl Sink for () {
    fn put(&mut self, _: &[u8]) {}
}

/// A value that can be written as bytes and read back to the same bits.
pub trait Serial: Sized {
    /// Appends the bytes of the value.
    fn write(&self, out: &mut dyn Sink);

    /// Reads a value from the front of the bytes.
    ///
    /// # Errors
    ///
    /// If the bytes do not encode such a value.
    fn read(from: &mut dyn Read) -> Result<Self, Damaged>;
}

/// Appends the bytes of a value.
pub fn write<T: Serialize + ?Sized>(value: &T, out: &mut dyn Sink) {
    postcard::serialize_with_flavor(value, ToSink(out)).expect("a sink takes all values");
}

impl<T: Serialize + DeserializeOwned> Serial for T {
    fn write(&self, out: &mut dyn Sink) {
        write(self, out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let stream = FromStream {
            stream: from,
            bytes: Vec::new(),
        };
        let mut bytes = postcard::Deserializer::from_flavor(stream);
        T::deserialize(&mut bytes).map_err(|_| Damaged)
    }
}

/// Bytes of values on the way into a sink.
struct ToSink<'a>(&'a mut dyn Sink);

impl ser_flavors::Flavor for ToSink<'_> {
    type Output = ();

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.try_extend(&[byte])
    }

    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.0.put(bytes);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

/// Bytes of values from a stream; the bytes that were read together last are in memory.
struct FromStream<'a> {
    stream: &'a mut dyn Read,
    bytes: Vec<u8>,
}

impl<'de, 's: 'de> de_flavors::Flavor<'de> for FromStream<'s> {
    type Remainder = ();
    type Source = ();

    fn pop(&mut self) -> postcard::Result<u8> {
        let [byte] = take_array(self.stream).map_err(|_| END)?;
        Ok(byte)
    }

    /// Nothing is borrowed from a stream.
    fn try_take_n(&mut self, _: usize) -> postcard::Result<&'de [u8]> {
        Err(postcard::Error::WontImplement)
    }

    fn try_take_n_temp<'a>(&'a mut self, count: usize) -> postcard::Result<&'a [u8]>
    where
        'de: 'a,
    {
        self.bytes = take(count, self.stream).map_err(|_| END)?;
        Ok(&self.bytes)
    }

    fn finalize(self) -> postcard::Result<()> {
        Ok(())
    }
}

/// Error of a stream that ends too early.
const END: postcard::Error = postcard::Error::DeserializeUnexpectedEnd;

/// Takes `count` bytes from the front.
fn take(count: usize, from: &mut dyn Read) -> Result<Vec<u8>, Damaged> {
    // Memory is allocated as bytes are read, since the number itself may be damaged.
    let mut taken = Vec::new();
    let read = from.take(count as u64).read_to_end(&mut taken);
    read.ok().filter(|&read| read == count).ok_or(Damaged)?;
    Ok(taken)
}

/// Takes N bytes from the front.
fn take_array<const N: usize>(from: &mut dyn Read) -> Result<[u8; N], Damaged> {
    let mut taken = [0; N];
    from.read_exact(&mut taken).map_err(|_| Damaged)?;
    Ok(taken)
}

/// Requires that no bytes are left.
///
/// # Errors
///
/// If there are some.
pub fn require_end(from: &mut dyn Read) -> Result<(), Damaged> {
    match from.read(&mut [0]) {
        Ok(0) => Ok(()),
        _ => Err(Damaged),
    }
}

/// Appends the values of a long list, without their number, in slices of [`SLICE`] values one after the other. Values with the bytes
/// of `usual` take one bit.
pub fn write_values<T: Serial>(list: &[T], usual: &T, out: &mut dyn Sink) {
    let mut of_usual = Vec::new();
    usual.write(&mut of_usual);
    for slice in list.chunks(SLICE) {
        let mut marks = vec![0_u8; slice.len().div_ceil(8)];
        let mut values = Vec::new();
        for (place, value) in slice.iter().enumerate() {
            let begin = values.len();
            value.write(&mut values);
            if values[begin..] == of_usual {
                values.truncate(begin);
            } else {
                marks[place / 8] |= 1 << (place % 8);
            }
        }
        out.put(&marks);
        out.put(&values);
    }
}

/// Reads a list of `count` values with a usual value, as [`write_values`] wrote it, and passes them to `each` one by one.
///
/// # Errors
///
/// If the bytes do not encode so many values.
pub fn read_values<T: Serial + Clone>(
    count: usize,
    usual: &T,
    from: &mut dyn Read,
    mut each: impl FnMut(T),
) -> Result<(), Damaged> {
    for start in (0..count).step_by(SLICE) {
        let length = SLICE.min(count - start);
        let marks = take(length.div_ceil(8), from)?;
        for place in 0..length {
            let is_marked = marks[place / 8] >> (place % 8) & 1 == 1;
            each(match is_marked {
                true => T::read(from)?,
                false => usual.clone(),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use ligament_model::element::StiffnessFactors;

    use super::*;

    fn there_and_back<T: Serial>(value: &T) -> (usize, T) {
        let mut bytes = Vec::new();
        value.write(&mut bytes);
        let mut rest = bytes.as_slice();
        let read = T::read(&mut rest).expect("the bytes are whole");
        assert!(rest.is_empty(), "{} bytes are left", rest.len());
        (bytes.len(), read)
    }

    #[test]
    fn values_come_back_to_the_bit() {
        let numbers = vec![0.0, -0.0, 1.5, f64::INFINITY, 1e-310, 0.0, 0.0, 0.0, 2.0];
        let (_, read) = there_and_back(&numbers);
        let bits = |list: &[f64]| list.iter().map(|it| it.to_bits()).collect::<Vec<u64>>();
        assert_eq!(bits(&read), bits(&numbers));
        let nan = f64::from_bits(0x7ff8_0000_dead_beef);
        assert_eq!(there_and_back(&nan).1.to_bits(), nan.to_bits());
        for count in [0, 1, 7, 8, 9, 64, 65] {
            let list: Vec<bool> = (0..count).map(|place| place % 3 == 1).collect();
            assert_eq!(there_and_back(&list).1, list);
        }
        let mixed = (
            vec![Some("a name".to_owned()), None],
            [Duration::new(3, 7), Duration::ZERO],
        );
        assert_eq!(there_and_back(&mixed).1, mixed);
        let whole = vec![StiffnessFactors::WHOLE, StiffnessFactors::NOTHING];
        assert_eq!(there_and_back(&whole).1, whole);
    }

    fn values_there_and_back(list: &[f64]) -> (usize, Vec<f64>) {
        let mut bytes = Vec::new();
        write_values(list, &0.0, &mut bytes);
        let (mut rest, mut read) = (bytes.as_slice(), Vec::new());
        read_values(list.len(), &0.0, &mut rest, |it| read.push(it)).expect("the bytes are whole");
        assert!(rest.is_empty(), "{} bytes are left", rest.len());
        (bytes.len(), read)
    }

    /// A list longer than a slice has the bytes of its slices one after the other.
    #[test]
    fn slices_of_a_list_make_the_list() {
        let numbers: Vec<f64> = (0..SLICE + 13).map(|it| (it % 3) as f64).collect();
        assert_eq!(values_there_and_back(&numbers).1, numbers);
        let (mut whole, mut slices) = (Vec::new(), Vec::new());
        write_values(&numbers, &0.0, &mut whole);
        (numbers.chunks(SLICE)).for_each(|it| write_values(it, &0.0, &mut slices));
        assert_eq!(whole, slices);
    }

    /// A bit for each value, eight bytes for the two that are not zero to the bit.
    #[test]
    fn zeros_cost_a_bit() {
        let mut numbers = vec![0.0; 800];
        (numbers[17], numbers[18]) = (3.0, -0.0);
        let (n_bytes, read) = values_there_and_back(&numbers);
        assert_eq!((n_bytes, read[18].to_bits()), (100 + 16, 1 << 63));
        assert_eq!(read, numbers);
    }

    /// A number of entries that no memory could hold, and every cut of good bytes.
    #[test]
    fn damaged_bytes_are_refused() {
        let mut huge = Vec::new();
        u64::MAX.write(&mut huge);
        assert_eq!(Vec::<f64>::read(&mut huge.as_slice()), Err(Damaged));
        assert_eq!(Vec::<bool>::read(&mut huge.as_slice()), Err(Damaged));
        assert_eq!(Vec::<Vec<u8>>::read(&mut huge.as_slice()), Err(Damaged));
        assert_eq!(String::read(&mut huge.as_slice()), Err(Damaged));
        let count = usize::MAX >> 8;
        let values = read_values(count, &0.0, &mut huge.as_slice(), |_| {});
        assert_eq!(values, Err(Damaged));
        let mut bytes = Vec::new();
        (vec![Some(1.0), None], vec![true; 11]).write(&mut bytes);
        for end in 0..bytes.len() {
            let cut = <(Vec<Option<f64>>, Vec<bool>)>::read(&mut &bytes[..end]);
            assert_eq!(cut, Err(Damaged), "{end} bytes");
        }
        assert_eq!(bool::read(&mut &[2][..]), Err(Damaged));
    }
}
