//! What every element must keep, over a table of all of them.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use super::imaginary::{ImaginaryElement, ImaginaryElements, StrainStiffness};
use super::pair::Pair;
use super::pairwise::{PairwiseElement, PairwiseElements};
use super::true_strain::TrueStrainElement;
use super::*;
use crate::bonds::Incidence;
use crate::layout::Component;
use crate::tensor::{minus, norm};

/// Points of a square lattice with four a side, which stands turned and off the origin only where elements may.
const SIDE: usize = 4;

/// A set of elements with its bonds: every pair up to two spacings apart.
struct Body<const D: usize, const M: usize, E: Element<D, M>> {
    positions: Vec<[f64; D]>,
    bonds: BondSet<D>,
    rigidities: Rigidities,
    lattice: E::Lattice,
}

fn positions<const D: usize>(angle: f64) -> Vec<[f64; D]> {
    let (sin, cos) = f64::sin_cos(angle);
    let place = |number: usize| {
        let [x, y] = [number % SIDE, number / SIDE].map(|it| 0.35 * it as f64);
        // Rows and columns have equal coordinates to the last bit where they are not turned.
        let [x, y] = match angle {
            0.0 => [x, y],
            _ => [2.0 + cos * x - sin * y, -1.0 + sin * x + cos * y],
        };
        let place = [x, y, 0.17 * (number % 3) as f64];
        std::array::from_fn(|axis| place[axis])
    };
    (0..SIDE * SIDE).map(place).collect()
}

fn bonds<const D: usize>(positions: &[[f64; D]]) -> BondSet<D> {
    let offset = |[a, b]: [usize; 2]| minus(positions[b], positions[a]);
    let pairs = (0..positions.len()).flat_map(|a| (a + 1..positions.len()).map(move |b| [a, b]));
    let near: Vec<[usize; 2]> = pairs.filter(|&pair| norm(offset(pair)) < 0.8).collect();
    let ends: Vec<[u32; 2]> = near.iter().map(|pair| pair.map(|it| it as u32)).collect();
    let length: Vec<f64> = near.iter().map(|&pair| norm(offset(pair))).collect();
    let direction = near.iter().zip(&length);
    BondSet {
        incidence: Incidence::new(&ends, positions.len()).into(),
        direction: direction
            .map(|(&pair, l)| offset(pair).map(|it| it / l))
            .collect(),
        horizon: vec![0.8; ends.len()].into(),
        composition: Default::default(),
        length,
        ends: ends.into(),
    }
}

fn body<const D: usize, const M: usize, E: Element<D, M>>(
    angle: f64,
    shear_sign: f64,
    lattice: impl Fn(&BondSet<D>, &[[f64; D]]) -> E::Lattice,
) -> Body<D, M, E> {
    let positions = positions(angle);
    let bonds = bonds(&positions);
    let varied = |size: f64| {
        (0..bonds.len())
            .map(|it| size * (1.0 + 0.1 * (it % 7) as f64))
            .collect()
    };
    let strain = StrainStiffness {
        entries: [5.0, 1.5, 0.3, 4.0, -0.2, 2.0],
        first_share: 0.5,
    };
    Body {
        rigidities: Rigidities {
            axial: varied(5.0),
            shear: varied(3.0 * shear_sign),
            rotational: varied(0.2 * shear_sign),
            strain: vec![strain; bonds.len()],
        },
        lattice: lattice(&bonds, &positions),
        positions,
        bonds,
    }
}

fn lattice(bonds: &BondSet, positions: &[[f64; 2]]) -> ImaginaryElements {
    ImaginaryElements::new(bonds, positions.to_vec())
}

fn pairs<const D: usize, const M: usize>(angle: f64, shear_sign: f64) -> Body<D, M, Pair<D, M>>
where
    Pair<D, M>: Element<D, M, Lattice = ()>,
{
    body(angle, shear_sign, |_, _| ())
}

/// What an element promises beside symmetry and translations.
#[derive(Clone, Copy)]
struct Promise {
    /// A rotation of the body costs nothing.
    turns: bool,
    /// Forces are the derivative of an energy.
    energy: bool,
    /// Forces are linear, and the stiffness is their derivative.
    linear: bool,
}

const ALL: Promise = Promise {
    turns: true,
    energy: true,
    linear: true,
};

