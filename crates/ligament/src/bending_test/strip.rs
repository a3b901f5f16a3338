//! A strip of a body at a section, free and of one material.

use ligament_model::tensor::{SymTensor, directions_across};

use super::facets::{self, Facet, dot, mean, minus, second_moments, size, volume_and_middle};
use super::part::free;
use super::stress::{LinearStress, Tensor};
use super::thinnest::Section;
use crate::body::AnyBody;
use crate::coordinates::narrowed;
use crate::error::SetupError;
use crate::formulation::stiffness_of_materials;
use crate::loading::material_of_cell;
use crate::setup::Setup;

/// Length of a strip over the sum of thickness and horizon.
const LENGTH: f64 = 4.0;

/// Extent of a strip to either side of its middle, over its thickness: one half, with room for curved bodies.
const HALF_HEIGHT: f64 = 0.75;

/// A strip of a body.
pub(super) struct Strip<const D: usize> {
    pub(super) setup: Setup,
    facets: Vec<Facet<D>>,
    second: Tensor<D>,
    volume: f64,
    middle: [f64; D],
    /// Whether the strip is the whole body, of one material.
    pub(super) is_whole: bool,
    pub(super) across: [f64; D],
    pub(super) along: [f64; D],
    /// Direction orthogonal to `across` and `along`; none in the plane.
    pub(super) beside: Option<[f64; D]>,
}

impl<const D: usize> Strip<D> {
    /// The connected cells around a section, of the material at its middle.
    ///
    /// # Errors
    ///
    /// If the groups of the materials are wrong.
    pub(super) fn cut(setup: &Setup, section: &Section) -> Result<Self, SetupError> {
        let cells = setup.body.corners();
        let (place_of_section, across) = (narrowed(section.place), narrowed(section.across));
        let reach = 0.5 * LENGTH * (section.thickness + section.horizon);
        let positions = setup.body.geometry().positions();
        let is_inside = |place: [f64; D]| {
            let from = minus(place, place_of_section);
            let height = dot(from, across);
            let aside = dot(from, from) - height * height;
            height.abs() <= HALF_HEIGHT * section.thickness && aside <= reach * reach
        };
        let (mut inside, mut nearest) = (vec![false; cells.len()], (f64::INFINITY, 0));
        for (cell, corners) in cells.iter().enumerate() {
            let places: Vec<_> = corners.iter().map(|&it| positions[it as usize]).collect();
            inside[cell] = places.iter().all(|place| is_inside(*place));
            let away = size(minus(mean(&places), place_of_section));
            if away < nearest.0 {
                nearest = (away, cell);
            }
        }
        let (_, first) = nearest;
        let connected = connected(&cells, inside, first, positions.len());
        let material = material_of_cell(setup)?[first] as usize;
        let is_whole = connected.len() == cells.len();
        let part = match is_whole {
            true => setup.body.clone(),
            false => {
                let part = setup.body.geometry::<D>().part(&connected);
                part.map_or_else(|| setup.body.clone(), AnyBody::shared)
            }
        };
        let strip = Self::new(free(setup, part, material), section);
        let is_whole = is_whole && setup.materials.len() == 1;
        Ok(Self { is_whole, ..strip })
    }

    fn new(setup: Setup, section: &Section) -> Self {
        let mut facets = facets::of_body(&setup);
        let (volume, middle) = volume_and_middle(&facets);
        for facet in &mut facets {
            facet.places = facet.places.map(|place| minus(place, middle));
        }
        let second = second_moments(&facets);
        let across = narrowed(section.across);
        let (along, beside) = principal(&second, across);
        Self {
            setup,
            facets,
            second,
            volume,
            middle,
            is_whole: false,
            across,
            along,
            beside,
        }
    }

    /// Mean of the square of the coordinate along an axis, m^2.
    fn variance(&self, axis: [f64; D]) -> f64 {
        product(&self.second, axis, axis) / self.volume
    }

    /// Stress of bending, sigma = n (a x a).
    pub(super) fn bending(&self) -> LinearStress<D> {
        let along = self.along;
        self.across
            .map(|n| along.map(|row| along.map(|column| n * row * column)))
    }

