//! Fields on the points, over the cells of the mesh or the lattice.

use std::path::Path;

use ligament_analysis::fields;
use ligament_analysis::history::View;
use ligament_analysis::interface::{StressReading, Stresses};
use ligament_analysis::{Component, Layout};
use ligament_model::ghosts::Ghosts;
use ligament_model::subdomain::Subdomain;
use ligament_model::tensor::SymTensor;
use ligament_model::{BodyGrid, Canvas, FixedFields};

use super::grid::{fixed_fields, write_grid};
use super::rule::WriteRule;
use crate::Error;
use crate::vtu::Field;

/// Field of the strain (eps_xx, eps_yy, gamma_xy; in space eps_xx, eps_yy, eps_zz, gamma_xy, gamma_xz, gamma_yz) that the temperature would make without stress.
pub(super) const THERMAL_STRAIN: &str = "thermal_strain";

/// Names of the components of that strain in files.
pub(super) fn thermal_strain_names(in_space: bool) -> &'static [&'static str] {
    if in_space {
        &["xx", "yy", "zz", "xy", "xz", "yz"]
    } else {
        SymTensor::<2>::NAMES
    }
}

/// Place of a component among those of a strain in space.
pub(super) fn place_of(component: &str) -> Option<usize> {
    (SymTensor::<3>::NAMES.iter()).position(|name| *name == component)
}

/// Field of the rotations of the points.
const ROTATION: &str = "rotation";

/// Field of the energy that bonds took for good.
const DISSIPATED: &str = "dissipated_energy_density";

/// Writes the fields of a state.
pub(super) fn write(
    path: &Path,
    grid: &BodyGrid,
    fixed: &FixedFields,
    rule: WriteRule,
    view: &View<'_>,
) -> Result<(), Error> {
    let mut read = PointFields::read(rule, view);
    let mut displacements = displacements(view);
    let ghosts = corners(grid, view.system.subdomain());
    read.update_ghosts(&ghosts);
    ghosts.update(displacements.as_flattened_mut(), 3);
    let mut fields = read.motion.fields(&read.damage.share);
    fields.push(Field::integer(grid.tagged, &grid.tags));
    fields.extend(read.damage.fields());
    fields.extend(read.heat.fields());
    let of_stress = read.stresses.iter();
    fields.extend(of_stress.map(|(name, it)| Field::components(name, it.names, &it.values)));
    let system = view.system;
    fields.extend(fixed_fields(fixed, system.volumes(), system.spacing()));
    write_grid(
        path,
        grid,
        Some(&displacements),
        &fields,
        system.subdomain(),
    )
}

/// Fields on the points in a state of a run, as the files of fields have them.
pub struct PointFields {
    motion: Motion,
    damage: Damage,
    heat: Heat,
    stresses: Vec<(&'static str, Stresses)>,
}

/// Values of a field, one point after the other.
#[derive(Debug, Clone, PartialEq)]
pub enum FieldValues {
    /// Numbers, so many a point.
    Numbers(usize, Vec<f64>),
    /// An integer a point.
    Integers(Vec<i64>),
}

impl PointFields {
    /// Reads them from a state, with the stresses that the rule asks for; where processes share the body they are those of own points.
    pub fn read(rule: WriteRule, view: &View<'_>) -> Self {
        Self {
            motion: Motion::read(view),
            damage: Damage::read(view),
            heat: Heat::read(view),
            stresses: stresses(rule, view),
        }
    }

    /// Replaces the values at ghosts by those of their owners, which alone hold all bonds of a point.
    fn update_ghosts(&mut self, ghosts: &Ghosts) {
        let Damage {
            share,
            by_way,
            dissipated,
        } = &mut self.damage;
        let by_way = by_way.iter_mut().map(|(_, values)| values);
        let motion = &mut self.motion;
        match &mut motion.rotation {
            Rotations::InPlane(values) => ghosts.update(values, 1),
            Rotations::InSpace(values) => ghosts.update(values.as_flattened_mut(), 3),
        }
        ghosts.update(motion.reaction.as_flattened_mut(), 3);
        let of_points = [&mut motion.density, share];
        for values in of_points.into_iter().chain(by_way).chain(dissipated) {
            ghosts.update(values, 1);
        }
        for (_, stresses) in &mut self.stresses {
            ghosts.update(&mut stresses.values, stresses.names.len());
        }
    }

