//! Random specimens: a rectangle held on its left and loaded on its right.

use std::collections::BTreeMap;

use ligament::prelude::*;
use ligament_mesh::{Cell, Group};
use ligament_model::material::OutOfPlane;
use ligament_model::{ElementKind, Expansion, Orthotropic};
use verification::meshes;
use verification::numbers::Random;

use super::image::Image;

/// A rectangle in cells, with what it is made of and what acts on it.
#[derive(Debug, Clone)]
pub(crate) struct Specimen {
    pub(crate) law: Law,
    plane: Plane,
    /// Columns and rows of cells.
    cells: [u32; 2],
    /// Nodes of a mesh; none for a lattice.
    mesh: Option<Mesh>,
    /// Mean size of a cell, m.
    pub(crate) spacing: f64,
    horizon: Horizon,
    thickness: f64,
    pub(crate) young: f64,
    poisson: f64,
    /// Angle of the first axis of an orthotropic material.
    angle: f64,
    /// A strain that the loads come to, and at which bonds fail.
    pub(crate) strain: f64,
    /// Vertices of a pre-crack, m.
    precrack: Vec<[f64; 2]>,
    /// Direction of what acts on the right side.
    direction: [f64; 2],
    /// Whether the right side is pulled by a force, not moved.
    pub(crate) by_force: bool,
}

/// A number in a range.
pub(crate) fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + 0.5 * (random.uniform() + 1.0) * (high - low)
}

/// A number whose logarithm is anywhere between those of two.
fn decade(random: &mut Random, low: f64, high: f64) -> f64 {
    between(random, low.ln(), high.ln()).exp()
}

fn chance(random: &mut Random) -> bool {
    random.uniform() < 0.0
}

/// The names of the sides and their outward normals.
const SIDES: [(&str, [f64; 2]); 4] = [
    ("left", [-1.0, 0.0]),
    ("right", [1.0, 0.0]),
    ("bottom", [0.0, -1.0]),
    ("top", [0.0, 1.0]),
];

/// A rectangle of triangles: nodes of a grid moved by up to a fifth of its spacing, those of a side along it, and either diagonal
/// in each cell.
pub(crate) fn jittered(random: &mut Random, [columns, rows]: [u32; 2], spacing: f64) -> Mesh {
    let node = |i: u32, j: u32| j * (columns + 1) + i;
    let mut positions = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let [u, v] = [0.2 * random.uniform(), 0.2 * random.uniform()];
            let inside = |at: u32, last: u32, by: f64| {
                let moved = if at == 0 || at == last { 0.0 } else { by };
                spacing * (f64::from(at) + moved)
            };
            positions.push([inside(i, columns, u), inside(j, rows, v)]);
        }
    }
    let mut cells = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ];
            let halves = if chance(random) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            };
            cells.extend(halves.map(Cell::Triangle));
        }
    }
    let of_side = |number: usize| -> Vec<u32> {
        match number {
            0 => (0..=rows).map(|j| node(0, j)).collect(),
            1 => (0..=rows).map(|j| node(columns, j)).collect(),
            2 => (0..=columns).map(|i| node(i, 0)).collect(),
            _ => (0..=columns).map(|i| node(i, rows)).collect(),
        }
    };
    let group = |(number, (name, _)): (usize, &(&str, [f64; 2]))| {
        let nodes = of_side(number);
        Group {
            name: (*name).to_owned(),
            dimension: 1,
            number: number as i32 + 1,
            edges: nodes.windows(2).map(|pair| [pair[0], pair[1]]).collect(),
            nodes,
            ..Group::default()
        }
    };
    Mesh {
        node_tags: (1..=positions.len() as u64).collect(),
        positions,
        cells,
        groups: SIDES.iter().enumerate().map(group).collect(),
        ..Mesh::default()
    }
}

