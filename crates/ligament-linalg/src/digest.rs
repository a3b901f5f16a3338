//! A hash of the bits of many values.

use rayon::prelude::*;

/// Number of values that one thread hashes.
const CHUNK: usize = 1 << 16;

/// Number of hashes of a chunk that are computed side by side, since each step of a hash waits for the step before.
const LANES: usize = 4;

/// The hash of no values.
const NONE: u64 = 0xcbf2_9ce4_8422_2325;

/// A hash of the bits of values, the same for any number of threads; different bits give the same hash with a probability of about 2^-64.
pub fn digest(values: &[f64]) -> u64 {
    let of_chunks: Vec<[u64; LANES]> = values.par_chunks(CHUNK).map(chunk_digest).collect();
    of_chunks.into_iter().flatten().fold(NONE, extended)
}

fn chunk_digest(values: &[f64]) -> [u64; LANES] {
    let mut digests = [NONE; LANES];
    for values in values.chunks(LANES) {
        for (digest, value) in digests.iter_mut().zip(values) {
            *digest = extended(*digest, value.to_bits());
        }
    }
    digests
}

/// Extends a hash of Fowler, Noll and Vo, taken over words instead of bytes, by one word; a rotation moves high bits down.
fn extended(digest: u64, word: u64) -> u64 {
    (digest.rotate_left(29) ^ word).wrapping_mul(0x0000_0100_0000_01b3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bit_anywhere_is_told() {
        let values: Vec<f64> = (0..CHUNK + 2 * LANES + 1).map(|it| it as f64).collect();
        let of_all = digest(&values);
        for place in [0, 1, LANES - 1, LANES, CHUNK - 1, CHUNK, values.len() - 1] {
            let mut others = values.clone();
            others[place] = f64::from_bits(others[place].to_bits() ^ 1);
            assert_ne!(digest(&others), of_all, "{place}");
        }
        assert_ne!(digest(&values[1..]), of_all);
    }

    #[test]
    fn two_values_that_change_places_are_told() {
        for distance in [1, LANES, CHUNK] {
            let values: Vec<f64> = (0..2 * CHUNK).map(|it| it as f64).collect();
            let mut others = values.clone();
            others.swap(3, 3 + distance);
            assert_ne!(digest(&others), digest(&values), "{distance}");
        }
    }
}
