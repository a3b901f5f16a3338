//! The arrays of a VTU file as bytes, so that their numbers can be changed and not only the text that they are packed in.

use std::ops::Range;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use miniz_oxide::inflate::decompress_to_vec_zlib;

/// Places of the packed arrays in the text.
fn places(vtu: &[u8]) -> Vec<Range<usize>> {
    let text = std::str::from_utf8(vtu).unwrap();
    let tags = text.match_indices("<DataArray");
    let place = |(tag, _): (usize, &str)| {
        let start = tag + text[tag..].find('>').unwrap() + 1;
        let end = start + text[start..].find('<').unwrap();
        let inner = text[start..end].trim();
        let start = start + text[start..end].find(inner).unwrap();
        start..start + inner.len()
    };
    tags.map(place).collect()
}

/// The bytes of each array.
pub(crate) fn opened(vtu: &[u8]) -> Vec<Vec<u8>> {
    let open = |place: Range<usize>| {
        let text = &vtu[place];
        let first = BASE64_STANDARD.decode(&text[..32]).unwrap();
        let entry = |bytes: &[u8], number: usize| {
            u64::from_le_bytes(bytes[8 * number..][..8].try_into().unwrap()) as usize
        };
        let n_blocks = entry(&first, 0);
        let letters = (8 * (n_blocks + 3)).div_ceil(3) * 4;
        let header = BASE64_STANDARD.decode(&text[..letters]).unwrap();
        let packed = BASE64_STANDARD.decode(&text[letters..]).unwrap();
        let mut from = 0;
        let blocks = (0..n_blocks).flat_map(|block| {
            let to = from + entry(&header, 3 + block);
            let bytes = decompress_to_vec_zlib(&packed[from..to]).unwrap();
            from = to;
            bytes
        });
        blocks.collect()
    };
    places(vtu).into_iter().map(open).collect()
}

/// The file with other bytes in the place of an array, counted from 0; as it is where it has no such array.
pub(crate) fn exchanged(vtu: &[u8], number: usize, bytes: &[u8]) -> Vec<u8> {
    let Some(place) = places(vtu).get(number).cloned() else {
        return vtu.to_owned();
    };
    let packed = compress_to_vec_zlib(bytes, 1);
    let header = [1, bytes.len(), bytes.len(), packed.len()];
    let header = header.map(|entry| (entry as u64).to_le_bytes()).concat();
    let text = [header, packed]
        .map(|it| BASE64_STANDARD.encode(it))
        .concat();
    [&vtu[..place.start], text.as_bytes(), &vtu[place.end..]].concat()
}
