//! Table of the point fields in results: names, units, meanings, and their evaluation in a state of a run.
//!
//! Result files, arrays in Python, pictures, the page of results, the names of probe fields and the table in `docs/results.md`
//! follow from [`FIELDS`]. A new field is a function that computes it and a row here.

use ligament_model::failure::{Criteria, Weakened};
use ligament_model::interface::{StressReading, Stresses};
use ligament_model::stress::carried::StrainReading;
use ligament_model::stress::principal;
use ligament_model::tensor::SymTensor;
use ligament_model::{Bonds, ConstantFields};

use crate::balanced::Balanced;
use crate::fields;
use crate::history::{Rates, View};
use crate::load_program::LoadProgram;
use crate::material_stress::MaterialStress::{self, Carried, Effective};
use crate::state::State;
use crate::unknowns::{Component, Layout};
use FieldReading::{
    CrackSurface, EnergyRatios, MaterialOfCell, MaterialStress as ByMaterial, Model, Probed,
    ScatterFactors, State as InState, Stress,
};
use Interest::{Low, Main};

/// Point field in results.
#[derive(Debug)]
pub struct ResultField {
    /// Name in files, in Python and in probes; for a family of fields the part that their names share.
    pub name: &'static str,
    /// SI unit; `-` without one.
    pub unit: &'static str,
    /// Meaning in one sentence.
    pub meaning: &'static str,
    /// Components in the plane and in space.
    pub components: [Components; 2],
    /// Priority of the field on a page.
    pub interest: Interest,
    /// Method of evaluation.
    pub reading: FieldReading,
}

/// Components of a field at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Components {
    /// One integer.
    Integer,
    /// One number.
    Scalar,
    /// Values along x, y and z, or about these axes; in the plane the last is zero.
    Vector,
    /// Values with these names.
    Named(&'static [&'static str]),
}

/// Priority of a field on a page: smaller numbers come first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interest {
    /// Main field.
    Main(u8),
    /// Field that follows the others, in the order of the files.
    Low,
}

/// Method of evaluation of a field.
#[derive(Debug, Clone, Copy)]
pub enum FieldReading {
    /// Function of all points, from a state of a run; None where the run has no such field.
    State(fn(&View<'_>) -> Option<FieldValues>),
    /// Functions of all points, and of one point for probes, from a solution; None where the run has no such field.
    Probed(
        fn(Solution<'_>) -> Option<Vec<f64>>,
        fn(Solution<'_>, u32) -> f64,
    ),
    /// Stress from the forces of the bonds, if the user requests it.
    Stress(StressReading),
    /// Function of the components of a stress of a point by the law of its material, if the user requests it; the components that probes
    /// read, each with a name and a meaning.
    MaterialStress(
        MaterialStress,
        fn(&[f64]) -> Vec<f64>,
        &'static [[&'static str; 2]],
    ),
    /// Field of the model, which does not change; empty where the model has no such field.
    Model(for<'a> fn(ModelPoints<'a>) -> &'a [f64]),
    /// Number of the material of each cell, a field of cells in place of points; none where the body has one material.
    MaterialOfCell,
    /// Family of fields: ratios of the energies of uniform strains.
    EnergyRatios,
    /// Family of fields: factors of the property that varies at random.
    ScatterFactors,
    /// Jump of the displacement at the points of a crack surface.
    CrackSurface,
}

/// Values of a field, point by point.
#[derive(Debug, Clone, PartialEq)]
pub enum FieldValues {
    /// Numbers, shape (n_points, n_components).
    Numbers(Vec<f64>),
    /// Integers, shape (n_points).
    Integers(Vec<i64>),
}

/// Equilibrium state from which fields are evaluated.
#[derive(Clone, Copy)]
pub struct Solution<'a> {
    /// Bond system.
    pub system: &'a dyn Bonds,
    /// Failure criteria.
    pub criteria: &'a Criteria,
    /// State of the system.
    pub state: &'a State,
    /// Deformations and forces.
    pub balanced: &'a Balanced,
    /// Supports and loads.
    pub loads: &'a dyn LoadProgram,
    /// Velocities and accelerations of a motion; None in statics.
    pub motion: Option<Rates<'a>>,
}

/// Fields of a model that do not change in a run.
#[derive(Clone, Copy)]
pub struct ModelPoints<'a> {
    /// Fields from the preparation of the model.
    pub fixed: &'a ConstantFields,
    /// Volumes, shape (n_points), m^3.
    pub volumes: &'a [f64],
    /// Distances to the nearest point, shape (n_points), m.
    pub spacing: &'a [f64],
}

