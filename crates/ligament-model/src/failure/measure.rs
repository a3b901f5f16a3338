//! Measures of the deformation of a bond.

use super::hooke::StressAcross;
use crate::element::BondDeformation;
use crate::tensor::norm;

const NO_DIRECTION: &str =
    "a measure of more than the relative motion of the ends has no worst direction";

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
    /// s + q |theta_rel|: stretch of the outermost fibre of a bond that bends, q = kappa/l (MPPD eq. 28).
    Fibre,
    /// |gamma|: sliding (MPPD eq. 50).
    Sliding,
    /// |gamma| + s q: sliding that compression makes harder, q = tan beta (MPPD eq. 58).
    Friction,
    /// sqrt(max(s, 0)^2 + q gamma^2), q = k_t/k_n: the stretch that would store the same energy. Compression stores none that
    /// counts.
    Energy,
    /// sqrt(s^2 + q gamma^2), q = k_t/k_n: the stretch that would store the same energy, of a bond that is pressed too.
    StoredEnergy,
    /// sigma_n/E': stress on the plane across the bond over the modulus E' ([`Moduli`](super::hooke::Moduli)).
    NormalStress,
    /// (|tau| + sigma_n tan(phi))/E': shear stress on the plane across the bond with what friction takes off it under pressure, after
    /// Mohr and Coulomb.
    CoulombStress,
    /// Opening S_n = S_xx and shear S_xy of a bond with strains of its own, a measure that reaches s_I where the bond breaks:
    ///
    /// sqrt((max(S_n, 0)^2 + q S_xy^2)/(1 + (r - 1) B^eta)), B = q S_xy^2/(max(S_n, 0)^2 + q S_xy^2).
    ///
    /// q = (s_I/gamma_I)^2 with the angle gamma_I at which sliding would take G_Ic, so that B is the share of mode II in what the
    /// bond releases (MBB-PD eq. C.1), G_II/G_T; and with r = G_IIc/G_Ic the bond breaks at G_T = G_Ic + (G_IIc - G_Ic) B^eta (eq. 21,
    /// after Benzeggagh and Kenane 1996). Where opening and sliding are as tough, r = 1, that is the sum of the squares. A bond that
    /// closes takes part in sliding alone.
    MixedModeX,
    /// Opening S_yy and shear S_xy of a bond with strains of its own, as along x.
    MixedModeY,
    /// Stretch S_xx of a bond along x, S_yy of one along y, and of others the critical stretch to which the angle belongs that they open by
    /// in mode I, phi sgn(tan(theta))/sin(theta), with phi = S_xy + S_xx cot(theta) + S_yy tan(theta) (MBB-PD eqs A.6, C.3).
    PrintedOpening,
    /// Stretch or angle in mode II: as in mode I, but of others abs(phi) (eq. C.6).
    PrintedSliding,
    /// Stretch or angle in both modes: as in mode I, but of others abs(phi)/(1 +- sin(theta)) (eqs 24, C.10), with the plus where phi has the sign
    /// that opening gives it.
    PrintedMixed,
}

/// Input of a measure.
#[derive(PartialEq)]
enum Sight {
    Stretch,
    Bending,
    Sliding,
    Energy,
    Stress,
    OwnStrains,
}

impl Measure {
    /// All measures.
    pub const ALL: [Self; 14] = [
        Self::Tension,
        Self::Compression,
        Self::Fibre,
        Self::Sliding,
        Self::Friction,
        Self::Energy,
        Self::MixedModeX,
        Self::MixedModeY,
        Self::PrintedOpening,
        Self::PrintedSliding,
        Self::PrintedMixed,
        Self::NormalStress,
        Self::CoulombStress,
        Self::StoredEnergy,
    ];

