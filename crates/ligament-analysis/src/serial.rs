//! Serialisation of values as bytes, bit for bit, for the checkpoints of a run.
//!
//! Numbers are little-endian. A list of floating-point numbers omits its zeros, and a list of booleans takes a bit each, so that
//! properties of few bonds take little space. Reading never takes more memory than a multiple of the available bytes. Values are written
//! to a [`Sink`] and read from a stream, so that a long list need not be in memory as bytes.

use std::io::Read;
use std::time::Duration;

use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::tensor::SymTensor;
use thiserror::Error;

/// Error of bytes that end too early or do not encode the value to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("it ends too early, or holds what no such file holds")]
pub struct Damaged;

/// Number of values of a long list that are written together. It is a multiple of 8, so that the marks of a part fill whole bytes.
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

    /// Appends the bytes of the values of a list, without their number: those of its slices of [`SLICE`] values one after the other.
    fn write_list(list: &[Self], out: &mut dyn Sink) {
        list.iter().for_each(|value| value.write(out));
    }

    /// Reads `count` values from the front of the bytes.
    ///
    /// # Errors
    ///
    /// If the bytes do not encode so many values.
    fn read_list(count: usize, from: &mut dyn Read) -> Result<Vec<Self>, Damaged> {
        // Memory is allocated as values are read, since the number itself may be damaged.
        let mut list = Vec::new();
        Self::read_each(count, from, |value| list.push(value))?;
        Ok(list)
    }

    /// Reads `count` values from the front of the bytes, and passes them to `each` one by one.
    ///
    /// # Errors
    ///
    /// If the bytes do not encode so many values.
    fn read_each(
        count: usize,
        from: &mut dyn Read,
        mut each: impl FnMut(Self),
    ) -> Result<(), Damaged> {
        for _ in 0..count {
            each(Self::read(from)?);
        }
        Ok(())
    }
}

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

/// Lengths of the slices of a list of `count` values.
fn slices(count: usize) -> impl Iterator<Item = usize> {
    let starts = (0..count).step_by(SLICE);
    starts.map(move |start| SLICE.min(count - start))
}

/// Bit of a byte sequence, by its index.
fn bit(bytes: &[u8], place: usize) -> bool {
    bytes[place / 8] >> (place % 8) & 1 == 1
}

/// Implements [`Serial`] for structures, field by field in the given order; all fields must be listed.
#[macro_export]
macro_rules! serial {
    ($($type:ident { $($field:ident),* $(,)? })*) => {$(
        impl $crate::serial::Serial for $type {
            fn write(&self, out: &mut dyn $crate::serial::Sink) {
                let Self { $($field),* } = self;
                $($crate::serial::Serial::write($field, out);)*
            }

            fn read(
                from: &mut dyn ::std::io::Read,
            ) -> Result<Self, $crate::serial::Damaged> {
                Ok(Self { $($field: $crate::serial::Serial::read(from)?),* })
            }
        }
    )*};
}

/// Implements [`Serial`] for numbers with little-endian bytes.
macro_rules! serial_numbers {
    ($($type:ty),*) => {$(
        impl Serial for $type {
            fn write(&self, out: &mut dyn Sink) {
                out.put(&self.to_le_bytes());
            }

            fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
                take_array(from).map(Self::from_le_bytes)
            }
        }
    )*};
}

serial_numbers!(i32, u32, u64, f32);
serial!(StiffnessFactors {
    axial,
    shear,
    rotational,
});

impl Serial for u8 {
    fn write(&self, out: &mut dyn Sink) {
        out.put(&[*self]);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        take_array(from).map(|[byte]| byte)
    }

    fn write_list(list: &[Self], out: &mut dyn Sink) {
        out.put(list);
    }

    fn read_list(count: usize, from: &mut dyn Read) -> Result<Vec<Self>, Damaged> {
        take(count, from)
    }
}

impl Serial for usize {
    fn write(&self, out: &mut dyn Sink) {
        (*self as u64).write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        u64::read(from)?.try_into().map_err(|_| Damaged)
    }
}

impl Serial for f64 {
    fn write(&self, out: &mut dyn Sink) {
        self.to_bits().write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        Ok(Self::from_bits(u64::read(from)?))
    }

    fn write_list(list: &[Self], out: &mut dyn Sink) {
        let is_kept = |value: &f64| value.to_bits() != 0;
        for slice in list.chunks(SLICE) {
            let kept: Vec<bool> = slice.iter().map(is_kept).collect();
            bool::write_list(&kept, out);
            let values = slice.iter().filter(|value| is_kept(value));
            values.for_each(|value| value.write(out));
        }
    }

    fn read_each(
        count: usize,
        from: &mut dyn Read,
        mut each: impl FnMut(Self),
    ) -> Result<(), Damaged> {
        for count in slices(count) {
            let kept = take(count.div_ceil(8), from)?;
            for place in 0..count {
                each(match bit(&kept, place) {
                    true => Self::read(from)?,
                    false => 0.0,
                });
            }
        }
        Ok(())
    }
}