    /// Names and values of all fields but the displacement and those that never change.
    pub fn into_named(self) -> Vec<(&'static str, FieldValues)> {
        use FieldValues::{Integers, Numbers};
        let (motion, damage, heat) = (self.motion, self.damage, self.heat);
        let n_points = damage.share.len().max(1);
        let mut named = vec![
            (ROTATION, motion.rotation.into_values()),
            ("damage", Numbers(1, damage.share)),
            ("strain_energy_density", Numbers(1, motion.density)),
            ("reaction", Numbers(3, motion.reaction.into_flattened())),
            ("fragment", Integers(motion.fragment)),
            ("held", Integers(motion.held)),
        ];
        let by_way = damage.by_way.into_iter();
        named.extend(by_way.map(|(name, values)| (name, Numbers(1, values))));
        let dissipated = damage.dissipated.into_iter();
        named.extend(dissipated.map(|it| (DISSIPATED, Numbers(1, it))));
        let stresses = self.stresses.into_iter();
        let of_heat = [
            ("temperature_change", heat.change),
            (THERMAL_STRAIN, heat.strain),
        ];
        let others = of_heat
            .into_iter()
            .chain(stresses.map(|(name, it)| (name, it.values)));
        let others = others.filter(|(_, values)| !values.is_empty());
        named.extend(others.map(|(name, values)| (name, Numbers(values.len() / n_points, values))));
        named
    }
}

/// Motion of the points, what the bonds store and exert, and which parts are connected.
struct Motion {
    rotation: Rotations,
    density: Vec<f64>,
    reaction: Vec<[f64; 3]>,
    fragment: Vec<i64>,
    held: Vec<i64>,
}

impl Motion {
    fn read(view: &View<'_>) -> Self {
        let (state, balanced) = (view.state, view.balanced);
        let reactions = (view.loads).reactions(state.load_factor, &balanced.internal.values);
        let layout = view.system.layout();
        let numbering = view.system.numbering();
        let held = state.held.chunks(layout.components.len());
        Self {
            rotation: Rotations::read(layout, &state.displacement),
            density: fields::strain_energy_density(
                view.system,
                state.bonds(),
                &balanced.deformations,
                &balanced.closed,
            ),
            reaction: vectors(layout, &reactions),
            fragment: (numbering
                .parts_in_file(&view.fragments.of_point)
                .into_iter())
            .map(i64::from)
            .collect(),
            held: held.map(|held| i64::from(held.contains(&true))).collect(),
        }
    }

    fn fields<'a>(&'a self, damage: &'a [f64]) -> Vec<Field<'a>> {
        vec![
            self.rotation.field(),
            Field::scalar("damage", damage),
            Field::scalar("strain_energy_density", &self.density),
            Field::vector("reaction", &self.reaction),
            Field::integer("fragment", &self.fragment),
            Field::integer("held", &self.held),
        ]
    }
}

/// Rotations of the points, rad; zero where points do not turn.
pub(super) enum Rotations {
    /// In the plane, counter-clockwise, shape (n_points).
    InPlane(Vec<f64>),
    /// In space about the axes, right-handed, shape (n_points).
    InSpace(Vec<[f64; 3]>),
}

impl Rotations {
    /// Reads them from values of all degrees of freedom.
    pub(super) fn read(layout: Layout, of_all: &[f64]) -> Self {
        use Component::{Rotation, RotationX, RotationY, RotationZ};
        if layout.is_in_space() {
            return Self::InSpace(triples(layout, [RotationX, RotationY, RotationZ], of_all));
        }
        let of_point = |point| layout.value(point, Rotation, of_all);
        Self::InPlane((0..layout.n_points as u32).map(of_point).collect())
    }

    /// The field of a file.
    pub(super) fn field(&self) -> Field<'_> {
        match self {
            Self::InPlane(values) => Field::scalar(ROTATION, values),
            Self::InSpace(values) => Field::vector(ROTATION, values),
        }
    }

    fn into_values(self) -> FieldValues {
        match self {
            Self::InPlane(values) => FieldValues::Numbers(1, values),
            Self::InSpace(values) => FieldValues::Numbers(3, values.into_flattened()),
        }
    }
}

/// Broken shares of the bonds of the points, and what the bonds took for good.
struct Damage {
    share: Vec<f64>,
    by_way: Vec<(&'static str, Vec<f64>)>,
    dissipated: Option<Vec<f64>>,
}

impl Damage {
    fn read(view: &View<'_>) -> Self {
        let (system, criteria, state) = (view.system, view.criteria, view.state);
        Self {
            share: fields::damage(system, &state.intact),
            by_way: fields::damages(system, criteria, state),
            dissipated: (!criteria.list.is_empty())
                .then(|| fields::dissipated_energy_density(system, &state.dissipated)),
        }
    }

