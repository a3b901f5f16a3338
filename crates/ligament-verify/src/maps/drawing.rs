//! The motion of a body, for comparisons and drawings.

use anyhow::Context;
use ligament_analysis::Component;
use ligament_model::System;
use ligament_output::vtu::Cell;
use ligament_plot::picture::maps::{MappedBody, Maps};

use crate::finite_elements::Mesh;
use crate::named_modes::NAMES;

/// Displacements of a body, and rotations of a lattice.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    /// Points or elements that move.
    pub(super) body: Discretisation,
    /// Displacements of the body's points, shape (n_points, 2), m; for a mode with an arbitrary amplitude.
    pub(super) displacements: Vec<[f64; 2]>,
    /// Rotations of the points of a lattice, shape (n_points), rad.
    pub(super) rotations: Vec<f64>,
}

/// Points or elements with the displacements.
#[derive(Debug, Clone)]
pub(super) enum Discretisation {
    /// Positions of points (m), and their spacing (m).
    Lattice(Vec<[f64; 2]>, f64),
    /// Nodes of quadrilaterals.
    Elements(Mesh),
}

/// Quantity of a motion that is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) enum Quantity {
    /// A component of the displacement.
    Component(usize),
    /// The length of the displacement, for modes.
    Length,
    /// The rotation of the points.
    Rotation,
}

impl Motion {
    /// The motion of a lattice by the values of all its degrees of freedom.
    pub(super) fn from_lattice(system: &dyn System<2>, of_all: &[f64]) -> anyhow::Result<Self> {
        let (cloud, layout) = (&system.cloud, system.topology().layout);
        let [spacing, _] = cloud.lattice_cell.context("the body is no lattice")?;
        let points = 0..cloud.len() as u32;
        let value = |point, component| layout.value(point, component, of_all);
        Ok(Self {
            body: Discretisation::Lattice(cloud.positions.clone(), spacing),
            displacements: (points.clone())
                .map(|point| [Component::X, Component::Y].map(|it| value(point, it)))
                .collect(),
            rotations: points.map(|it| value(it, Component::Rotation)).collect(),
        })
    }

    /// The motion of finite elements by the displacements of their nodes.
    pub(super) fn from_elements(mesh: Mesh, displacements: Vec<[f64; 2]>) -> Self {
        Self {
            body: Discretisation::Elements(mesh),
            displacements,
            rotations: Vec::new(),
        }
    }

    /// The motion with the sign for which the larger displacement component of the upper right corner is positive.
    pub(super) fn with_sign(mut self) -> Self {
        let by = |one: &usize, other: &usize| {
            let sum = |place: usize| self.points()[place].iter().sum::<f64>();
            sum(*one).total_cmp(&sum(*other))
        };
        let corner = (0..self.displacements.len()).max_by(by);
        let [u, v] = corner.map_or([0.0; 2], |corner| self.displacements[corner]);
        if (if u.abs() > v.abs() { u } else { v }) < 0.0 {
            for value in self.displacements.iter_mut().flatten() {
                *value = -*value;
            }
        }
        self
    }

    /// Adds a uniform expansion about the origin.
    pub(super) fn expand(&mut self, strain: f64) {
        let points = self.points().to_vec();
        for (place, moved) in points.iter().zip(&mut self.displacements) {
            *moved = [0, 1].map(|axis| moved[axis] + strain * place[axis]);
        }
    }

    fn points(&self) -> &[[f64; 2]] {
        match &self.body {
            Discretisation::Lattice(points, _) => points,
            Discretisation::Elements(mesh) => &mesh.nodes,
        }
    }

    /// The motion without its mean displacement and its mean rotation about the origin.
    pub(super) fn without_rigid_motion(mut self) -> Self {
        let count = self.points().len() as f64;
        let sum = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>();
        let mean = [0, 1].map(|axis| sum(&mut self.displacements.iter().map(|u| u[axis])) / count);
        let pairs = || self.points().iter().zip(&self.displacements);
        let turned = sum(&mut pairs().map(|([x, y], [u, v])| x * v - y * u));
        let inertia = sum(&mut self.points().iter().map(|[x, y]| x * x + y * y));
        let rate = turned / inertia;
        let points = self.points().to_vec();
        for ([x, y], [u, v]) in points.iter().zip(&mut self.displacements) {
            *u += rate * y - mean[0];
            *v -= rate * x + mean[1];
        }
        for rotation in &mut self.rotations {
            *rotation -= rate;
        }
        self
    }