    /// Stress of torsion, sigma_ab = - v_b n and sigma_an = v_n b, over the larger of the variances; none in the plane.
    pub(super) fn torsion(&self) -> Option<LinearStress<D>> {
        let (along, across, beside) = (self.along, self.across, self.beside?);
        let [of_across, of_beside] = [across, beside].map(|axis| self.variance(axis));
        let scale = 1.0 / of_across.max(of_beside);
        Some(std::array::from_fn(|k| {
            let [of_n, of_b] = [
                scale * of_across * beside[k],
                -scale * of_beside * across[k],
            ];
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let symmetric = |axis: [f64; D]| along[i] * axis[j] + along[j] * axis[i];
                    of_n * symmetric(across) + of_b * symmetric(beside)
                })
            })
        }))
    }

    /// Forces of the tractions of a stress on the points, shape (n_points), N.
    ///
    /// The mean of N_P sigma over a flat side is the sum of sigma at its corners, with the corner P counted twice, over D (D + 1).
    pub(super) fn forces(&self, stress: &LinearStress<D>) -> Vec<[f64; D]> {
        let width = self.setup.thickness();
        let mut forces = vec![[0.0; D]; self.setup.body.n_points()];
        for facet in &self.facets {
            let tractions = facet
                .places
                .map(|place| traction(stress, place, facet.area));
            for (k, &corner) in facet.corners.iter().enumerate() {
                for (axis, force) in forces[corner as usize].iter_mut().enumerate() {
                    let sum: f64 = tractions.iter().map(|it| it[axis]).sum();
                    *force += width * (sum + tractions[k][axis]) / (D * (D + 1)) as f64;
                }
            }
        }
        forces
    }

    /// Displacements of a classical continuum at the points under a stress, without their rigid motions, shape (n_points), m; zero outside
    /// of the middle half of the strip.
    ///
    /// The displacements are u_i = 1/2 (E_ijk + E_ikj - E_jki) x_j x_k with the gradient E_ijk of the strain eps_ij along x_k.
    pub(super) fn displacement(&self, stress: &LinearStress<D>) -> Option<Vec<[f64; D]>> {
        let mut growth = [[[0.0; D]; D]; D];
        for (growth, stress) in growth.iter_mut().zip(stress) {
            *growth = strain(&self.setup, stress)?;
        }
        let places = self.places();
        let reach = places.iter().map(|it| dot(*it, self.along).abs());
        let half = 0.5 * reach.fold(0.0, f64::max);
        let is_middle = |place: &[f64; D]| dot(*place, self.along).abs() <= half;
        let of_middle = |motion: &dyn Fn([f64; D]) -> [f64; D]| -> Vec<[f64; D]> {
            let motion = |place: &[f64; D]| {
                if is_middle(place) {
                    motion(*place)
                } else {
                    [0.0; D]
                }
            };
            places.iter().map(motion).collect()
        };
        let quadratic = |x: [f64; D]| {
            std::array::from_fn(|i| {
                let term = |j: usize, k: usize| {
                    0.5 * (growth[k][i][j] + growth[j][i][k] - growth[i][j][k]) * x[j] * x[k]
                };
                (0..D)
                    .flat_map(|j| (0..D).map(move |k| (j, k)))
                    .map(|(j, k)| term(j, k))
                    .sum()
            })
        };
        let mut rigid: Vec<Vec<[f64; D]>> = Vec::new();
        for one in 0..D {
            rigid.push(of_middle(&|_| {
                std::array::from_fn(|axis| f64::from(axis == one))
            }));
            for other in 0..one {
                rigid.push(of_middle(&|x| {
                    let mut motion = [0.0; D];
                    (motion[one], motion[other]) = (x[other], -x[one]);
                    motion
                }));
            }
        }
        for last in 0..rigid.len() {
            let (before, own) = rigid.split_at_mut(last);
            before.iter().for_each(|mode| without(&mut own[0], mode));
        }
        let mut found = of_middle(&quadratic);
        rigid.iter().for_each(|mode| without(&mut found, mode));
        Some(found)
    }

    /// Positions of the points relative to the middle of the strip, shape (n_points), m.
    fn places(&self) -> Vec<[f64; D]> {
        let positions = self.setup.body.geometry().positions();
        let relative = positions.iter().map(|it| minus(*it, self.middle));
        relative.collect()
    }

    /// Norm of the largest strain at the outline under a stress.
    pub(super) fn largest_strain(&self, stress: &LinearStress<D>) -> Option<f64> {
        let mut largest = 0.0_f64;
        for place in self.facets.iter().flat_map(|it| it.places) {
            let strain = strain(&self.setup, &at(stress, place))?;
            largest = largest.max(strain.iter().map(|row| dot(*row, *row)).sum::<f64>().sqrt());
        }
        Some(largest)
    }
}

