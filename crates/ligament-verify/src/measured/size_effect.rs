//! Bazant's size effect law through the peaks of similar bodies.
//!
//! sigma_N = P/(b D) with `1/sigma_N^2 = A D + C` (Bazant 1984); linear elastic fracture mechanics of large bodies gives the fracture energy
//! `G_f = g/(E A)` and the effective length of the fracture process zone `c_f = C g/(A g')` (Bazant and Kazemi 1990).

use super::curve::peak;
use super::reading::Reading;
use super::test::SizeEffect;

/// The law through a series.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Law {
    /// Name of the series.
    pub(super) series: String,
    /// Sizes, m, and nominal strengths, Pa.
    pub(super) strengths: Vec<[f64; 2]>,
    /// Slope A, 1/(Pa^2 m).
    slope: f64,
    /// Constant C, 1/Pa^2.
    constant: f64,
}

impl Law {
    /// The law of each series, in the order of their first runs.
    pub(super) fn from_series(theory: &SizeEffect, readings: &[Reading]) -> Vec<Self> {
        let mut series: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
        for reading in readings {
            let Some((name, size)) = &reading.in_series else {
                continue;
            };
            let strength = peak(&reading.curve)[1] / (theory.thickness * size);
            match series.iter_mut().find(|(other, _)| other == name) {
                Some((_, strengths)) => strengths.push([*size, strength]),
                None => series.push((name.clone(), vec![[*size, strength]])),
            }
        }
        let fit = |(series, strengths)| Self::fit(series, strengths);
        series.into_iter().map(fit).collect()
    }

    /// Law by least squares of 1/sigma_N^2 over D.
    fn fit(series: String, strengths: Vec<[f64; 2]>) -> Self {
        let n = strengths.len() as f64;
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            let terms = strengths.iter().map(|&[d, s]| of(d, 1.0 / (s * s)));
            terms.sum()
        };
        let (d, y) = (sum(&|d, _| d) / n, sum(&|_, y| y) / n);
        let slope = sum(&|it, value| (it - d) * (value - y)) / sum(&|it, _| (it - d) * (it - d));
        Self {
            series,
            strengths,
            slope,
            constant: y - slope * d,
        }
    }

    /// Nominal strength of a size, Pa.
    pub(super) fn strength(&self, size: f64) -> f64 {
        (self.slope * size + self.constant).sqrt().recip()
    }

    /// Fracture energy by the law over the given one.
    pub(super) fn energy_ratio(&self, theory: &SizeEffect) -> f64 {
        theory.g / (theory.young * self.slope) / theory.fracture_energy
    }

    /// Effective length of the fracture process zone by the law over the theoretical length.
    pub(super) fn length_ratio(&self, theory: &SizeEffect) -> f64 {
        self.constant * theory.g / (self.slope * theory.g_slope) / theory.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Strengths that follow the law are fitted to rounding, and give back G_f = 100 J/m^2 and c_f = 0.05 m.
    #[test]
    fn the_constants_of_a_law_come_back() {
        let theory = SizeEffect {
            g: 37.0,
            g_slope: 190.0,
            thickness: 0.1,
            young: 30e9,
            fracture_energy: 100.0,
            length: 0.05,
        };
        let strength = |d: f64| {
            (theory.young * theory.fracture_energy
                / (theory.g_slope * theory.length + theory.g * d))
                .sqrt()
        };
        let sizes = [0.05, 0.1, 0.2, 0.4];
        let law = Law::fit("h".to_owned(), sizes.map(|d| [d, strength(d)]).to_vec());
        assert!((law.energy_ratio(&theory) - 1.0).abs() < 1e-10);
        assert!((law.length_ratio(&theory) - 1.0).abs() < 1e-10);
        assert!((law.strength(0.3) / strength(0.3) - 1.0).abs() < 1e-12);
    }
}