/// The table: a row an element, with the check that goes over all its bonds.
fn for_every_element(mut check: impl Check) {
    let springs_turn = Promise {
        turns: false,
        ..ALL
    };
    check.check("beam", &pairs::<2, 3>(0.6, 1.0), ALL);
    check.check("beam, negative shear", &pairs::<2, 3>(0.6, -1.0), ALL);
    check.check("spring", &pairs::<2, 2>(0.6, 1.0), springs_turn);
    check.check("central spring", &pairs::<2, 2>(0.6, 0.0), ALL);
    check.check("beam in space", &pairs::<3, 6>(0.6, 1.0), ALL);
    check.check("spring in space", &pairs::<3, 3>(0.6, 1.0), springs_turn);
    check.check("central spring in space", &pairs::<3, 3>(0.6, 0.0), ALL);
    let imaginary = body::<2, 2, ImaginaryElement>(0.0, 1.0, lattice);
    check.check("imaginary", &imaginary, ALL);
    let promise = Promise {
        energy: false,
        linear: false,
        ..ALL
    };
    let true_strains = body::<2, 2, TrueStrainElement>(0.0, 1.0, lattice);
    check.check("true strain", &true_strains, promise);
    let pairwise = |bonds: &BondSet, positions: &[[f64; 2]]| PairwiseElements {
        lattice: lattice(bonds, positions),
        row_factors: vec![[1.2, 0.9, 1.1]; bonds.len()],
        spacing: [0.35; 2],
    };
    let promise = Promise {
        energy: false,
        ..ALL
    };
    let pairwise = body::<2, 2, PairwiseElement>(0.0, 1.0, pairwise);
    check.check("pairwise", &pairwise, promise);
}

trait Check {
    fn check<const D: usize, const M: usize, E: Element<D, M>>(
        &mut self,
        name: &str,
        body: &Body<D, M, E>,
        promise: Promise,
    );
}

impl<const D: usize, const M: usize, E: Element<D, M>> Body<D, M, E> {
    fn element(&self, bond: usize) -> E {
        let intact = vec![true; self.bonds.len()];
        E::new(&self.lattice, &self.bonds, &self.rigidities, &intact, bond)
    }

    fn n(&self) -> usize {
        M * self.positions.len()
    }

    /// Some motions of all points, of the size of small strains.
    fn unknowns(&self) -> Vec<f64> {
        let some = |it: usize| 4e-4 * ((it * it + 7 * it) % 23) as f64 - 4e-3;
        (0..self.n()).map(some).collect()
    }

    /// A rigid motion moves a point by translation + rotation x position, and turns it by the rotation.
    fn rigid(&self, translation: [f64; 2], rotation: f64) -> Vec<f64> {
        let at = |p: &[f64; D]| -> [f64; M] {
            let [x, y] = translation;
            std::array::from_fn(|place| match Component::in_dimensions(D)[place] {
                Component::X => x - rotation * p[1],
                Component::Y => y + rotation * p[0],
                Component::Z | Component::RotationX | Component::RotationY => 0.0,
                Component::Rotation | Component::RotationZ => rotation,
            })
        };
        self.positions.iter().flat_map(at).collect()
    }
}

fn force<const D: usize, const M: usize, E: Element<D, M>>(element: &E, u: &[f64]) -> Vec<f64> {
    let mut force = vec![0.0; u.len()];
    element.forces(&element.deformation(u), |point, values| {
        for (component, value) in values.into_iter().enumerate() {
            force[M * point as usize + component] += value;
        }
    });
    force
}

fn size(values: &[f64]) -> f64 {
    values.iter().map(|it| it.abs()).fold(0.0, f64::max)
}

/// The difference quotient of a function along one unknown.
fn slope<T>(u: &[f64], at: usize, of: impl Fn(&[f64]) -> T) -> [T; 2] {
    [-1.0, 1.0].map(|sign| {
        let mut moved = u.to_vec();
        moved[at] += sign * STEP;
        of(&moved)
    })
}

const STEP: f64 = 1e-4;

struct RigidMotions;

impl Check for RigidMotions {
    /// Rounding of forces of size 50 bounds a zero at 1e-12.
    fn check<const D: usize, const M: usize, E: Element<D, M>>(
        &mut self,
        name: &str,
        body: &Body<D, M, E>,
        promise: Promise,
    ) {
        let mut seen = 0.0_f64;
        for bond in 0..body.bonds.len() {
            let element = body.element(bond);
            let costs = |u: &[f64]| size(&force(&element, u));
            for translation in [[1.0, 0.0], [0.0, 1.0]] {
                assert!(costs(&body.rigid(translation, 0.0)) < 1e-12, "{name}");
            }
            // True strains take the rotation of a finite angle for a strain of its square.
            let rotation = if promise.linear { 1.0 } else { 1e-7 };
            let turned = costs(&body.rigid([0.3, -0.2], rotation));
            let tolerance = if promise.linear { 1e-12 } else { 1e-11 };
            assert_eq!(turned < tolerance, promise.turns, "{name}: {turned:e}");
            seen = seen.max(costs(&body.unknowns()));
        }
        assert!(seen > 1e-3, "the test must see forces");
    }
}

#[test]
fn rigid_motions_cost_nothing() {
    for_every_element(RigidMotions);
}

struct Balance;

impl Check for Balance {
    fn check<const D: usize, const M: usize, E: Element<D, M>>(
        &mut self,
        name: &str,
        body: &Body<D, M, E>,
        _: Promise,
    ) {
        for bond in 0..body.bonds.len() {
            let found = force(&body.element(bond), &body.unknowns());
            for component in 0..D {
                let of_points = found.iter().skip(component).step_by(M);
                let sum: f64 = of_points.sum();
                assert!(sum.abs() < 1e-14 * found.len() as f64, "{name}: {sum:e}");
            }
        }
    }
}

