//! Animated GIF of pictures, with one palette for all of them, so that unchanged areas keep their colours.

use std::collections::HashMap;

use gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::png::{Pixels, PngError};

/// Largest number of colours of a palette.
const MOST_COLOURS: usize = 256;

/// Shortest duration of the last picture before the animation repeats, hundredths of a second.
const LAST: u16 = 200;

/// Reason why an animation cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum GifError {
    /// A picture cannot be drawn.
    #[error(transparent)]
    Drawing(#[from] PngError),
    /// The encoder failed.
    #[error("the GIF cannot be encoded: {0}")]
    Encoding(#[from] gif::EncodingError),
    /// The side of a picture has more dots than the format can count.
    #[error(
        "a picture of {0} x {1} dots is too large for a GIF; choose a smaller --width or --dpi"
    )]
    Size(u32, u32),
    /// There is no picture to show.
    #[error("an animation needs a picture")]
    Empty,
}

/// A GIF of pictures of one size, each shown for a number of hundredths of a second, that begins again at its end.
pub(crate) fn to_gif(pictures: &[Pixels], hundredths: u16) -> Result<Vec<u8>, GifError> {
    let [width, height] = pictures.first().ok_or(GifError::Empty)?.size;
    let [Ok(across), Ok(down)] = [width, height].map(u16::try_from) else {
        return Err(GifError::Size(width, height));
    };
    let palette = Palette::most_frequent_colours(pictures);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, across, down, palette.colours.as_flattened())?;
    encoder.set_repeat(Repeat::Infinite)?;
    let mut known = HashMap::new();
    let mut before: Option<Vec<u8>> = None;
    for (place, picture) in pictures.iter().enumerate() {
        let places = (picture.colours.iter()).map(|colour| palette.place(*colour, &mut known));
        let dots: Vec<u8> = places.collect();
        let [left, top, columns, rows] = changed_box(before.as_deref(), &dots, width as usize);
        let lines = (top..top + rows).flat_map(|row| {
            let start = row * width as usize + left;
            &dots[start..start + columns]
        });
        let is_last = place + 1 == pictures.len();
        let frame = Frame {
            delay: if is_last {
                hundredths.max(LAST)
            } else {
                hundredths
            },
            dispose: DisposalMethod::Keep,
            left: left as u16,
            top: top as u16,
            width: columns as u16,
            height: rows as u16,
            buffer: lines.copied().collect::<Vec<u8>>().into(),
            ..Frame::default()
        };
        encoder.write_frame(&frame)?;
        before = Some(dots);
    }
    drop(encoder);
    Ok(bytes)
}

/// The box (left, top, columns, rows) of the dots that differ from the picture before; a single dot where none differs.
fn changed_box(before: Option<&[u8]>, dots: &[u8], width: usize) -> [usize; 4] {
    let Some(before) = before else {
        return [0, 0, width, dots.len() / width];
    };
    let differing = (0..dots.len()).filter(|&it| before[it] != dots[it]);
    let corners = differing.fold(None, |found: Option<[usize; 4]>, it| {
        let (x, y) = (it % width, it / width);
        let [left, top, right, bottom] = found.unwrap_or([x, y, x, y]);
        Some([left.min(x), top.min(y), right.max(x), bottom.max(y)])
    });
    corners.map_or([0, 0, 1, 1], |[left, top, right, bottom]| {
        [left, top, right - left + 1, bottom - top + 1]
    })
}

/// The colours of an animation.
struct Palette {
    colours: Vec<[u8; 3]>,
}

impl Palette {
    /// The most frequent colours of all pictures, of equally frequent colours the darker ones first. Areas keep their exact colours; the
    /// colours that are left out are blends at their rims.
    fn most_frequent_colours(pictures: &[Pixels]) -> Self {
        let mut dots: HashMap<[u8; 3], usize> = HashMap::new();
        for colour in pictures.iter().flat_map(|picture| &picture.colours) {
            *dots.entry(*colour).or_default() += 1;
        }
        let mut ordered: Vec<([u8; 3], usize)> = dots.into_iter().collect();
        ordered.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
        ordered.truncate(MOST_COLOURS);
        Self {
            colours: ordered.into_iter().map(|it| it.0).collect(),
        }
    }