    /// The word for the measure in results.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tension => "tension",
            Self::Compression => "compression",
            Self::Fibre => "fibre",
            Self::Sliding => "sliding",
            Self::Friction => "friction",
            Self::Energy => "energy",
            Self::StoredEnergy => "stored-energy",
            Self::NormalStress => "normal-stress",
            Self::CoulombStress => "coulomb-stress",
            Self::MixedModeX => "mixed-mode-x",
            Self::MixedModeY => "mixed-mode-y",
            Self::PrintedOpening => "printed-opening",
            Self::PrintedSliding => "printed-sliding",
            Self::PrintedMixed => "printed-mixed",
        }
    }

    fn looks_at(self) -> Sight {
        match self {
            Self::Tension | Self::Compression => Sight::Stretch,
            Self::Fibre => Sight::Bending,
            Self::Sliding | Self::Friction => Sight::Sliding,
            Self::Energy | Self::StoredEnergy => Sight::Energy,
            Self::NormalStress | Self::CoulombStress => Sight::Stress,
            Self::MixedModeX
            | Self::MixedModeY
            | Self::PrintedOpening
            | Self::PrintedSliding
            | Self::PrintedMixed => Sight::OwnStrains,
        }
    }

    /// Whether the measure uses strains of an imaginary element instead of the relative motion of the ends.
    pub fn takes_strains(self) -> bool {
        self.looks_at() == Sight::OwnStrains
    }

    /// Whether the measure uses the stress around the bond, and not the relative motion of its ends alone.
    pub fn takes_stress(self) -> bool {
        self.looks_at() == Sight::Stress
    }

    /// Whether the measure uses the rotations of the points.
    pub fn takes_rotations(self) -> bool {
        self.looks_at() == Sight::Bending
    }

    /// Whether the measure uses the sliding of a bond between two points.
    pub fn takes_sliding(self) -> bool {
        self.needs_shear_stiffness() || self.looks_at() == Sight::Sliding
    }

    /// Whether the shear stiffness of a bond scales its sliding in the measure.
    pub fn needs_shear_stiffness(self) -> bool {
        self.looks_at() == Sight::Energy
    }

    /// Whether the limit is the stretch of a bond between two points that opens without sliding and bending.
    pub fn opens(self) -> bool {
        self.weakens() == Weakened::Opening && !self.takes_strains() && !self.takes_stress()
    }

    /// The measure in words: "stretch s".
    pub fn words(self) -> String {
        let words = format!("{} {}", self.noun(), self.formula());
        words.trim_start().to_owned()
    }

    /// The noun for the measure; empty where the formula is sufficient.
    fn noun(self) -> &'static str {
        match self {
            Self::Tension => "stretch",
            Self::Compression => "shortening",
            Self::Fibre => "fibre stretch",
            Self::Sliding => "sliding",
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => "stretch or angle",
            Self::NormalStress => "stress across the bond over E'",
            Self::CoulombStress => "stress of Mohr and Coulomb over E'",
            Self::Friction
            | Self::Energy
            | Self::StoredEnergy
            | Self::MixedModeX
            | Self::MixedModeY => "",
        }
    }

    /// The formula of the measure, in plain text.
    pub fn formula(self) -> &'static str {
        match self {
            Self::Tension => "s",
            Self::Compression => "-s",
            Self::Fibre => "s + |theta_rel| kappa/l",
            Self::Sliding => "|gamma|",
            Self::Friction => "|gamma| + s tan(beta)",
            Self::Energy => "sqrt(max(s, 0)^2 + gamma^2 k_t/k_n)",
            Self::StoredEnergy => "sqrt(s^2 + gamma^2 k_t/k_n)",
            Self::NormalStress => "sigma_n/E'",
            Self::CoulombStress => "(|tau| + sigma_n tan(phi))/E'",
            Self::MixedModeX => "sqrt(max(S_xx, 0)^2 + q S_xy^2)",
            Self::MixedModeY => "sqrt(max(S_yy, 0)^2 + q S_xy^2)",
            Self::PrintedOpening => "S_xx, S_yy or phi/sin(theta)",
            Self::PrintedSliding => "S_xx, S_yy or |phi|",
            Self::PrintedMixed => "S_xx, S_yy or |phi|/(1 +- sin(theta))",
        }
    }

    /// Names of the coefficients as they stand in the formula. For mixed modes all but the first may be left out.
    pub fn coefficient_names(self) -> &'static [&'static str] {
        match self {
            Self::Tension | Self::Compression | Self::Sliding => &[],
            Self::Fibre => &["kappa/l"],
            Self::Friction => &["tan(beta)"],
            Self::Energy | Self::StoredEnergy => &["k_t/k_n"],
            Self::NormalStress => &["lambda/E'", "2 mu/E'", "E/E'", "E'"],
            Self::CoulombStress => &["lambda/E'", "2 mu/E'", "E/E'", "E'", "tan(phi)"],
            Self::MixedModeX | Self::MixedModeY => &["q", "G_IIc/G_Ic", "eta"],
            Self::PrintedOpening | Self::PrintedSliding | Self::PrintedMixed => &["tan(theta)"],
        }
    }

    /// The value of the measure for a deformation, with the coefficients of the bond where the measure has some, and the stress across it
    /// where the measure [takes that](Self::takes_stress).
    #[inline]
    pub fn value(
        self,
        deformation: &BondDeformation,
        coefficients: &[f64],
        stress: impl FnOnce() -> StressAcross,
    ) -> f64 {
        let (stretch, shear) = (deformation.stretch(), deformation.shear());
        let strain = deformation.strain();
        let coefficient = || coefficients.first().copied().unwrap_or(0.0);
        match self {
            Self::Tension => stretch,
            Self::Compression => -stretch,
            Self::Fibre => stretch + coefficient() * deformation.rotation().abs(),
            Self::Sliding => shear.abs(),
            Self::Friction => shear.abs() + stretch * coefficient(),
            Self::StoredEnergy => {
                let square = stretch * stretch + coefficient() * shear * shear;
                square.max(0.0).sqrt()
            }
            Self::Energy => {
                let square = stretch.max(0.0).powi(2) + coefficient() * shear * shear;
                square.max(0.0).sqrt()
            }
            Self::NormalStress => stress().normal,
            Self::CoulombStress => {
                let slope = coefficients.last().copied().unwrap_or(0.0);
                let stress = stress();
                norm(stress.shear) + stress.normal * slope
            }
            Self::MixedModeX => mixed_mode(strain[0], strain[2], coefficients),
            Self::MixedModeY => mixed_mode(strain[1], strain[2], coefficients),
            Self::PrintedOpening => printed(strain, coefficient(), |angle, sine| angle / sine),
            Self::PrintedSliding => printed(strain, coefficient(), |angle, _| angle.abs()),
            Self::PrintedMixed => printed(strain, coefficient(), |angle, sine| {
                let turned_back = angle * strain[1] < 0.0;
                angle.abs() / if turned_back { 1.0 - sine } else { 1.0 + sine }
            }),
        }
    }

    /// What a criterion of this measure weakens.
    pub fn weakens(self) -> Weakened {
        match self {
            Self::Tension
            | Self::Fibre
            | Self::Energy
            | Self::NormalStress
            | Self::MixedModeX
            | Self::MixedModeY
            | Self::PrintedOpening
            | Self::PrintedSliding
            | Self::PrintedMixed => Weakened::Opening,
            Self::Compression => Weakened::Crushing,
            Self::StoredEnergy => Weakened::Whole,
            Self::Sliding | Self::Friction | Self::CoulombStress => Weakened::Sliding,
        }
    }

    /// Directions in which the measure with the coefficient q may be largest under a uniform strain, as cos 2x of the angle x to the
    /// axis of the larger principal stretch:
    ///
    /// | measure | worst direction x | measure there |
    /// |---|---|---|
    /// | tension, compression | a principal axis | max(s_1, s_2), -min(s_1, s_2) |
    /// | fibre | as tension: nothing bends | max(s_1, s_2) |
    /// | sliding | 45 degrees | abs(s_1 - s_2)/2 |
    /// | friction | cos 2x = +-sin(beta), q = tan(beta) | s_m q + s_d/cos(beta) |
    /// | energy | an axis, 45 degrees, where s = 0, or cos 2x = s_m/(s_d (q - 1)) | the largest of these |
    ///
    /// with the mean s_m = (s_1 + s_2)/2 and the deviator s_d = |s_1 - s_2|/2 (for friction MPPD Fig. 10). One direction alone stands
    /// five times; values that are not finite are no directions, and the first is always one.
    ///
    /// # Panics
    ///
    /// Panics for measures of imaginary strains, which are the strains of the body in all directions, and of the stress around a bond.
    pub fn worst_directions(self, coefficient: f64, mean: f64, deviator: f64) -> [f64; 5] {
        match self {
            Self::Tension | Self::Fibre => [1.0; 5],
            Self::Compression => [-1.0; 5],
            Self::Sliding => [0.0; 5],
            Self::Friction => [coefficient / (1.0 + coefficient * coefficient).sqrt(); 5],
            Self::Energy => [
                1.0,
                -1.0,
                0.0,
                -mean / deviator,
                mean / (deviator * (coefficient - 1.0)),
            ],
            Self::StoredEnergy
            | Self::NormalStress
            | Self::CoulombStress
            | Self::MixedModeX
            | Self::MixedModeY
            | Self::PrintedOpening
            | Self::PrintedSliding
            | Self::PrintedMixed => panic!("{NO_DIRECTION}"),
        }
    }

    /// Largest slope of the measure with the coefficient q over the orientation of a strain, per radian and unit of s_d: 2 for
    /// stretch and sliding, 2/cos(beta) for friction, 2 max(1, sqrt(q)) for the energy.
    ///
    /// # Panics
    ///
    /// Panics like [`Measure::worst_directions`].
    pub fn steepest_slope(self, coefficient: f64) -> f64 {
        2.0 * match self {
            Self::Tension | Self::Compression | Self::Fibre | Self::Sliding => 1.0,
            Self::Friction => (1.0 + coefficient * coefficient).sqrt(),
            Self::Energy => coefficient.max(1.0).sqrt(),
            Self::StoredEnergy
            | Self::NormalStress
            | Self::CoulombStress
            | Self::MixedModeX
            | Self::MixedModeY
            | Self::PrintedOpening
            | Self::PrintedSliding
            | Self::PrintedMixed => panic!("{NO_DIRECTION}"),
        }
    }
}

