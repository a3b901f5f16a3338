//! Serialisation of values as bytes, bit for bit, for the checkpoints of a run.
//!
//! Numbers are little-endian. A list of floating-point numbers omits its zeros, and a list of booleans takes a bit each, so that
//! properties of few bonds take little space. Reading never takes more memory than a multiple of the available bytes.

use std::time::Duration;

use ligament_model::element::{BondDeformation, StiffnessFactors};
use ligament_model::tensor::SymTensor;
use thiserror::Error;

/// Error of bytes that end too early or do not encode the value to be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("it ends too early, or holds what no such file holds")]
pub struct Damaged;

/// A value that can be written as bytes and read back to the same bits.
pub trait Serial: Sized {
    /// Appends the bytes of the value.
    fn write(&self, out: &mut Vec<u8>);

    /// Reads a value from the front of the bytes.
    ///
    /// # Errors
    ///
    /// If the bytes do not encode such a value.
    fn read(from: &mut &[u8]) -> Result<Self, Damaged>;

    /// Appends the bytes of the values of a list, without their number.
    fn write_list(list: &[Self], out: &mut Vec<u8>) {
        list.iter().for_each(|value| value.write(out));
    }

    /// Reads `count` values from the front of the bytes.
    ///
    /// # Errors
    ///
    /// If the bytes do not encode so many values.
    fn read_list(count: usize, from: &mut &[u8]) -> Result<Vec<Self>, Damaged> {
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
        from: &mut &[u8],
        mut each: impl FnMut(Self),
    ) -> Result<(), Damaged> {
        for _ in 0..count {
            each(Self::read(from)?);
        }
        Ok(())
    }
}

/// Takes `count` bytes from the front.
fn take<'a>(count: usize, from: &mut &'a [u8]) -> Result<&'a [u8], Damaged> {
    let (taken, rest) = from.split_at_checked(count).ok_or(Damaged)?;
    *from = rest;
    Ok(taken)
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
            fn write(&self, out: &mut Vec<u8>) {
                let Self { $($field),* } = self;
                $($crate::serial::Serial::write($field, out);)*
            }

            fn read(from: &mut &[u8]) -> Result<Self, $crate::serial::Damaged> {
                Ok(Self { $($field: $crate::serial::Serial::read(from)?),* })
            }
        }
    )*};
}

/// Implements [`Serial`] for numbers with little-endian bytes.
macro_rules! serial_numbers {
    ($($type:ty),*) => {$(
        impl Serial for $type {
            fn write(&self, out: &mut Vec<u8>) {
                out.extend(self.to_le_bytes());
            }

            fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
                let bytes = take(size_of::<Self>(), from)?;
                bytes.try_into().map(Self::from_le_bytes).map_err(|_| Damaged)
            }
        }
    )*};
}

serial_numbers!(u32, u64, f32);
serial!(StiffnessFactors {
    axial,
    shear,
    rotational,
});

impl Serial for u8 {
    fn write(&self, out: &mut Vec<u8>) {
        out.push(*self);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(take(1, from)?[0])
    }

    fn write_list(list: &[Self], out: &mut Vec<u8>) {
        out.extend(list);
    }

    fn read_list(count: usize, from: &mut &[u8]) -> Result<Vec<Self>, Damaged> {
        Ok(take(count, from)?.to_vec())
    }
}

impl Serial for usize {
    fn write(&self, out: &mut Vec<u8>) {
        (*self as u64).write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        u64::read(from)?.try_into().map_err(|_| Damaged)
    }
}

impl Serial for f64 {
    fn write(&self, out: &mut Vec<u8>) {
        self.to_bits().write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(Self::from_bits(u64::read(from)?))
    }

    fn write_list(list: &[Self], out: &mut Vec<u8>) {
        let is_kept = |value: &f64| value.to_bits() != 0;
        let kept: Vec<bool> = list.iter().map(is_kept).collect();
        bool::write_list(&kept, out);
        let values = list.iter().filter(|value| is_kept(value));
        values.for_each(|value| value.write(out));
    }

    fn read_list(count: usize, from: &mut &[u8]) -> Result<Vec<Self>, Damaged> {
        let mut list = Vec::with_capacity(count.min(8 * from.len()));
        Self::read_each(count, from, |value| list.push(value))?;
        Ok(list)
    }

    fn read_each(
        count: usize,
        from: &mut &[u8],
        mut each: impl FnMut(Self),
    ) -> Result<(), Damaged> {
        let kept = take(count.div_ceil(8), from)?;
        for place in 0..count {
            each(match bit(kept, place) {
                true => Self::read(from)?,
                false => 0.0,
            });
        }
        Ok(())
    }
}

impl Serial for bool {
    fn write(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Damaged),
        }
    }

    fn write_list(list: &[Self], out: &mut Vec<u8>) {
        let byte = |eight: &[Self]| {
            let bits = eight.iter().enumerate();
            bits.fold(0, |byte, (place, &bit)| byte | u8::from(bit) << place)
        };
        out.extend(list.chunks(8).map(byte));
    }

    fn read_list(count: usize, from: &mut &[u8]) -> Result<Vec<Self>, Damaged> {
        let bytes = take(count.div_ceil(8), from)?;
        Ok((0..count).map(|place| bit(bytes, place)).collect())
    }

    fn read_each(count: usize, from: &mut &[u8], each: impl FnMut(Self)) -> Result<(), Damaged> {
        let bytes = take(count.div_ceil(8), from)?;
        (0..count).map(|place| bit(bytes, place)).for_each(each);
        Ok(())
    }
}

impl Serial for String {
    fn write(&self, out: &mut Vec<u8>) {
        self.len().write(out);
        out.extend(self.as_bytes());
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Self::from_utf8(Serial::read(from)?).map_err(|_| Damaged)
    }
}

impl Serial for Duration {
    fn write(&self, out: &mut Vec<u8>) {
        self.as_secs().write(out);
        self.subsec_nanos().write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
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
    fn write(&self, out: &mut Vec<u8>) {
        self.strains().write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        Ok(Self::new(Serial::read(from)?))
    }
}

impl<const D: usize> Serial for SymTensor<D> {
    fn write(&self, out: &mut Vec<u8>) {
        self.components().for_each(|value| value.write(out));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let components = Self::NAMES.iter().map(|_| f64::read(from));
        let components: Result<Vec<f64>, Damaged> = components.collect();
        Ok(Self::from_components(&components?))
    }
}

impl<T: Serial> Serial for Option<T> {
    fn write(&self, out: &mut Vec<u8>) {
        self.is_some().write(out);
        if let Some(value) = self {
            value.write(out);
        }
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let is_some = bool::read(from)?;
        is_some.then(|| T::read(from)).transpose()
    }
}

/// Appends the bytes of a list, equal to those of a vector.
pub(crate) fn write_list<T: Serial>(list: &[T], out: &mut Vec<u8>) {
    list.len().write(out);
    T::write_list(list, out);
}

impl<T: Serial> Serial for Vec<T> {
    fn write(&self, out: &mut Vec<u8>) {
        write_list(self, out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let count = usize::read(from)?;
        T::read_list(count, from)
    }
}

impl<T: Serial, const N: usize> Serial for [T; N] {
    fn write(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|value| value.write(out));
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
        let mut list = Vec::with_capacity(N);
        for _ in 0..N {
            list.push(T::read(from)?);
        }
        list.try_into().map_err(|_| Damaged)
    }
}

impl<A: Serial, B: Serial> Serial for (A, B) {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.write(out);
        self.1.write(out);
    }

    fn read(from: &mut &[u8]) -> Result<Self, Damaged> {
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
