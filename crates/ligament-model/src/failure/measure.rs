//! How a criterion looks at the deformation of a bond.

use crate::element::BondDeformation;

/// The equivalent deformation of a bond that a criterion compares with its limit.
///
/// All are homogeneous of degree one: under proportional loading each grows with the load factor, so that the load at which a
/// bond reaches its limit is known from one solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// s: stretch (MPPD eq. 45).
    Tension,
    /// -s: shortening (MPPD eq. 46).
    Compression,
    /// |gamma|: sliding (MPPD eq. 50).
    Sliding,
    /// |gamma| + s q: sliding that compression makes harder, q = tan beta (MPPD eq. 58).
    Friction,
    /// sqrt(max(s, 0)^2 + q gamma^2), q = k_t/k_n: the stretch that would store the same energy. Compression stores none that
    /// counts.
    Energy,
}

/// What a criterion weakens in a bond once its limit is passed and before it breaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weakened {
    /// Its resistance to stretch, shear and rotation; not that to shortening: the faces of the crack touch.
    Opening,
    /// Its resistance to shortening, shear and rotation.
    Crushing,
    /// Its resistance to shear.
    Sliding,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Tension,
        Self::Compression,
        Self::Sliding,
        Self::Friction,
        Self::Energy,
    ];

    /// The word for it in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tension => "tension",
            Self::Compression => "compression",
            Self::Sliding => "sliding",
            Self::Friction => "friction",
            Self::Energy => "energy",
        }
    }

    /// The measure of a deformation, with the coefficient q of the bond where the measure has one.
    #[inline]
    pub fn of(self, deformation: &BondDeformation, coefficient: f64) -> f64 {
        let BondDeformation { stretch, shear, .. } = *deformation;
        match self {
            Self::Tension => stretch,
            Self::Compression => -stretch,
            Self::Sliding => shear.abs(),
            Self::Friction => shear.abs() + stretch * coefficient,
            Self::Energy => {
                let square = stretch.max(0.0).powi(2) + coefficient * shear * shear;
                square.max(0.0).sqrt()
            }
        }
    }

    /// What a criterion of this measure weakens.
    pub fn weakens(self) -> Weakened {
        match self {
            Self::Tension | Self::Energy => Weakened::Opening,
            Self::Compression => Weakened::Crushing,
            Self::Sliding | Self::Friction => Weakened::Sliding,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn deformation(stretch: f64, shear: f64) -> BondDeformation {
        BondDeformation {
            stretch,
            shear,
            rotation: 0.3,
        }
    }

    #[test]
    fn values_by_hand() {
        let of = |stretch, shear| Measure::ALL.map(|it| it.of(&deformation(stretch, shear), 0.25));
        assert_eq!(of(3.0, -8.0), [3.0, -3.0, 8.0, 8.75, 5.0]);
        assert_eq!(of(-4.0, 2.0), [-4.0, 4.0, 2.0, 1.0, 1.0]);
    }

    #[test]
    fn a_negative_shear_stiffness_never_gives_less_than_nothing() {
        assert_eq!(Measure::Energy.of(&deformation(1.0, 10.0), -0.5), 0.0);
    }

    #[test]
    fn measures_grow_with_the_load() {
        for measure in Measure::ALL {
            let [once, twice] =
                [1.0, 2.0].map(|it| measure.of(&deformation(it * 0.3, it * -0.7), 0.5));
            assert!((twice - 2.0 * once).abs() < 1e-15, "{measure:?}");
        }
    }
}
