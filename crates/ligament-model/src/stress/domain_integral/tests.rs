#![allow(clippy::unwrap_used)]

use super::*;

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
        ..field
    }
}

fn sum(a: &ElasticField, b: &ElasticField) -> ElasticField {
    ElasticField {
        stress: a.stress.plus(&b.stress),
        strain: a.strain.plus(&b.strain),
        slope: std::array::from_fn(|axis| a.slope[axis] + b.slope[axis]),
        ..*a
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
            let field = ElasticField::near_tip(quantity, MODULI, 0.01, angle);
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
            let found = field.strain.engineering().chain(field.slope);
            let size = 1.0 / (MODULI.young * 0.01_f64.sqrt());
            for (found, expected) in found.zip(expected) {
                assert!((found - expected).abs() < 1e-6 * size, "{found} {expected}");
            }
        }
    }
}

/// An inclined tip with K_I = 2 and K_II = -3 on a lattice of 20 points over the width of the ring: both are found, and J = (K_I^2 +
/// K_II^2)/E', over three rings. 2e-3 is the error of the sum over the points.
#[test]
fn a_ring_finds_the_intensities_of_its_field() {
    let angle: f64 = 0.3;
    let direction = [angle.cos(), angle.sin()];
    let half_width = 40;
    let places: Vec<[f64; 2]> = (-half_width..=half_width)
        .flat_map(|row| {
            (-half_width..=half_width).map(move |column| {
                [0.3 + f64::from(column), 0.4 + f64::from(row)].map(|it| 1e-3 * it)
            })
        })
        .collect();
    let n = places.len();
    let cloud = PointCloud::from_points(&places, &vec![2e-9; n], 2e-3, &vec![0; n], 1);
    for radii in [[2e-3, 22e-3], [10e-3, 30e-3], [18e-3, 38e-3]] {
        let ring = Ring {
            tip: cloud.local([0.0, 0.0]),
            direction,
            side: 1.0,
            radii,
        };
        let value = |quantity| {
            let integral = DomainIntegral::new(&cloud, &ring, quantity, Some(MODULI)).unwrap();
            let part = |at: &WeightedPoint| {
                let from_tip = minus(cloud.positions[at.point as usize], ring.tip);
                let mode = |mode, intensity| {
                    let at = (norm(from_tip), ring.angle(from_tip));
                    scaled(ElasticField::near_tip(mode, MODULI, at.0, at.1), intensity)
                };
                let both = sum(
                    &mode(TipQuantity::Opening, 2.0),
                    &mode(TipQuantity::Sliding, -3.0),
                );
                let field = both.turned_from(direction);
                integral.mutual(at, [&field, at.auxiliary.as_ref().unwrap_or(&field)])
            };
            integral.factor * integral.points.iter().map(part).sum::<f64>()
        };
        let expected = [13.0 / MODULI.young, 2.0, -3.0];
        for (quantity, expected) in TipQuantity::ALL.into_iter().zip(expected) {
            let found = value(quantity);
            assert!(
                (found / expected - 1.0).abs() < 2e-3,
                "{quantity:?} {found} {expected}"
            );
        }
    }
}

/// A point on the crack belongs to the side that its line gives it, whatever rounding makes of it.
#[test]
fn points_on_the_line_have_a_side() {
    let ring = |side| Ring {
        tip: [0.0, 0.0],
        direction: [1.0, 0.0],
        side,
        radii: [1.0, 2.0],
    };
    for across in [-1e-13, 0.0, 1e-13] {
        assert_eq!(ring(1.0).angle([-1.0, across]), PI);
        assert_eq!(ring(-1.0).angle([-1.0, across]), -PI);
        assert_eq!(ring(1.0).angle([1.0, across]), 0.0);
    }
}
