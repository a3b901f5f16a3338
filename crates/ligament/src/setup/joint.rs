//! Interfaces between two materials with strengths of their own.

use ligament_model::case_type::Range;
use ligament_model::failure::{Choice, joint};
use ligament_model::{BondSystem, Material, case_type};

use super::check::{Checked, contradiction, in_range};
use super::{MaterialRegion, Setup};
use crate::error::{Fault, Field};

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
    fn strengths(&self, [one, other]: [&Material; 2]) -> Material {
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

/// A material with the strengths of another one.
fn with_strengths(material: &Material, of: &Material) -> Material {
    Material {
        name: material.name.clone(),
        elasticity: material.elasticity,
        density: material.density,
        expansion: material.expansion,
        ..of.clone()
    }
}

impl Setup {
    /// Indices of the materials on both sides of each interface, shape (n_interfaces, 2).
    pub fn joints(&self) -> Vec<[usize; 2]> {
        let interfaces = self.interfaces.iter();
        interfaces.filter_map(|it| self.joint(it)).collect()
    }

    fn joint(&self, interface: &Interface) -> Option<[usize; 2]> {
        let material = |name: &String| {
            let mut regions = self.materials.iter();
            regions.position(|it| it.material.name == *name || it.group.as_ref() == Some(name))
        };
        let [one, other] = interface.between.each_ref().map(material);
        Some([one?, other?])
    }

    /// The materials; of several then all of them with the strengths of each, and of each interface, shape (1 + n_materials + n_interfaces,
    /// n_materials).
    pub(crate) fn materials_with_joints(&self) -> Vec<Material> {
        let materials = self.materials();
        if materials.len() == 1 {
            return materials;
        }
        let joints = self.interfaces.iter().zip(self.joints());
        let joints = joints.map(|(it, sides)| it.strengths(sides.map(|side| &materials[side])));
        let rows: Vec<Material> = materials.iter().cloned().chain(joints).collect();
        let of_row = |row: &Material| -> Vec<Material> {
            let all = materials.iter();
            all.map(|it| with_strengths(it, row)).collect()
        };
        let of_rows = rows.iter().flat_map(of_row);
        materials.iter().cloned().chain(of_rows).collect()
    }

    /// Name of each interface, and whether each bond crosses it, shape (n_bonds).
    pub(crate) fn crossed_interfaces<const D: usize>(
        &self,
        BondSystem { cloud, bonds, .. }: &BondSystem<D>,
    ) -> Vec<(String, Vec<bool>)> {
        let of_interface = |(interface, between): (&Interface, [usize; 2])| {
            let all = 0..bonds.len();
            let crosses = all.map(|bond| joint::crosses(cloud, bonds, bond, between));
            (interface.name(), crosses.collect())
        };
        let interfaces = self.interfaces.iter().zip(self.joints());
        interfaces.map(of_interface).collect()
    }

    pub(super) fn check_interfaces(&self) -> Checked {
        for (index, interface) in self.interfaces.iter().enumerate() {
            let field = Field::element("interfaces", index);
            in_range(interface, |key| field.part(key))?;
            self.check_sides(field.part("between"), interface)?;
            self.check_effect(field, interface)?;
        }
        Ok(())
    }

    fn check_sides(&self, field: Field, interface: &Interface) -> Checked {
        let names = |it: &MaterialRegion| [Some(it.material.name.clone()), it.group.clone()];
        let candidates: Vec<String> = self.materials.iter().flat_map(names).flatten().collect();
        for name in &interface.between {
            if !candidates.contains(name) {
                return Err(field.error(Fault::UnknownName {
                    what: "material",
                    found: name.clone(),
                    candidates,
                }));
            }
        }
        match self.joint(interface) {
            Some([one, other]) if one == other => {
                let reason = "an interface lies between two materials, and both are this one: give each side a [material.NAME] of its own";
                contradiction(field, reason)
            }
            _ => Ok(()),
        }
    }

    /// Refuses an interface that changes no limit.
    fn check_effect(&self, field: Field, interface: &Interface) -> Checked {
        let is_given = |key: &str| {
            let mut properties = interface.properties().into_iter();
            properties.any(|(name, value)| name == key && value.is_some())
        };
        let uses = |it: &Choice| {
            let of_softening = it.parameter_from_energy().is_some() && is_given("fracture_energy");
            of_softening || it.takes().iter().any(|property| is_given(property.key))
        };
        if self.criteria.iter().any(uses) {
            return Ok(());
        }
        let reason = "no criterion takes a property that it has: give the strength or the fracture energy that the criteria take from the materials";
        contradiction(field, reason)
    }
}