const INTEGER: [Components; 2] = [Components::Integer; 2];
const SCALAR: [Components; 2] = [Components::Scalar; 2];
const VECTOR: [Components; 2] = [Components::Vector; 2];
/// Rotation angle in the plane, or rotations about three axes in space.
const TURN: [Components; 2] = [Components::Scalar, Components::Vector];
/// Symmetric tensor in VTK's order, in the plane with zeros for the last two, so that tools for tensors find all six.
const TENSOR: Components = Components::Named(&["xx", "yy", "zz", "xy", "yz", "xz"]);
const SYMMETRIC: [Components; 2] = [TENSOR; 2];
/// Tensor by rows, VTK's order: direction of the force, then normal of the plane.
const TRACTION: [Components; 2] = [
    Components::Named(&["xx", "xy", "yx", "yy"]),
    Components::Named(&["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"]),
];
const STRAIN: [Components; 2] = [Components::Named(&["xx", "yy", "xy"]), TENSOR];
const PRINCIPAL: [Components; 2] = [
    Components::Named(&["1", "2"]),
    Components::Named(&["1", "2", "3"]),
];

/// Components of a field as probes read them: names and meanings.
macro_rules! probed {
    ($field:literal $meaning:literal: $($part:literal)+) => {
        &[$([concat!($field, ".", $part), concat!($meaning, " ", $part, ", Pa.")]),+]
    };
}

/// Rows of the table: constant, name, unit, components, interest, meaning, reading.
macro_rules! result_fields {
    ($($row:ident $name:literal [$unit:literal] $components:ident $interest:expr, $meaning:literal => $reading:expr;)+) => {
        $(
            #[doc = $meaning]
            pub const $row: ResultField = ResultField {
                name: $name,
                unit: $unit,
                meaning: $meaning,
                components: $components,
                interest: $interest,
                reading: $reading,
            };
        )+

        /// All fields in the order of the files.
        pub const FIELDS: &[&ResultField] = &[$(&$row),+];
    };
}

