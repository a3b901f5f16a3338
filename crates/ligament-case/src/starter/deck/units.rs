//! Systems of units of input decks, which do not state one.

use super::super::text::{digits, exact};

/// A consistent system of units: sizes of its base units in SI units, from which all others follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Keyword of the system.
    pub name: &'static str,
    /// Unit of length, m.
    pub length: f64,
    /// Unit of force, N.
    pub force: f64,
    /// Unit of time, s.
    pub time: f64,
    /// Unit of temperature differences, K.
    pub temperature: f64,
}

/// Force of a pound, N.
const POUND: f64 = 4.448_221_615_260_5;

impl Units {
    /// SI units.
    pub const SI: Self = Self {
        name: "m-N-Pa",
        length: 1.0,
        force: 1.0,
        time: 1.0,
        temperature: 1.0,
    };
    /// All systems.
    pub const ALL: [Self; 4] = [
        Self::SI,
        Self {
            name: "mm-N-MPa",
            length: 1e-3,
            ..Self::SI
        },
        Self {
            name: "mm-kN-GPa",
            length: 1e-3,
            force: 1e3,
            time: 1e-3,
            ..Self::SI
        },
        Self {
            name: "in-lbf-psi",
            length: 0.0254,
            force: POUND,
            temperature: 5.0 / 9.0,
            ..Self::SI
        },
    ];

    pub(super) fn stress(&self) -> f64 {
        self.force / self.length.powi(2)
    }

    /// Unit of density, kg/m^3.
    pub(super) fn density(&self) -> f64 {
        self.stress() * (self.time / self.length).powi(2)
    }

    /// Unit of a quantity of supports and loads by its key in the case, in SI units.
    pub(super) fn for_key(&self, key: &str) -> f64 {
        match key {
            "displacement" => self.length,
            "velocity" => self.length / self.time,
            "acceleration" | "base_acceleration" => self.length / self.time.powi(2),
            "force" => self.force,
            "force_per_length" => self.force / self.length,
            "body_force" => self.stress() / self.length,
            _ => self.stress(),
        }
    }
}

/// Text of a number in SI units, without the rounding of a conversion.
pub(super) fn number(value: f64) -> String {
    exact(digits(value, 12))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steel in each system: 7850 kg/m^3 is 7.85e-9 t/mm^3 and 7.85e-6 kg/mm^3, and 0.000734 lbf s^2/in^4 by its weight of 0.2836 lbf/in^3.
    #[test]
    fn steel_has_the_same_density_in_all_systems() {
        let densities = [7850.0, 7.85e-9, 7.85e-6, 0.283_6 / 386.09];
        for (units, density) in Units::ALL.iter().zip(densities) {
            let error = density * units.density() / 7850.0 - 1.0;
            // Weight and gravity have four digits.
            assert!(error.abs() < 2e-4, "{}: {error}", units.name);
        }
        let stress = Units::ALL.map(|it| number(it.stress()));
        assert_eq!(stress, ["1.0", "1e6", "1e9", "6894.75729317"]);
    }
}