impl Specimen {
    /// A random specimen of a law.
    pub(crate) fn new(law: Law, random: &mut Random) -> Self {
        let has_lattice = law.row.needs_lattice;
        let plane = if chance(random) {
            Plane::Stress
        } else {
            Plane::Strain
        };
        let cells = [8, 6].map(|least| least + between(random, 0.0, 4.0) as u32);
        let spacing = decade(random, 1e-3, 1.0);
        let mesh = (!has_lattice).then(|| jittered(random, cells, spacing));
        let horizon = if has_lattice {
            Horizon::Factor(2.2)
        } else if chance(random) {
            Horizon::Factor(between(random, 2.5, 3.5))
        } else {
            Horizon::Length(spacing * between(random, 1.8, 2.6))
        };
        // Above that of central forces the shear stiffness of bonds is negative, and breakages soon end a run.
        let central = Isotropic::central_force_poisson(plane);
        let poisson = if law.row.fixes_poisson {
            central
        } else {
            between(random, 0.02, 0.9) * central
        };
        let width = f64::from(cells[0]) * spacing;
        let at = width * between(random, 0.4, 0.6);
        let height = f64::from(cells[1]) * spacing;
        let inwards = width * between(random, -0.1, 0.1);
        let depth = height * between(random, 0.2, 0.4);
        Self {
            law,
            plane,
            cells,
            mesh,
            spacing,
            horizon,
            thickness: decade(random, 1e-2, 1.0),
            young: decade(random, 1e6, 1e12),
            poisson,
            angle: std::f64::consts::PI * random.uniform(),
            strain: decade(random, 1e-5, 1e-3),
            precrack: vec![[at, -0.01 * height], [at + inwards, depth]],
            direction: [between(random, 0.6, 1.0), between(random, 0.1, 0.6)],
            by_force: chance(random),
        }
    }

    /// Width and height, m.
    pub(crate) fn size(&self) -> [f64; 2] {
        self.cells.map(|count| f64::from(count) * self.spacing)
    }

    /// The whole area under the stress of the strain, N.
    fn strength(&self) -> f64 {
        self.young * self.strain * self.size()[1] * self.thickness
    }

    fn material(&self, image: &Image) -> Material {
        let young = image.stress() * self.young;
        let mut material = Material::isotropic(young, self.poisson);
        if self.law == Law::ORTHOTROPIC {
            let (s, c) = self.angle.sin_cos();
            let axis = image.turned([c, s]);
            material.elasticity = Elasticity::Orthotropic(Orthotropic {
                young: [young, 0.6 * young],
                poisson: self.poisson,
                shear_modulus: 0.35 * young,
                out_of_plane: Some(OutOfPlane {
                    young: 0.8 * young,
                    poisson: [0.1, 0.1],
                }),
                angle: axis[1].atan2(axis[0]),
            });
        }
        let toughness = self.young * self.strain * self.strain * self.spacing;
        material.tensile_strength = Some(self.strain * young);
        material.compressive_strength = Some(6.0 * self.strain * young);
        material.fracture_energy = Some(image.force / image.length * toughness);
        material.expansion = Some(Expansion::uniform(1e-5));
        material
    }

    /// The image of a mesh.
    fn meshed(mesh: &Mesh, image: &Image) -> MeshBody {
        let mut mesh = meshes::moved(mesh, |position| image.place(position));
        for cell in &mut mesh.cells {
            if let Cell::Triangle([_, second, third]) = cell
                && image.sense() < 0.0
            {
                std::mem::swap(second, third);
            }
        }
        mesh.into()
    }

    /// The image of the lattice.
    fn lattice(&self, image: &Image) -> LatticeBody {
        let corners = [[0.0; 2], self.size()].map(|it| image.place(it));
        let corner = [0, 1].map(|axis| corners[0][axis].min(corners[1][axis]));
        let side = |(name, normal): (&str, [f64; 2])| {
            let set = match image.turned(normal).map(|it| it as i32) {
                [-1, _] => CellSet::left(1),
                [1, _] => CellSet::right(1),
                [_, -1] => CellSet::bottom(1),
                _ => CellSet::top(1),
            };
            (name.to_owned(), set)
        };
        let turned = image.turned(self.cells.map(f64::from));
        let spacing = [image.length * self.spacing; 2];
        let sets: BTreeMap<String, CellSet> = SIDES.into_iter().map(side).collect();
        let size = turned.map(|count| count.abs() as u32);
        LatticeBody::new(size, spacing, corner, &[], &sets).unwrap()
    }