/// Printed measure of strains (S_xx, S_yy, S_xy) of a bond with the tangent of its angle theta: the strain along bonds of rows and columns,
/// and of others what is made of the angle phi, positive where the bond turns as opening turns it, and of sin(theta).
#[inline]
fn printed([xx, yy, xy]: [f64; 3], tangent: f64, of_angle: impl Fn(f64, f64) -> f64) -> f64 {
    if tangent == 0.0 {
        return xx;
    }
    if tangent.is_infinite() {
        return yy;
    }
    let angle = (xy + xx / tangent + yy * tangent) * tangent.signum();
    of_angle(angle, tangent.abs() / tangent.hypot(1.0))
}

/// Measure of the opening and the shear of a bond with strains of its own; `coefficients` are q, or q, r and eta.
#[inline]
fn mixed_mode(opening: f64, shear: f64, coefficients: &[f64]) -> f64 {
    let &[q, ref mixing @ ..] = coefficients else {
        return opening.max(0.0);
    };
    let opening = opening.max(0.0).powi(2);
    let sliding = q * shear * shear;
    let total = opening + sliding;
    match mixing {
        [ratio, exponent] if total > 0.0 => {
            let toughening = 1.0 + (ratio - 1.0) * (sliding / total).powf(*exponent);
            (total / toughening).sqrt()
        }
        _ => total.sqrt(),
    }
}