result_fields! {
    DISPLACEMENT "displacement" ["m"] VECTOR Main(0), "Displacement of the point."
        => InState(|view| numbers(displacements(view)));
    ROTATION "rotation" ["rad"] TURN Main(6),
        "Rotation of the point: in the plane counter-clockwise, in space about x, y and z, right-handed."
        => InState(|view| numbers(rotations(view.system.layout, &view.state.displacement)));
    VELOCITY "velocity" ["m/s"] VECTOR Main(7), "Velocity of the point, in a motion."
        => InState(|view| numbers(vectors(view.system.layout, view.motion?.velocity)));
    ACCELERATION "acceleration" ["m/s^2"] VECTOR Low, "Acceleration of the point, in a motion."
        => InState(|view| numbers(vectors(view.system.layout, view.motion?.acceleration)));
    DAMAGE "damage" ["-"] SCALAR Main(1), "Share of the point's bonds that are broken, weighted with volumes, 0 to 1."
        => Probed(|it| Some(fields::damage(it.system, &it.state.intact)), |it, point| fields::point_damage(it.system, &it.state.intact, point));
    STRAIN_ENERGY_DENSITY "strain_energy_density" ["J/m^3"] SCALAR Main(3),
        "Strain energy density, J/m^3: energy stored in the point's bonds, half of each."
        => Probed(|it| Some(energy_density(it)), point_energy_density);
    REACTION "reaction" ["N"] VECTOR Low, "Force of supports and loads on the point."
        => InState(|view| numbers(reactions(view)));
    FRAGMENT "fragment" ["-"] INTEGER Low, "Number of the part that the point belongs to."
        => InState(|view| Some(FieldValues::Integers(fragments(view))));
    HELD "held" ["-"] INTEGER Low, "1 where the program fixes a displacement of the point because its part is detached."
        => InState(|view| Some(FieldValues::Integers(held(view))));
    DAMAGE_TENSION "damage_tension" ["-"] SCALAR Main(1), "Damage by opening of bonds, d_t, 0 to 1."
        => Probed(|it| damage_by(it, Weakened::Opening), |it, point| point_damage_by(it, Weakened::Opening, point));
    DAMAGE_COMPRESSION "damage_compression" ["-"] SCALAR Main(1), "Damage by crushing of bonds, d_c."
        => Probed(|it| damage_by(it, Weakened::Crushing), |it, point| point_damage_by(it, Weakened::Crushing, point));
    DAMAGE_SLIDING "damage_sliding" ["-"] SCALAR Main(1), "Damage by sliding of bonds, d_gamma."
        => Probed(|it| damage_by(it, Weakened::Sliding), |it, point| point_damage_by(it, Weakened::Sliding, point));
    DISSIPATED_ENERGY_DENSITY "dissipated_energy_density" ["J/m^3"] SCALAR Main(4),
        "Energy that the point's bonds took for good, per volume."
        => InState(dissipated_energy_density);
    TEMPERATURE_CHANGE "temperature_change" ["K"] SCALAR Main(5), "Change of temperature, where there is one."
        => InState(|view| present(view.loads.temperature_change(view.state.load_factor)));
    THERMAL_STRAIN "thermal_strain" ["-"] STRAIN Low,
        "Strain that the temperature would make without stress, with engineering shears, where it changes."
        => InState(|view| present(thermal_strain(view)));
    STRESS "stress" ["Pa"] SYMMETRIC Main(2),
        "Stress that the material of the point carries, by its law and with what its bonds have left, if asked for."
        => ByMaterial(Carried, tensor, probed!("stress" "Stress that the material carries": "xx" "yy" "zz" "xy" "yz" "xz"));
    STRESS_PRINCIPAL "stress_principal" ["Pa"] PRINCIPAL Main(2), "Principal values of `stress`, the largest first."
        => ByMaterial(Carried, principal::values, probed!("stress_principal" "Principal value of that stress": "1" "2" "3"));
    STRESS_VON_MISES "stress_von_mises" ["Pa"] SCALAR Main(2), "Equivalent stress of von Mises of `stress`, where all of it is known."
        => ByMaterial(Carried, principal::von_mises, &[["stress_von_mises", "Equivalent stress of von Mises, Pa."]]);
    STRESS_TRESCA "stress_tresca" ["Pa"] SCALAR Main(2), "Equivalent stress of Tresca of `stress`, twice its largest shear, where all of it is known."
        => ByMaterial(Carried, principal::tresca, &[["stress_tresca", "Equivalent stress of Tresca, Pa."]]);
    STRESS_DIRECTION "stress_direction" ["-"] VECTOR Low, "Unit vector along the largest principal value of `stress`."
        => ByMaterial(Carried, principal::direction_of_largest, &[]);
    STRESS_EFFECTIVE "stress_effective" ["Pa"] SYMMETRIC Low,
        "Stress that the strain of the bonds which neither broke nor soften would have in sound material, if asked for."
        => ByMaterial(Effective, tensor, probed!("stress_effective" "Effective stress": "xx" "yy" "zz" "xy" "yz" "xz"));
    STRESS_EFFECTIVE_PRINCIPAL "stress_effective_principal" ["Pa"] PRINCIPAL Low,
        "Principal values of `stress_effective`, the largest first."
        => ByMaterial(Effective, principal::values, probed!("stress_effective_principal" "Principal value of the effective stress": "1" "2" "3"));
    STRESS_VIRIAL "stress_virial" ["Pa"] SYMMETRIC Main(2),
        "Symmetric part of the mean of the force dyads of the point's bonds, if asked for."
        => Stress(StressReading::Virial);
    STRESS_TRACTION "stress_traction" ["Pa"] TRACTION Main(2),
        "Force of the bonds through planes at the point, if asked for: direction of the force, then normal of the plane."
        => Stress(StressReading::Traction);
    VOLUME "volume" ["m^3"] SCALAR Low, "Volume of the point."
        => Model(|it| it.volumes);
    HORIZON "horizon" ["m"] SCALAR Low, "Horizon of the point."
        => Model(|it| &it.fixed.horizon);
    NEAREST_DISTANCE "nearest_distance" ["m"] SCALAR Low, "Distance to the nearest point."
        => Model(|it| it.spacing);
    PRECRACK_SHARE "precrack_share" ["-"] SCALAR Low, "Share of the point's bonds that pre-cracks cut."
        => Model(|it| &it.fixed.precrack_share);
    ENERGY_RATIO "energy_ratio_" ["-"] SCALAR Low,
        "Energy of a uniform strain over that of the continuum: `_x`, `_y`, `_biaxial` and `_shear` in the plane; `_x`, `_y`, `_z`, `_hydrostatic`, `_shear_xy`, `_shear_xz` and `_shear_yz` in space."
        => EnergyRatios;
    SCATTER_FACTOR "_factor" ["-"] SCALAR Low,
        "Factor of a property that varies at random: `strength_factor` or `fracture_energy_factor`."
        => ScatterFactors;
    MATERIAL "material" ["-"] INTEGER Low,
        "Number of the material of the cell in the order of the case, from 1, on the cells of a body with several materials."
        => MaterialOfCell;
    PATCH_RESIDUAL "patch_residual" ["-"] SCALAR Low,
        "Forces that the patch correction leaves at the point, over the size of their terms."
        => Model(|it| &it.fixed.patch_residual);
    OPENING "opening" ["m"] SCALAR Low, "Jump of the displacement along the normal of a crack surface, in `crack.vtu` of a solid."
        => CrackSurface;
    SLIDING "sliding" ["m"] SCALAR Low, "Jump of the displacement in a crack surface, in `crack.vtu` of a solid."
        => CrackSurface;
}