    /// Index of the nearest colour, the first of several.
    fn place(&self, colour: [u8; 3], known: &mut HashMap<[u8; 3], u8>) -> u8 {
        let away = |other: &[u8; 3]| {
            let parts = (0..3).map(|it| i32::from(other[it]) - i32::from(colour[it]));
            parts.map(|it| it * it).sum::<i32>()
        };
        *known.entry(colour).or_insert_with(|| {
            let nearest = (self.colours.iter().enumerate()).min_by_key(|(_, other)| away(other));
            nearest.map_or(0, |(place, _)| place as u8)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHITE: [u8; 3] = [255; 3];
    const RED: [u8; 3] = [200, 10, 10];

    fn picture(red: &[usize]) -> Pixels {
        let mut colours = vec![WHITE; 12];
        for &place in red {
            colours[place] = RED;
        }
        Pixels {
            size: [4, 3],
            colours,
        }
    }

    /// The complete pictures of an animation with their delays.
    fn decoded(bytes: &[u8]) -> Vec<(u16, Vec<[u8; 3]>)> {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::Indexed);
        let mut decoder = options.read_info(bytes).unwrap();
        let palette: Vec<[u8; 3]> = decoder
            .global_palette()
            .unwrap()
            .as_chunks::<3>()
            .0
            .to_vec();
        let mut canvas = vec![[0; 3]; 12];
        let mut found = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            for (place, &dot) in frame.buffer.iter().enumerate() {
                let columns = usize::from(frame.width);
                let x = usize::from(frame.left) + place % columns;
                let y = usize::from(frame.top) + place / columns;
                canvas[4 * y + x] = palette[usize::from(dot)];
            }
            found.push((frame.delay, canvas.clone()));
        }
        found
    }

    #[test]
    fn pictures_come_back_with_their_colours_and_times() {
        let pictures = [
            picture(&[]),
            picture(&[5, 6]),
            picture(&[5, 6]),
            picture(&[0, 11]),
        ];
        let bytes = to_gif(&pictures, 10).unwrap();
        assert!(bytes.starts_with(b"GIF89a"));
        let shown = decoded(&bytes);
        let times: Vec<u16> = shown.iter().map(|it| it.0).collect();
        assert_eq!(times, [10, 10, 10, LAST]);
        for (picture, (_, dots)) in pictures.iter().zip(&shown) {
            assert_eq!(&picture.colours, dots);
        }
        assert_eq!(to_gif(&pictures, 10).unwrap(), bytes);
    }

    /// Of 300 greys the 256 most frequent stay, and each other one is replaced by the nearest.
    #[test]
    fn the_most_frequent_colours_stay() {
        let greys: Vec<[u8; 3]> = (0..300)
            .map(|it| [(it % 256) as u8, (it / 256) as u8, 0])
            .collect();
        let often = [[9, 9, 9]; 5];
        let picture = Pixels {
            size: [305, 1],
            colours: [&greys[..], &often].concat(),
        };
        let palette = Palette::most_frequent_colours(std::slice::from_ref(&picture));
        assert_eq!(
            (palette.colours.len(), palette.colours[0]),
            (256, [9, 9, 9])
        );
        let place = palette.place([9, 9, 10], &mut HashMap::new());
        assert_eq!(place, 0);
    }

    #[test]
    fn changes_are_boxed() {
        let (before, after) = ([0; 12], [0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0]);
        assert_eq!(changed_box(Some(&before), &after, 4), [1, 1, 2, 2]);
        assert_eq!(changed_box(Some(&before), &before, 4), [0, 0, 1, 1]);
        assert_eq!(changed_box(None, &after, 4), [0, 0, 4, 3]);
        assert!(matches!(to_gif(&[], 10), Err(GifError::Empty)));
    }
}