    /// The displacements of elements at the points of a lattice, which are nodes or the middles of elements.
    fn at(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let Discretisation::Elements(mesh) = &self.body else {
            return self.displacements.clone();
        };
        let middle = |nodes: &Vec<usize>| {
            let share = 1.0 / nodes.len() as f64;
            nodes.iter().fold([0.0; 2], |[u, v], &node| {
                let [du, dv] = self.displacements[node];
                [u + share * du, v + share * dv]
            })
        };
        let (places, values) = match mesh.nodes.len() == points.len() {
            true => (mesh.nodes.clone(), self.displacements.clone()),
            false => (mesh.centres(), mesh.cells.iter().map(middle).collect()),
        };
        let nearest = |point: &[f64; 2]| {
            let distance = |place: &[f64; 2]| (place[0] - point[0]).hypot(place[1] - point[1]);
            let by = |one: &usize, other: &usize| {
                distance(&places[*one]).total_cmp(&distance(&places[*other]))
            };
            values[(0..places.len()).min_by(by).unwrap_or_default()]
        };
        points.iter().map(nearest).collect()
    }

    /// L2 norm of the difference from the displacements of elements over the norm of these, at the points of this lattice.
    pub(super) fn difference(&self, elements: &Self) -> f64 {
        let other = elements.at(self.points());
        let squares = |values: &mut dyn Iterator<Item = [f64; 2]>| {
            values.map(|[u, v]| u * u + v * v).sum::<f64>()
        };
        let pairs = self.displacements.iter().zip(&other);
        let difference =
            squares(&mut pairs.map(|(one, other)| [one[0] - other[0], one[1] - other[1]]));
        (difference / squares(&mut other.iter().copied())).sqrt()
    }

    /// Modal assurance (a . b)^2/(a . a b . b) with elements, at the points of this lattice: 1 for equal shapes.
    pub(super) fn assurance(&self, elements: &Self) -> f64 {
        let other = elements.at(self.points());
        let product = |one: &[[f64; 2]], other: &[[f64; 2]]| {
            (one.iter().flatten().zip(other.iter().flatten()))
                .map(|(a, b)| a * b)
                .sum::<f64>()
        };
        let own = &self.displacements;
        product(own, &other).powi(2) / (product(own, own) * product(&other, &other))
    }

    /// The body with a quantity, for drawing.
    pub(super) fn mapped_body(&self, title: impl Into<String>, quantity: Quantity) -> MappedBody {
        let values = match quantity {
            Quantity::Component(axis) => self.displacements.iter().map(|u| u[axis]).collect(),
            Quantity::Length => self
                .displacements
                .iter()
                .map(|u| u[0].hypot(u[1]))
                .collect(),
            Quantity::Rotation => self.rotations.clone(),
        };
        match &self.body {
            Discretisation::Lattice(points, spacing) => {
                MappedBody::from_lattice(title, points, *spacing, &self.displacements, values)
            }
            Discretisation::Elements(mesh) => MappedBody::from_mesh(
                title,
                mesh.nodes.clone(),
                quadrilaterals(mesh),
                self.displacements.clone(),
                values,
            ),
        }
    }
}

/// The elements as quadrilaterals between neighbouring nodes.
fn quadrilaterals(mesh: &Mesh) -> Vec<Cell> {
    let degree = mesh.degree as usize;
    let row = degree + 1;
    let of_element = |nodes: &Vec<usize>| {
        let quadrilateral = |k: usize| {
            let first = k % degree + row * (k / degree);
            let corners = [first, first + 1, first + row + 1, first + row];
            Cell::Quad(corners.map(|corner| nodes[corner] as u32))
        };
        (0..degree * degree).map(quadrilateral).collect::<Vec<_>>()
    };
    mesh.cells.iter().flat_map(of_element).collect()
}

/// Maps of a component of the displacement of several motions.
pub(super) fn maps_of_component(
    name: String,
    title: &str,
    motions: &[(String, Motion)],
    axis: usize,
) -> Maps {
    let quantity = ["u_x", "u_y"][axis];
    Maps {
        name: format!("{name}-{quantity}"),
        title: title.to_owned(),
        quantity: quantity.to_owned(),
        unit: "m",
        bodies: (motions.iter())
            .map(|(title, motion)| motion.mapped_body(title, Quantity::Component(axis)))
            .collect(),
        columns: motions.len(),
        are_modes: false,
    }
}

/// Maps of modes: a row of three for each method.
pub(super) fn maps_of_modes(name: String, title: &str, methods: &[(&str, Vec<Motion>)]) -> Maps {
    let of_method = |(method, modes): &(&str, Vec<Motion>)| {
        let pairs = modes.iter().zip(NAMES);
        let drawn = |(motion, name): (&Motion, &str)| {
            let motion = motion.clone().with_sign();
            motion.mapped_body(format!("{method}, {name}"), Quantity::Length)
        };
        pairs.map(drawn).collect::<Vec<_>>()
    };
    Maps {
        name,
        title: title.to_owned(),
        quantity: "|u| / its 99.5 % quantile".to_owned(),
        unit: "-",
        bodies: methods.iter().flat_map(of_method).collect(),
        columns: NAMES.len(),
        are_modes: true,
    }
}