impl ResultField {
    /// Field with this name in results; None for fields of users or of other versions.
    pub fn named(name: &str) -> Option<&'static Self> {
        let is_it = |field: &&&Self| match field.reading {
            EnergyRatios => name.starts_with(field.name),
            ScatterFactors => name.ends_with(field.name),
            _ => name == field.name,
        };
        FIELDS.iter().find(is_it).copied()
    }

    /// Word of the stress in `output.stress` with which results have the field; None for fields that need none.
    pub fn requested_by(&self) -> Option<&'static str> {
        match self.reading {
            ByMaterial(Carried, ..) => Some("material"),
            ByMaterial(Effective, ..) => Some("effective"),
            Stress(StressReading::Virial) => Some("virial"),
            Stress(StressReading::Traction) => Some("traction"),
            _ => None,
        }
    }

    /// Components in the plane or in space.
    pub fn components(&self, in_space: bool) -> Components {
        self.components[usize::from(in_space)]
    }

    /// Values of the field in a state of a run; None where the run has no such field or the field does not depend on the state.
    pub fn values(&self, view: &View<'_>) -> Option<FieldValues> {
        match self.reading {
            InState(read) => read(view),
            Probed(read, _) => read(view.solution()).map(FieldValues::Numbers),
            Stress(reading) => {
                let components = self.components(view.system.layout.is_in_space());
                numbers(in_order(components.names(), &stresses(view, reading)))
            }
            ByMaterial(of, read, _) => {
                let count = self.components(view.system.layout.is_in_space()).count();
                numbers(material_stresses(view.solution(), of, read, count))
            }
            Model(_) | EnergyRatios | ScatterFactors | MaterialOfCell | CrackSurface => None,
        }
    }
}

/// SI unit of a field of the results, without its component; `-` for a number without a unit.
pub fn unit_of(field: &str) -> &'static str {
    ResultField::named(field).map_or("-", |it| it.unit)
}

impl Components {
    /// Number of values at a point.
    pub const fn count(self) -> usize {
        match self {
            Self::Integer | Self::Scalar => 1,
            Self::Vector => 3,
            Self::Named(names) => names.len(),
        }
    }

    /// Names of the components; empty where files have none.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Self::Integer | Self::Scalar | Self::Vector => &[],
            Self::Named(names) => names,
        }
    }
}

impl Interest {
    /// Rank of the field in the order of priority, from 0.
    pub fn rank(self) -> u8 {
        match self {
            Main(rank) => rank,
            Low => u8::MAX,
        }
    }
}

impl<'a> View<'a> {
    /// Equilibrium state of the view.
    pub fn solution(&self) -> Solution<'a> {
        Solution {
            system: self.system,
            criteria: self.criteria.criteria(),
            state: self.state,
            balanced: self.balanced,
            loads: self.loads,
            motion: self.motion,
        }
    }
}