/// Resistance that a criterion weakens in a bond once its limit is passed and before it breaks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Weakened {
    /// Resistance to stretch, shear and rotation; not to shortening, because the faces of the crack touch.
    Opening,
    /// Resistance to shortening, shear and rotation.
    Crushing,
    /// Resistance to shear.
    Sliding,
    /// Resistance to every deformation, where shear under pressure crushes the material.
    Whole,
}

impl Weakened {
    /// Whether damage of this kind counts in the field of another one: loss of all resistance is a shear failure.
    pub fn shows_as(self, way: Self) -> bool {
        self == way || (self == Self::Whole && way == Self::Sliding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The deformation of a pair, or for measures that take strains the strains of an element with the same opening and shear
    /// and with S_yy = 0.3.
    fn deformation(measure: Measure, stretch: f64, shear: f64) -> BondDeformation {
        if measure.takes_strains() {
            BondDeformation::of_strain([stretch, 0.3, shear])
        } else {
            BondDeformation::new([stretch, shear, 0.3])
        }
    }

    #[test]
    fn values_by_hand() {
        let of = |stretch, shear| {
            let value = |it: &Measure| {
                it.value(
                    &deformation(*it, stretch, shear),
                    &[0.25],
                    StressAcross::default,
                )
            };
            let measures = Measure::ALL[..8].iter();
            measures.map(value).collect::<Vec<f64>>()
        };
        let along_y = |shear: f64| (0.3_f64.powi(2) + 0.25 * shear.powi(2)).sqrt();
        assert_eq!(
            of(3.0, -8.0),
            vec![3.0, -3.0, 3.075, 8.0, 8.75, 5.0, 5.0, along_y(8.0)]
        );
        assert_eq!(
            of(-4.0, 2.0),
            vec![-4.0, 4.0, -3.925, 2.0, 1.0, 1.0, 1.0, along_y(2.0)]
        );
    }

    /// Bonds along the axes look at their own strains. One at tan = 3/4, sin = 3/5, in the strains (0.3, 0.4, 0.1) turns by 0.1 + 0.3/(3/4) +
    /// 0.4 (3/4) = 0.8; its mirror image in mirrored strains does the same the other way round. A bond that closes is let off in mode I, and turned
    /// back by shear it breaks sooner in both modes (1 - 3/5).
    #[test]
    fn printed_measures_by_hand() {
        use Measure::{PrintedMixed, PrintedOpening, PrintedSliding};
        let of = |strain: [f64; 3], tangent: f64| {
            let deformation = BondDeformation::of_strain(strain);
            let value = |it: Measure| it.value(&deformation, &[tangent], StressAcross::default);
            [PrintedOpening, PrintedSliding, PrintedMixed].map(value)
        };
        let close = |found: [f64; 3], expected: [f64; 3]| {
            let mut both = found.iter().zip(&expected);
            assert!(
                both.all(|(one, other)| (one - other).abs() < 1e-15),
                "{found:?}"
            );
        };
        close(of([0.3, 0.4, 0.1], 0.0), [0.3; 3]);
        close(of([0.3, 0.4, 0.1], f64::NEG_INFINITY), [0.4; 3]);
        for side in [1.0, -1.0] {
            close(
                of([0.3, 0.4, side * 0.1], side * 0.75),
                [0.8 / 0.6, 0.8, 0.5],
            );
            close(of([0.0, -0.4, 0.0], side * 0.75), [-0.5, 0.3, 0.3 / 1.6]);
            close(
                of([0.0, 0.4, -side * 0.7], side * 0.75),
                [-0.4 / 0.6, 0.4, 0.4 / 0.4],
            );
        }
    }

    #[test]
    fn a_negative_shear_stiffness_never_gives_less_than_nothing() {
        let deformation = BondDeformation::new([1.0, 10.0, 0.3]);
        assert_eq!(
            Measure::Energy.value(&deformation, &[-0.5], StressAcross::default),
            0.0
        );
    }

    #[test]
    fn measures_grow_with_the_load() {
        for measure in Measure::ALL {
            let of_coulomb = [0.2, 0.8, 1.0, 9.0, 0.7];
            let stress = StressAcross {
                normal: 0.5,
                shear: [0.2, -0.3, 0.1],
            };
            for coefficients in [&[0.5] as &[f64], &[0.5, 3.0, 1.75], &of_coulomb] {
                let [once, twice] = [1.0, 2.0].map(|load| {
                    let deformation = deformation(measure, 0.3, -0.7).scaled(load);
                    measure.value(&deformation, coefficients, || stress.scaled(load))
                });
                assert!((twice - 2.0 * once).abs() < 1e-15, "{measure:?}");
            }
        }
    }

    /// In units of s_I, with gamma_I = 2 s_I, r = 4 and eta = 2, by hand: pure modes break at s_I and at 2 gamma_I; at B = 1/2 the
    /// toughness is 1 + 3/4, so that S_n^2 = 7/8; and a bond that closes slides only.
    #[test]
    fn mixed_modes_by_hand() {
        let coefficients = [0.25, 4.0, 2.0];
        let close = |value: f64| assert!((value - 1.0).abs() < 1e-15, "{value}");
        close(mixed_mode(1.0, 0.0, &coefficients));
        close(mixed_mode(0.0, -4.0, &coefficients));
        let half = (7.0_f64 / 8.0).sqrt();
        close(mixed_mode(half, 2.0 * half, &coefficients));
        close(mixed_mode(-5.0, 4.0, &coefficients));
        assert_eq!(mixed_mode(-5.0, 0.0, &coefficients), 0.0);
        close(mixed_mode(0.6, 1.6, &[0.25]));
        assert_eq!(
            mixed_mode(0.6, 1.6, &[0.25]),
            mixed_mode(0.6, 1.6, &[0.25, 1.0, 1.7])
        );
    }
}