    /// The specimen with its mirror image beside it, and the image that leaves both as they are.
    pub(crate) fn doubled(mut self) -> (Self, Image) {
        let linear = [[-1.0, 0.0], [0.0, 1.0]];
        self.cells[0] *= 2;
        self.angle = 0.0;
        let axis = if let Some(mesh) = &mut self.mesh {
            *mesh = meshes::mirrored(mesh).0;
            0.0
        } else {
            0.5 * self.size()[0]
        };
        let shift = [2.0 * axis, 0.0];
        let mirror = Image {
            linear,
            shift,
            ..Image::SAME
        };
        (self, mirror)
    }

    /// The image of the specimen, with nothing that holds it or acts on it.
    pub(crate) fn free(&self, image: &Image) -> Setup {
        let material = self.material(image);
        let mut setup = match &self.mesh {
            Some(mesh) => Setup::new(Self::meshed(mesh, image), material, self.law),
            None => Setup::new(self.lattice(image), material, self.law),
        };
        setup.section = Section::Plane {
            state: self.plane,
            thickness: image.length * self.thickness,
        };
        setup.horizon = match self.horizon {
            Horizon::Length(length) => Horizon::Length(image.length * length),
            factor @ Horizon::Factor(_) => factor,
        };
        setup
    }

    /// The image of the specimen, pre-cracked and held on its left.
    fn held(&self, image: &Image) -> Setup {
        let mut setup = self.free(image);
        setup.precracks = vec![PreCrack::along(
            self.precrack.iter().map(|&it| image.place(it)).collect(),
        )];
        setup.supports = vec![Support::new("left", &Component::ALL)];
        setup
    }

    /// What acts on the right side, so many times what makes the strain.
    fn load(&self, image: &Image, times: f64) -> Load {
        let [along, across] = image.turned(self.direction);
        let action = if self.by_force {
            let force = times * image.force * self.strength();
            Action::Force([force * along, force * across, 0.0])
        } else {
            let far = times * image.length * self.strain * self.size()[0];
            Action::Displacement(Displacement {
                x: Some(far * along),
                y: Some(far * across),
                ..Displacement::default()
            })
        };
        Load::new("right", action)
    }

    /// The image of the specimen under all kinds of loads at once, elastic.
    pub(crate) fn loaded(&self, image: &Image) -> Setup {
        let mut setup = self.held(image);
        let stress = self.young * self.strain;
        let of_volume = image.stress() / image.length * stress / self.size()[0];
        setup.loads = vec![
            self.load(image, 1.0),
            Load::new("top", Action::Pressure(image.stress() * 0.3 * stress)),
            Load::new(
                Place::Everywhere,
                Action::BodyForce(flat(image.turned([0.2 * of_volume, -0.5 * of_volume]))),
            ),
        ];
        if self.law.element() == ElementKind::Beam {
            let couple = image.sense() * image.energy() * 0.1 * self.strength() * self.spacing;
            let mut load = Load::new("bottom", Action::Moment(couple.into()));
            load.name = "couple".to_owned();
            setup.loads.push(load);
        }
        setup.temperatures = vec![Temperature {
            place: Place::Everywhere,
            change: TemperatureChange::Uniform(0.5 * self.strain / 1e-5),
        }];
        setup
    }

    /// The image of the specimen pulled until bonds break by these criteria.
    pub(crate) fn torn(&self, image: &Image, criteria: Vec<Choice>, analysis: Analysis) -> Setup {
        let mut setup = self.held(image);
        let times = if self.by_force { 1.5 } else { 4.0 };
        setup.loads = vec![self.load(image, times)];
        setup.no_fail = ["left", "right"].map(Place::from).into();
        setup.criteria = criteria;
        setup.analysis = analysis;
        setup
    }
}

/// A vector in the plane.
fn flat([x, y]: [f64; 2]) -> [f64; 3] {
    [x, y, 0.0]
}