/// Forces of every element are in balance; sums of some 0.1 N round to 1e-16.
#[test]
fn forces_are_in_balance() {
    for_every_element(Balance);
}

struct Derivatives;

impl Check for Derivatives {
    fn check<const D: usize, const M: usize, E: Element<D, M>>(
        &mut self,
        name: &str,
        body: &Body<D, M, E>,
        promise: Promise,
    ) {
        let u = body.unknowns();
        for bond in (0..body.bonds.len()).step_by(5) {
            let element = body.element(bond);
            let found = force(&element, &u);
            let energy = |u: &[f64]| {
                let deformation = element.deformation(u);
                element.mutual_energy(&deformation, &deformation)
            };
            let n = body.n();
            let mut stiffness = vec![vec![0.0; n]; n];
            element.derivatives(|row, column, value| stiffness[column][row] += value);
            for (at, column) in stiffness.iter().enumerate() {
                if promise.energy {
                    let [backward, forward] = slope(&u, at, energy);
                    let slope = (forward - backward) / (2.0 * STEP);
                    assert!((slope - found[at]).abs() < 1e-10, "{name}: force {at}");
                }
                if promise.linear {
                    let [backward, forward] = slope(&u, at, |u| force(&element, u));
                    let both = forward.iter().zip(&backward);
                    let slopes =
                        both.map(|(forward, backward)| (forward - backward) / (2.0 * STEP));
                    let off: Vec<f64> = slopes.zip(column).map(|(a, b)| a - b).collect();
                    assert!(size(&off) < 1e-9, "{name}: column {at}");
                }
            }
            if promise.energy && promise.linear {
                assert_blocks(name, body, &element, &stiffness);
            }
        }
    }
}

/// The blocks of the assembly are those of the stiffness.
fn assert_blocks<const D: usize, const M: usize, E: Element<D, M>>(
    name: &str,
    body: &Body<D, M, E>,
    element: &E,
    stiffness: &[Vec<f64>],
) {
    let mut seen = 0.0_f64;
    let mut coupled = Vec::new();
    let deformation = element.deformation(&body.unknowns());
    element.forces(&deformation, |point, _| coupled.push(point));
    for point in coupled {
        element.upper_blocks(point, |other, block| {
            for (r, row) in block.iter().enumerate() {
                for (c, value) in row.iter().enumerate() {
                    let [row, column] = [(other, r), (point, c)]
                        .map(|(point, component)| M * point as usize + component);
                    assert!((value - stiffness[column][row]).abs() < 1e-11, "{name}");
                    seen = seen.max(value.abs());
                }
            }
        });
    }
    assert!(seen > 1.0, "the test must see blocks");
}

/// force = d energy / du and stiffness = d force / du by central differences; both are exact for a quadratic energy, so that
/// only rounding (1e-16 / 1e-4 steps) remains.
#[test]
fn forces_and_stiffness_are_derivatives() {
    for_every_element(Derivatives);
}

/// Turning a pair and its unknowns together leaves the energy as it is.
#[test]
fn energy_does_not_depend_on_the_orientation() {
    let energies = |angle: f64| {
        let (sin, cos) = f64::sin_cos(angle - 0.4);
        let both = |turn: &dyn Fn(&[f64]) -> Vec<f64>| {
            let beams = pairs::<2, 3>(angle, 1.0);
            let springs = pairs::<2, 2>(angle, 1.0);
            let u = turn(&beams.unknowns());
            let beam = beams.element(7);
            let spring = springs.element(7);
            let without_rotations: Vec<f64> = u.chunks(3).flat_map(|m| [m[0], m[1]]).collect();
            let other = spring.deformation(&without_rotations);
            let one = beam.deformation(&u);
            [
                beam.mutual_energy(&one, &one),
                spring.mutual_energy(&other, &other),
            ]
        };
        both(&|u| {
            let of_point = |m: &[f64]| [cos * m[0] - sin * m[1], sin * m[0] + cos * m[1], m[2]];
            u.chunks(3).flat_map(of_point).collect()
        })
    };
    let reference = energies(0.4);
    for turn in [0.3, 1.2, 2.9, -2.0] {
        for (found, expected) in energies(0.4 + turn).into_iter().zip(reference) {
            assert!((found / expected - 1.0).abs() < 1e-12);
        }
    }
}

/// A spring bond does not know a rotation of the body from a shear.
#[test]
fn a_rotation_shears_a_spring() {
    let springs = pairs::<2, 2>(0.6, 1.0);
    let element = springs.element(7);
    let turned = element.deformation(&springs.rigid([0.3, -0.2], 1.0));
    assert!((turned.shear() - 1.0).abs() < 1e-14);
}