/// Strains of the first material of a setup under a stress (Pa), with the effective constants of the law.
fn strain<const D: usize>(setup: &Setup, stress: &Tensor<D>) -> Option<Tensor<D>> {
    let stiffness = stiffness_of_materials(setup).into_iter().next()?;
    let stress = SymTensor::<D>::from_fn(|row, column| stress[row][column]);
    let stress: Vec<f64> = stress.components().collect();
    let compliance = stiffness.try_inverse()?;
    let component = |row: usize| {
        let products = stress.iter().enumerate();
        products.map(|(k, it)| compliance[(row, k)] * it).sum()
    };
    let strain: Vec<f64> = (0..stress.len()).map(component).collect();
    let strain = SymTensor::<D>::from_engineering(&strain);
    Some(std::array::from_fn(|row| {
        std::array::from_fn(|column| strain.at(row, column))
    }))
}

/// Subtracts the projection on other motions from motions.
fn without<const D: usize>(motions: &mut [[f64; D]], other: &[[f64; D]]) {
    let product =
        |a: &[[f64; D]], b: &[[f64; D]]| -> f64 { a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum() };
    let share = product(motions, other) / product(other, other);
    if share.is_finite() {
        for (motion, other) in motions.iter_mut().zip(other) {
            *motion = std::array::from_fn(|axis| motion[axis] - share * other[axis]);
        }
    }
}

/// Value of a stress at a position from the strip's middle, Pa.
fn at<const D: usize>(stress: &LinearStress<D>, place: [f64; D]) -> Tensor<D> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..D).map(|k| stress[k][i][j] * place[k]).sum())
    })
}

fn traction<const D: usize>(stress: &LinearStress<D>, place: [f64; D], area: [f64; D]) -> [f64; D] {
    at(stress, place).map(|row| dot(row, area))
}

fn product<const D: usize>(tensor: &Tensor<D>, a: [f64; D], b: [f64; D]) -> f64 {
    dot(tensor.map(|row| dot(row, b)), a)
}

/// The direction across another in which a body is longest, and in space the direction across both.
fn principal<const D: usize>(second: &Tensor<D>, across: [f64; D]) -> ([f64; D], Option<[f64; D]>) {
    match directions_across(across)[..] {
        [one, other] => {
            let [xx, yy] = [one, other].map(|it| product(second, it, it));
            let angle = 0.5 * (2.0 * product(second, one, other)).atan2(xx - yy);
            let (sin, cos) = angle.sin_cos();
            let turned = |cos: f64, sin: f64| {
                std::array::from_fn(|axis| cos * one[axis] + sin * other[axis])
            };
            (turned(cos, sin), Some(turned(-sin, cos)))
        }
        [along] => (along, None),
        _ => (across, None),
    }
}

/// The marked cells that common corners connect with `first`, ascending.
fn connected(cells: &[&[u32]], mut marked: Vec<bool>, first: usize, n_points: usize) -> Vec<usize> {
    let mut at_points = vec![Vec::new(); n_points];
    for (cell, corners) in cells.iter().enumerate().filter(|(cell, _)| marked[*cell]) {
        corners
            .iter()
            .for_each(|&corner| at_points[corner as usize].push(cell));
    }
    let (mut found, mut next) = (Vec::new(), vec![first]);
    marked[first] = false;
    while let Some(cell) = next.pop() {
        found.push(cell);
        for &corner in cells[cell] {
            for &beside in &at_points[corner as usize] {
                if std::mem::take(&mut marked[beside]) {
                    next.push(beside);
                }
            }
        }
    }
    found.sort_unstable();
    found
}
