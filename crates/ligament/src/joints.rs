//! Joints between the materials of a setup: strengths of bonds across them, and the bonds that cross an interface.

use ligament_analysis::Message;
use ligament_model::failure::joint;
use ligament_model::subdomain::Subdomain;
use ligament_model::{BondSystem, ConstantFields, Material};

use crate::setup::{Interface, Setup};

impl Setup {
    /// Indices of the materials on both sides of each interface, shape (n_interfaces, 2).
    pub fn joints(&self) -> Vec<[usize; 2]> {
        let interfaces = self.interfaces.iter();
        interfaces.filter_map(|it| self.sides(it)).collect()
    }

    /// Indices of the materials on both sides of an interface; `None` where it names no material.
    pub(crate) fn sides(&self, interface: &Interface) -> Option<[usize; 2]> {
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

/// A message for each interface that no bond crosses, because the materials do not touch.
pub(crate) fn of_interfaces(fixed: &ConstantFields, subdomain: &Subdomain) -> Vec<Message> {
    let interfaces = fixed.interfaces.iter();
    let idle = interfaces
        .filter(|(_, crosses)| subdomain.count(crosses.iter().filter(|it| **it).count()) == 0);
    let message = |(name, _): &(String, Vec<bool>)| {
        let text = format!("no bond crosses the interface {name}: its materials do not touch");
        Message::new("interface-without-bonds", text)
            .with_advice("name two materials whose cells have nodes in common")
    };
    idle.map(message).collect()
}
