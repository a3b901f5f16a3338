#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use super::*;
use crate::tensor::SymTensor;

const MODULI: PlaneModuli = PlaneModuli {
    young: 70e9,
    poisson: 0.3,
};

/// Displacements near a tip in its own directions as handbooks print them (Tada 2000, part I), m.
fn displacement([opening, sliding]: [f64; 2], [x, y]: [f64; 2]) -> [f64; 2] {
    let shear = MODULI.young / (2.0 * (1.0 + MODULI.poisson));
    let kappa = (3.0 - MODULI.poisson) / (1.0 + MODULI.poisson);
    let half = 0.5 * y.atan2(x);
    let (sine, cosine) = (half.sin(), half.cos());
    let scale = (x.hypot(y) / (2.0 * PI)).sqrt() / (2.0 * shear);
    let along = opening * cosine * (kappa - 1.0 + 2.0 * sine * sine)
        + sliding * sine * (kappa + 1.0 + 2.0 * cosine * cosine);
    let across = opening * sine * (kappa + 1.0 - 2.0 * cosine * cosine)
        - sliding * cosine * (kappa - 1.0 - 2.0 * sine * sine);
    [scale * along, scale * across]
}

fn scaled(field: ElasticField, factor: f64) -> ElasticField {
    ElasticField {
        stress: field.stress.scaled(factor),
        strain: field.strain.scaled(factor),
        slope: field.slope.map(|it| factor * it),
        slope_along: field.slope_along.map(|it| factor * it),
        force: field.force.map(|it| factor * it),
    }
}

fn sum(a: &ElasticField, b: &ElasticField) -> ElasticField {
    let add = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|axis| a[axis] + b[axis]);
    ElasticField {
        stress: a.stress.plus(&b.stress),
        strain: a.strain.plus(&b.strain),
        slope: add(a.slope, b.slope),
        slope_along: add(a.slope_along, b.slope_along),
        force: add(a.force, b.force),
    }
}

/// Strains and slopes of the fields of a tip are the derivatives of its displacements: 1e-6 for differences over 1e-4 of the distance.
#[test]
fn fields_of_a_tip_are_derivatives_of_its_displacements() {
    let modes = [
        (TipQuantity::Opening, [1.0, 0.0]),
        (TipQuantity::Sliding, [0.0, 1.0]),
    ];
    for (quantity, intensity) in modes {
        for angle in [-3.0, -1.2, 0.0, 0.4, 2.5_f64] {
            let place = [0.01 * angle.cos(), 0.01 * angle.sin()];
            let field = ElasticField::of_front(quantity, MODULI, [0.01, angle], 0.0);
            let step = 1e-6;
            let derivative = |axis: usize| -> [f64; 2] {
                let moved = |by: f64| {
                    let mut place = place;
                    place[axis] += by;
                    displacement(intensity, place)
                };
                let (after, before) = (moved(step), moved(-step));
                std::array::from_fn(|it| (after[it] - before[it]) / (2.0 * step))
            };
            let [along, across] = [0, 1].map(derivative);
            let expected = [
                along[0],
                across[1],
                along[1] + across[0],
                along[0],
                along[1],
            ];
            let found = field.strain.resized::<2>();
            let found = found.engineering().chain([field.slope[0], field.slope[1]]);
            let size = 1.0 / (MODULI.young * 0.01_f64.sqrt());
            for (found, expected) in found.zip(expected) {
                assert!((found - expected).abs() < 1e-6 * size, "{found} {expected}");
            }
        }
    }
}

/// Stresses along a circle are balanced by the forces on them: the divergence of the stress in cylinder coordinates by differences over 1e-4 of the
/// distance from the front, to 1e-5 of stress over radius.
#[test]
fn fields_along_a_circle_are_in_balance() {
    let radius = 0.05;
    let at = |quantity, [along, across]: [f64; 2]| {
        let place = [along.hypot(across), across.atan2(along)];
        ElasticField::of_front(quantity, MODULI, place, 1.0 / (radius + along))
    };
    for quantity in [
        TipQuantity::Opening,
        TipQuantity::Sliding,
        TipQuantity::Tearing,
    ] {
        for place in [[0.01, 0.004], [-0.006, 0.008], [-0.01, -0.003]] {
            let step = 1e-6;
            let derivative = |axis: usize| -> SymTensor<3> {
                let moved = |by: f64| {
                    let mut place = place;
                    place[axis] += by;
                    at(quantity, place).stress
                };
                let difference = moved(step).plus(&moved(-step).scaled(-1.0));
                difference.scaled(0.5 / step)
            };
            let [along, across] = [0, 1].map(derivative);
            let field = at(quantity, place);
            let (stress, rho) = (field.stress, radius + place[0]);
            let divergence = [
                along.at(0, 0) + across.at(0, 1) + (stress.at(0, 0) - stress.at(2, 2)) / rho,
                along.at(0, 1) + across.at(1, 1) + stress.at(0, 1) / rho,
                along.at(0, 2) + across.at(1, 2) + 2.0 * stress.at(0, 2) / rho,
            ];
            for (found, expected) in field.force.into_iter().zip(divergence) {
                assert!(
                    (found + expected).abs() < 1e-5 * 4.0 / rho,
                    "{found} {expected}"
                );
            }
        }
    }
}

