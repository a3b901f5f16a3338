//! Interfaces between two materials with strengths of their own.

use ligament_model::case_type::Range;
use ligament_model::{Material, case_type};

case_type! {
    /// An interface between two materials, whose bonds have strengths of their own. A property that is not given is the smaller one of both
    /// materials.
    #[derive(Debug, Clone, PartialEq, Default)]
    pub struct Interface {
        /// Names or groups of the two materials, `["a", "b"]`; points on the interface hold to the first.
        pub between: [String; 2],
        /// Tensile strength, Pa.
        #[range(Range::POSITIVE)]
        pub tensile_strength: Option<f64>,
        /// Compressive strength, Pa, positive.
        #[range(Range::POSITIVE)]
        pub compressive_strength: Option<f64>,
        /// Fracture energy of opening, J/m^2.
        #[range(Range::POSITIVE)]
        pub fracture_energy: Option<f64>,
        /// Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`.
        #[range(Range::POSITIVE)]
        pub fracture_energy_sliding: Option<f64>,
    }
}

impl Interface {
    /// Name in reports: those of both materials.
    pub fn name(&self) -> String {
        self.between.join("-")
    }

    /// Properties, with the keys of a material.
    pub fn properties(&self) -> [(&'static str, Option<f64>); 4] {
        [
            ("tensile_strength", self.tensile_strength),
            ("compressive_strength", self.compressive_strength),
            ("fracture_energy", self.fracture_energy),
            ("fracture_energy_sliding", self.fracture_energy_sliding),
        ]
    }

    /// The first of two materials with the strengths of the interface between them.
    pub(crate) fn strengths(&self, [one, other]: [&Material; 2]) -> Material {
        let property = |given: Option<f64>, of: fn(&Material) -> Option<f64>| {
            let smaller = match (of(one), of(other)) {
                (Some(one), Some(other)) => Some(one.min(other)),
                (known, None) | (None, known) => known,
            };
            given.or(smaller)
        };
        Material {
            tensile_strength: property(self.tensile_strength, |it| it.tensile_strength),
            compressive_strength: property(self.compressive_strength, |it| it.compressive_strength),
            fracture_energy: property(self.fracture_energy, |it| it.fracture_energy),
            fracture_energy_sliding: property(self.fracture_energy_sliding, |it| {
                it.fracture_energy_sliding
            }),
            ..one.clone()
        }
    }
}
