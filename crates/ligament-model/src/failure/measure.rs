//! How a criterion looks at the deformation of a bond.

use super::mixed_mode;
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
    /// Of a bond with strains of its own: S_xx as opening, and S_xy ([`mixed_mode::measure`]).
    MixedModeX,
    /// The same with S_yy as opening.
    MixedModeY,
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
    pub const ALL: [Self; 7] = [
        Self::Tension,
        Self::Compression,
        Self::Sliding,
        Self::Friction,
        Self::Energy,
        Self::MixedModeX,
        Self::MixedModeY,
    ];

    /// The word for it in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tension => "tension",
            Self::Compression => "compression",
            Self::Sliding => "sliding",
            Self::Friction => "friction",
            Self::Energy => "energy",
            Self::MixedModeX => "mixed-mode-x",
            Self::MixedModeY => "mixed-mode-y",
        }
    }

    /// Whether it looks at strains of the bond's own, and not at the relative motion of its ends.
    pub fn takes_strains(self) -> bool {
        matches!(self, Self::MixedModeX | Self::MixedModeY)
    }

    /// The measure of a deformation, with the coefficients of the bond where the measure has some: q, and for those of
    /// strains what [`mixed_mode::measure`] takes.
    #[inline]
    pub fn of(self, deformation: &BondDeformation, coefficients: &[f64]) -> f64 {
        let BondDeformation { stretch, shear, .. } = *deformation;
        let coefficient = || coefficients.first().copied().unwrap_or(0.0);
        match self {
            Self::Tension => stretch,
            Self::Compression => -stretch,
            Self::Sliding => shear.abs(),
            Self::Friction => shear.abs() + stretch * coefficient(),
            Self::Energy => {
                let square = stretch.max(0.0).powi(2) + coefficient() * shear * shear;
                square.max(0.0).sqrt()
            }
            Self::MixedModeX => mixed_mode::measure(stretch, shear, coefficients),
            Self::MixedModeY => mixed_mode::measure(deformation.rotation, shear, coefficients),
        }
    }

    /// What a criterion of this measure weakens.
    pub fn weakens(self) -> Weakened {
        match self {
            Self::Tension | Self::Energy | Self::MixedModeX | Self::MixedModeY => Weakened::Opening,
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
        let of =
            |stretch, shear| Measure::ALL.map(|it| it.of(&deformation(stretch, shear), &[0.25]));
        let along_y = |shear: f64| (0.3_f64.powi(2) + 0.25 * shear.powi(2)).sqrt();
        assert_eq!(
            of(3.0, -8.0),
            [3.0, -3.0, 8.0, 8.75, 5.0, 5.0, along_y(8.0)]
        );
        assert_eq!(of(-4.0, 2.0), [-4.0, 4.0, 2.0, 1.0, 1.0, 1.0, along_y(2.0)]);
    }

    #[test]
    fn a_negative_shear_stiffness_never_gives_less_than_nothing() {
        assert_eq!(Measure::Energy.of(&deformation(1.0, 10.0), &[-0.5]), 0.0);
    }

    #[test]
    fn measures_grow_with_the_load() {
        for measure in Measure::ALL {
            for coefficients in [&[0.5] as &[f64], &[0.5, 3.0, 1.75]] {
                let [once, twice] = [1.0, 2.0].map(|load| {
                    let deformation = BondDeformation {
                        stretch: load * 0.3,
                        shear: load * -0.7,
                        rotation: load * 0.4,
                    };
                    measure.of(&deformation, coefficients)
                });
                assert!((twice - 2.0 * once).abs() < 1e-15, "{measure:?}");
            }
        }
    }
}