impl Serial for bool {
    fn write(&self, out: &mut dyn Sink) {
        u8::from(*self).write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged),
        }
    }

    fn write_list(list: &[Self], out: &mut dyn Sink) {
        let byte = |eight: &[Self]| {
            let bits = eight.iter().enumerate();
            bits.fold(0, |byte, (place, &bit)| byte | u8::from(bit) << place)
        };
        let bytes: Vec<u8> = list.chunks(8).map(byte).collect();
        out.put(&bytes);
    }

    fn read_each(
        count: usize,
        from: &mut dyn Read,
        mut each: impl FnMut(Self),
    ) -> Result<(), Damaged> {
        for count in slices(count) {
            let bytes = take(count.div_ceil(8), from)?;
            (0..count).for_each(|place| each(bit(&bytes, place)));
        }
        Ok(())
    }
}

impl Serial for String {
    fn write(&self, out: &mut dyn Sink) {
        self.len().write(out);
        out.put(self.as_bytes());
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        Self::from_utf8(Serial::read(from)?).map_err(|_| Damaged)
    }
}

impl Serial for Duration {
    fn write(&self, out: &mut dyn Sink) {
        self.as_secs().write(out);
        self.subsec_nanos().write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let (seconds, nanoseconds): (u64, u32) = Serial::read(from)?;
        // Range of times that a program can take, so that sums of several do not overflow.
        if nanoseconds < 1_000_000_000 && seconds <= u64::from(u32::MAX) {
            Ok(Self::new(seconds, nanoseconds))
        } else {
            Err(Damaged)
        }
    }
}

impl Serial for BondDeformation {
    fn write(&self, out: &mut dyn Sink) {
        self.strains().write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        Ok(Self::new(Serial::read(from)?))
    }
}

impl<const D: usize> Serial for SymTensor<D> {
    fn write(&self, out: &mut dyn Sink) {
        self.components().for_each(|value| value.write(out));
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let components = Self::NAMES.iter().map(|_| f64::read(from));
        let components: Result<Vec<f64>, Damaged> = components.collect();
        Ok(Self::from_components(&components?))
    }
}

impl<T: Serial> Serial for Option<T> {
    fn write(&self, out: &mut dyn Sink) {
        self.is_some().write(out);
        if let Some(value) = self {
            value.write(out);
        }
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let is_some = bool::read(from)?;
        is_some.then(|| T::read(from)).transpose()
    }
}

/// Appends the bytes of a list, equal to those of a vector.
pub fn write_list<T: Serial>(list: &[T], out: &mut dyn Sink) {
    list.len().write(out);
    T::write_list(list, out);
}

impl<T: Serial> Serial for Vec<T> {
    fn write(&self, out: &mut dyn Sink) {
        write_list(self, out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let count = usize::read(from)?;
        T::read_list(count, from)
    }
}

impl<T: Serial, const N: usize> Serial for [T; N] {
    fn write(&self, out: &mut dyn Sink) {
        self.iter().for_each(|value| value.write(out));
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        let mut list = Vec::with_capacity(N);
        for _ in 0..N {
            list.push(T::read(from)?);
        }
        list.try_into().map_err(|_| Damaged)
    }
}

impl<A: Serial, B: Serial> Serial for (A, B) {
    fn write(&self, out: &mut dyn Sink) {
        self.0.write(out);
        self.1.write(out);
    }

    fn read(from: &mut dyn Read) -> Result<Self, Damaged> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

#[cfg(test)]
mod tests {
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

    /// A list longer than a slice has the bytes of its slices one after the other, of numbers and of marks.
    #[test]
    fn slices_of_a_list_make_the_list() {
        let numbers: Vec<f64> = (0..SLICE + 13).map(|it| (it % 3) as f64).collect();
        let marks: Vec<bool> = numbers.iter().map(|it| *it > 1.0).collect();
        assert_eq!(there_and_back(&numbers).1, numbers);
        assert_eq!(there_and_back(&marks).1, marks);
        let (mut whole, mut parts) = (Vec::new(), Vec::new());
        f64::write_list(&numbers, &mut whole);
        bool::write_list(&marks, &mut whole);
        (numbers.chunks(SLICE)).for_each(|it| f64::write_list(it, &mut parts));
        (marks.chunks(SLICE)).for_each(|it| bool::write_list(it, &mut parts));
        assert_eq!(whole, parts);
    }

    /// Eight bytes for their number, a bit for each, eight for the one that is not zero.
    #[test]
    fn zeros_cost_a_bit() {
        let mut numbers = vec![0.0; 800];
        numbers[17] = 3.0;
        assert_eq!(there_and_back(&numbers), (8 + 100 + 8, numbers.clone()));
    }

    /// A number of entries that no memory could hold, and every cut of good bytes.
    #[test]
    fn damaged_bytes_are_refused() {
        let huge = u64::MAX.to_le_bytes();
        assert_eq!(Vec::<f64>::read(&mut &huge[..]), Err(Damaged));
        assert_eq!(Vec::<bool>::read(&mut &huge[..]), Err(Damaged));
        assert_eq!(Vec::<Vec<u8>>::read(&mut &huge[..]), Err(Damaged));
        assert_eq!(String::read(&mut &huge[..]), Err(Damaged));
        let mut bytes = Vec::new();
        (vec![Some(1.0), None], vec![true; 11]).write(&mut bytes);
        for end in 0..bytes.len() {
            let cut = <(Vec<Option<f64>>, Vec<bool>)>::read(&mut &bytes[..end]);
            assert_eq!(cut, Err(Damaged), "{end} bytes");
        }
        assert_eq!(bool::read(&mut &[2][..]), Err(Damaged));
    }
}