impl Solution<'_> {
    /// Stresses at all points by the laws of their materials.
    pub fn material_stresses(self, of: MaterialStress) -> Stresses {
        let read = |reading: StrainReading<'_>| self.system.stresses_by_material(reading);
        of.with_strains(self.state, self.balanced, self.loads, read)
    }
}

impl<'a> ModelPoints<'a> {
    /// Names and values of all fields of the model, each of shape (n_points), in the order of the files.
    pub fn fields(self) -> Vec<(&'static str, &'a [f64])> {
        let fixed = self.fixed;
        let values = |field: &&'static ResultField| -> Vec<(&'static str, &'a [f64])> {
            match field.reading {
                Model(read) => vec![(field.name, read(self))],
                EnergyRatios => (fixed.energy_ratios.iter())
                    .map(|it| (it.field, &*it.at_points))
                    .collect(),
                ScatterFactors => (fixed.scatter.iter())
                    .map(|it| (it.of.field(), &*it.at_points))
                    .collect(),
                InState(_) | Probed(..) | Stress(_) | ByMaterial(..) | MaterialOfCell
                | CrackSurface => Vec::new(),
            }
        };
        let all = FIELDS.iter().flat_map(values);
        all.filter(|(_, values)| !values.is_empty()).collect()
    }
}

/// Displacements of the points, with a third component of zero in the plane, shape (n_points, 3), m; on a divided body only at
/// owned points and at the ends of their bonds.
pub fn displacements(view: &View<'_>) -> Vec<f64> {
    vectors(view.system.layout, &view.state.displacement)
}

/// Components x, y and z of values at all degrees of freedom, zero where points lack a component, shape (n_points, 3).
pub fn vectors(layout: Layout, of_all: &[f64]) -> Vec<f64> {
    components(layout, &[Component::X, Component::Y, Component::Z], of_all)
}

/// Rotations of the points from values at all degrees of freedom, rad: in the plane counter-clockwise, shape (n_points); in space
/// about the axes, right-handed, shape (n_points, 3); zero where points have no rotations.
pub fn rotations(layout: Layout, of_all: &[f64]) -> Vec<f64> {
    use Component::{Rotation, RotationX, RotationY, RotationZ};
    let turns: &[Component] = match layout.is_in_space() {
        true => &[RotationX, RotationY, RotationZ],
        false => &[Rotation],
    };
    components(layout, turns, of_all)
}

/// Values of some components at all points, zero where points lack them, shape (n_points, n_components).
fn components(layout: Layout, components: &[Component], of_all: &[f64]) -> Vec<f64> {
    let of_point = |point| (components.iter()).map(move |&it| layout.value(point, it, of_all));
    (0..layout.n_points as u32).flat_map(of_point).collect()
}

fn numbers(values: Vec<f64>) -> Option<FieldValues> {
    Some(FieldValues::Numbers(values))
}

/// Values as numbers; None where there are none.
fn present(values: Vec<f64>) -> Option<FieldValues> {
    (!values.is_empty()).then_some(FieldValues::Numbers(values))
}

fn reactions(view: &View<'_>) -> Vec<f64> {
    let internal = &view.balanced.internal.values;
    let reactions = view.loads.reactions(view.state.load_factor, internal);
    vectors(view.system.layout, &reactions)
}

fn fragments(view: &View<'_>) -> Vec<i64> {
    let (numbering, subdomain) = (&view.system.numbering, &view.system.subdomain);
    let first_in_file = |points: &Vec<u32>| {
        let numbers = points.iter().map(|&it| -f64::from(numbering.in_file(it)));
        numbers.fold(f64::NEG_INFINITY, f64::max)
    };
    // The part whose first point is the first one in the file has the number 0.
    let mut firsts: Vec<f64> = view.fragments.points.iter().map(first_in_file).collect();
    subdomain.all_reduce_max(&mut firsts);
    let mut in_order: Vec<usize> = (0..firsts.len()).collect();
    in_order.sort_unstable_by(|&one, &other| firsts[other].total_cmp(&firsts[one]));
    let mut numbers = vec![0; firsts.len()];
    for (number, fragment) in (0..).zip(in_order) {
        numbers[fragment] = number;
    }
    let of_point = view.fragments.of_point.iter();
    of_point.map(|&it| numbers[it as usize]).collect()
}