    fn fields(&self) -> impl Iterator<Item = Field<'_>> {
        let by_way = self.by_way.iter();
        let by_way = by_way.map(|(name, values)| Field::scalar(name, values));
        let dissipated = self.dissipated.iter();
        by_way.chain(dissipated.map(|values| Field::scalar(DISSIPATED, values)))
    }
}

/// Temperature and the strain that it would make without stress; empty where it does not change.
struct Heat {
    change: Vec<f64>,
    strain: Vec<f64>,
}

impl Heat {
    fn read(view: &View<'_>) -> Self {
        let load_factor = view.state.load_factor;
        let strain = view.loads.thermal_strain(load_factor);
        let of_points = (0..view.system.n_points()).filter(|_| !strain.is_none());
        let names = thermal_strain_names(view.system.layout().is_in_space());
        let of_point = |point: usize| {
            let strains: Vec<f64> = strain.of_point(point).engineering().collect();
            let places = names.iter().filter_map(|name| place_of(name));
            places.map(move |place| strains[place])
        };
        Self {
            change: view.loads.temperature_change(load_factor),
            strain: of_points.flat_map(of_point).collect(),
        }
    }

    fn fields(&self) -> Vec<Field<'_>> {
        let mut fields = Vec::new();
        if !self.change.is_empty() {
            fields.push(Field::scalar("temperature_change", &self.change));
        }
        if !self.strain.is_empty() {
            let in_space = self.strain.len() == 6 * self.change.len();
            let names = thermal_strain_names(in_space);
            fields.push(Field::components(THERMAL_STRAIN, names, &self.strain));
        }
        fields
    }
}

/// Stresses of the points, as far as they are wanted, with the names of their fields.
fn stresses(rule: WriteRule, view: &View<'_>) -> Vec<(&'static str, Stresses)> {
    let readings = [
        ("stress_virial", rule.virial, StressReading::Virial),
        ("stress_traction", rule.traction, StressReading::Traction),
    ];
    let wanted = readings.into_iter().filter(|(_, is_wanted, _)| *is_wanted);
    let stress = |reading| {
        let (left, deformations) = (view.state.bonds(), &view.balanced.deformations);
        let mut stresses = view.system.stresses(reading, left, deformations);
        let closed = &view.balanced.closed;
        (view.system).add_contact_stresses(reading, closed, &mut stresses);
        stresses
    };
    wanted
        .map(|(name, _, reading)| (name, stress(reading)))
        .collect()
}

/// Displacements of the points, with a third component of zero in the plane, shape (n_points), m; where processes share the body those of
/// own points and of ends of their bonds.
pub fn displacements(view: &View<'_>) -> Vec<[f64; 3]> {
    vectors(view.system.layout(), &view.state.displacement)
}

/// Ghosts at the corners of the cells that a process writes: the cells whose first corner it owns.
fn corners(grid: &BodyGrid, subdomain: &Subdomain) -> Ghosts {
    if subdomain.is_whole() {
        return Ghosts::new(subdomain, std::iter::empty());
    }
    let of_own = |corners: &[u32]| match subdomain.owns(corners[0]) {
        true => corners.to_vec(),
        false => Vec::new(),
    };
    let seen: Vec<u32> = match &grid.canvas {
        Canvas::Between(cells) => cells.iter().flat_map(|it| of_own(it.corners())).collect(),
        Canvas::Solid(cells) => cells.iter().flat_map(|it| of_own(it.corners())).collect(),
        Canvas::Around(_) | Canvas::Boxes(_) => Vec::new(),
    };
    Ghosts::new(subdomain, seen.into_iter())
}

/// The x, y and z components, of which those that points do not have are zero, shape (n_points).
pub(super) fn vectors(layout: Layout, of_all: &[f64]) -> Vec<[f64; 3]> {
    triples(layout, [Component::X, Component::Y, Component::Z], of_all)
}

/// Values of three components, zero where points do not have them, shape (n_points).
fn triples(layout: Layout, components: [Component; 3], of_all: &[f64]) -> Vec<[f64; 3]> {
    let of_point = |point| components.map(|it| layout.value(point, it, of_all));
    (0..layout.n_points as u32).map(of_point).collect()
}