/// K_I = 2, K_II = -3 and K_III = 1.5 at a front on a lattice of points are found over three rings, and J = (K_I^2 + K_II^2)/E' + K_III^2/(2
/// mu). The field has the forces that hold it along a circle.
fn finds_intensities<const D: usize>(
    cloud: &PointCloud<D>,
    front: CrackFront,
    rings: &[[f64; 2]],
    tolerance: f64,
) {
    let modes = [
        (TipQuantity::Opening, 2.0),
        (TipQuantity::Sliding, -3.0),
        (TipQuantity::Tearing, 1.5),
    ];
    let modes = &modes[..D];
    for &radii in rings {
        let front = CrackFront { radii, ..front };
        let value = |quantity| {
            let integral = DomainIntegral::new(cloud, &front, quantity, Some(MODULI)).unwrap();
            let part = |at: &WeightedPoint| {
                let seen = front.sees(in_space(cloud.positions[at.point as usize]));
                let place = [seen.distance, seen.angle];
                let of_mode = |&(mode, intensity): &(TipQuantity, f64)| {
                    let field = ElasticField::of_front(mode, MODULI, place, seen.curvature);
                    scaled(field, intensity)
                };
                let all = modes.iter().map(of_mode).reduce(|a, b| sum(&a, &b));
                let field = all.unwrap().turned_from(seen.axes);
                at.mutual([&field, at.auxiliary.as_ref().unwrap_or(&field)])
            };
            integral.factor * integral.points.iter().map(part).sum::<f64>()
        };
        let of_tearing = if D == 3 { 1.125 / MODULI.shear() } else { 0.0 };
        let release = (TipQuantity::EnergyRelease, 13.0 / MODULI.young + of_tearing);
        for &(quantity, expected) in std::iter::once(&release).chain(modes) {
            let found = value(quantity);
            assert!(
                (found / expected - 1.0).abs() < tolerance,
                "{quantity:?} {found} {expected}"
            );
        }
    }
}

/// An inclined tip in the plane with 20 points over the width of the ring; 2e-3 is the error of the sum over the points.
#[test]
fn a_ring_finds_the_intensities_of_its_field() {
    let (cosine, sine) = (0.3_f64.cos(), 0.3_f64.sin());
    let places: Vec<[f64; 2]> = (-40..=40)
        .flat_map(|row| {
            (-40..=40).map(move |column| {
                [0.3 + f64::from(column), 0.4 + f64::from(row)].map(|it| 1e-3 * it)
            })
        })
        .collect();
    let n = places.len();
    let cloud = PointCloud::from_points(&places, &vec![2e-9; n], 2e-3, &vec![0; n], 1);
    let front = CrackFront {
        place: in_space(cloud.local([0.0, 0.0])),
        axes: [[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]],
        radius: f64::INFINITY,
        side: 1.0,
        radii: [0.0; 2],
        reach: f64::INFINITY,
        length: 2e-3,
    };
    let rings = [[2e-3, 22e-3], [10e-3, 30e-3], [18e-3, 38e-3]];
    finds_intensities(&cloud, front, &rings, 2e-3);
}

/// A straight front in space, with an error of 2e-3 for the sum over the points, and a circular one of 60 spacings: around it the sum has 1/r near the front as
/// well, whose error is of the order of the spacing over the radius, 2 %.
#[test]
fn a_ring_in_space_finds_the_intensities_of_its_field() {
    let places: Vec<[f64; 3]> = (-16..=16)
        .flat_map(|x| (-16..=16).flat_map(move |y| (-24..=24).map(move |z| [x, y, z])))
        .map(|place: [i32; 3]| place.map(|it| 1e-3 * (0.3 + f64::from(it))))
        .collect();
    let n = places.len();
    let cloud = PointCloud::from_points(&places, &vec![1e-9; n], 1.0, &vec![0; n], 1);
    for (radius, tolerance) in [(f64::INFINITY, 2e-3), (60e-3, 2e-2)] {
        let front = CrackFront {
            place: cloud.local([0.0; 3]),
            axes: [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
            radius,
            side: 1.0,
            radii: [0.0; 2],
            reach: 14e-3,
            length: 14e-3,
        };
        finds_intensities(&cloud, front, &[[2e-3, 14e-3], [4e-3, 15e-3]], tolerance);
    }
}