fn held(view: &View<'_>) -> Vec<i64> {
    let n_components = view.system.layout.components.len();
    let held = view.state.held.chunks(n_components);
    held.map(|held| i64::from(held.contains(&true))).collect()
}

fn energy_density(it: Solution<'_>) -> Vec<f64> {
    let (deformations, closed) = (&it.balanced.deformations, &it.balanced.closed);
    fields::strain_energy_density(it.system, it.state.bonds(), deformations, closed)
}

fn point_energy_density(it: Solution<'_>, point: u32) -> f64 {
    let (deformations, closed) = (&it.balanced.deformations, &it.balanced.closed);
    fields::point_energy_density(it.system, it.state.bonds(), deformations, closed, point)
}

/// Damage by one failure mode; None where no criterion has this mode.
fn damage_by(it: Solution<'_>, way: Weakened) -> Option<Vec<f64>> {
    let occurs = (it.criteria.list.iter()).any(|it| it.measure.weakens().shows_as(way));
    occurs.then(|| fields::damage_by(it.system, it.criteria, it.state, way))
}

fn point_damage_by(it: Solution<'_>, way: Weakened, point: u32) -> f64 {
    fields::point_damage_by(it.system, it.criteria, it.state, way, point)
}

fn dissipated_energy_density(view: &View<'_>) -> Option<FieldValues> {
    let densities = || fields::dissipated_energy_density(view.system, &view.state.dissipated);
    (!view.criteria.criteria().list.is_empty()).then(|| FieldValues::Numbers(densities()))
}

/// Stress-free strains due to the temperature, shape (n_points, n_components); empty where the temperature does not change.
fn thermal_strain(view: &View<'_>) -> Vec<f64> {
    let strain = view.loads.thermal_strain(view.state.load_factor);
    let components = THERMAL_STRAIN.components(view.system.layout.is_in_space());
    let of_points = (0..view.system.n_points()).filter(|_| !strain.is_none());
    let values =
        of_points.flat_map(|point| strain.of_point(point).engineering().collect::<Vec<_>>());
    let strains = Stresses {
        names: SymTensor::<3>::NAMES,
        values: values.collect(),
    };
    in_order(components.names(), &strains)
}

/// Stresses with their components in the order of other names, zero for names that the stresses do not have.
fn in_order(names: &[&str], of: &Stresses) -> Vec<f64> {
    let place = |name: &&str| of.names.iter().position(|it| it == name);
    let places: Vec<Option<usize>> = names.iter().map(place).collect();
    let of_points = of.values.chunks_exact(of.names.len());
    let in_order = |of_point: &[f64]| {
        let value = |place: &Option<usize>| place.map_or(0.0, |it| of_point[it]);
        places.iter().map(value).collect::<Vec<_>>()
    };
    of_points.flat_map(in_order).collect()
}

/// The components of a stress in the order of the files.
fn tensor(stress: &[f64]) -> Vec<f64> {
    let in_space = SymTensor::<3>::from_first_components(stress);
    let stress = Stresses {
        names: SymTensor::<3>::NAMES,
        values: in_space.components().collect(),
    };
    in_order(TENSOR.names(), &stress)
}

fn stresses(view: &View<'_>, reading: StressReading) -> Stresses {
    let (system, balanced) = (view.system, view.balanced);
    let mut stresses = system.stresses(reading, view.state.bonds(), &balanced.deformations);
    system.add_contact_stresses(reading, &balanced.closed, &mut stresses);
    stresses
}

/// Values at all points, `count` at each, of a function of their stresses by the laws of their materials; not a number where a point has
/// no stress.
fn material_stresses(
    it: Solution<'_>,
    of: MaterialStress,
    read: fn(&[f64]) -> Vec<f64>,
    count: usize,
) -> Vec<f64> {
    let stresses = it.material_stresses(of);
    let of_points = stresses.values.chunks_exact(stresses.names.len());
    let of_point = |stress: &[f64]| match stress[0].is_nan() {
        true => vec![f64::NAN; count],
        false => read(stress),
    };
    of_points.flat_map(of_point).collect()
}
