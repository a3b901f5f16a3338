//! Colours of the bands.

use colorous::{CIVIDIS, Color, GREYS, ORANGE_RED, RED_BLUE, VIRIDIS};
use ligament_output::results::fields::DAMAGE;

use crate::drawing::Rgb;

/// A map from the shares of a scale to colours that any colour vision can distinguish.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMap {
    /// Dark blue over green to yellow.
    Viridis,
    /// Dark blue over grey to yellow.
    Cividis,
    /// Light to dark grey.
    Grey,
    /// Nearly white over orange to dark red.
    Orange,
    /// Blue over white to red, with white at zero.
    Diverging,
}

impl ColourMap {
    /// All colour maps.
    pub const ALL: [Self; 5] = [
        Self::Viridis,
        Self::Cividis,
        Self::Grey,
        Self::Orange,
        Self::Diverging,
    ];

    /// The usual map of a field by its name, on which sound material is light; None where the map follows from the values.
    pub(super) fn default_for(field: &str) -> Option<Self> {
        field.starts_with(DAMAGE.name).then_some(Self::Orange)
    }

    /// The name of the map on the command line, and its colours in words.
    pub fn words(self) -> [&'static str; 2] {
        match self {
            Self::Viridis => ["viridis", "Dark blue over green to yellow"],
            Self::Cividis => ["cividis", "Dark blue over grey to yellow"],
            Self::Grey => ["grey", "Light to dark grey"],
            Self::Orange => ["orange", "Nearly white over orange to dark red"],
            Self::Diverging => ["diverging", "Blue over white to red, with white at zero"],
        }
    }

    /// The colour of a share from 0 to 1.
    pub(super) fn colour(self, share: f64) -> Rgb {
        let Color { r, g, b } = match self {
            Self::Viridis => VIRIDIS.eval_continuous(share),
            Self::Cividis => CIVIDIS.eval_continuous(share),
            // White would be mistaken for the outside of the body.
            Self::Grey => GREYS.eval_continuous(0.1 + 0.9 * share),
            Self::Orange => ORANGE_RED.eval_continuous(share),
            Self::Diverging => RED_BLUE.eval_continuous(1.0 - share),
        };
        [r, g, b]
    }

    /// Colours of `count` bands, from one end of the map to the other.
    pub(super) fn bands(self, count: usize) -> Vec<Rgb> {
        let share = |band: usize| match count {
            1 => 0.5,
            _ => band as f64 / (count - 1) as f64,
        };
        (0..count).map(|band| self.colour(share(band))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The published ends of viridis, and of ColorBrewer's RdBu, which splines through its colours meet to one in 255.
    #[test]
    fn the_ends_of_a_scale_have_the_colours_of_the_map() {
        let bands = ColourMap::Viridis.bands(9);
        assert_eq!(
            [bands[0], bands[8]],
            [[0x44, 0x01, 0x54], [0xfd, 0xe7, 0x25]]
        );
        let bands = ColourMap::Diverging.bands(4);
        for (found, published) in [
            (bands[0], [0x05, 0x30, 0x61]),
            (bands[3], [0x67, 0x00, 0x1f]),
        ] {
            let mut away = found.into_iter().zip::<Rgb>(published);
            assert!(away.all(|(a, b)| a.abs_diff(b) <= 1), "{found:?}");
        }
        assert_eq!(ColourMap::Cividis.bands(1).len(), 1);
    }

    #[test]
    fn the_middle_of_the_diverging_map_is_nearly_white() {
        let [r, g, b] = ColourMap::Diverging.colour(0.5);
        assert!(r.min(g).min(b) > 230 && r.abs_diff(b) < 8);
    }
}
