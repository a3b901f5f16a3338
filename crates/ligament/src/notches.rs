//! Notches, slots and pre-cracks of a body, from the pairs of points that have no bond across them.

use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_analysis::probe::Notch;
use ligament_model::connected::first_points;
use ligament_model::tensor::{SymTensor, dot, minus, norm};
use ligament_model::{AbsentBond, PointCloud};

/// Fewest pairs from which an opening is found.
const FEWEST: usize = 3;

/// Narrow gaps of a body that is not shared out, each of the pairs that have points in common.
///
/// Bonds across a plane have the mean square cosine 2/(D + 1) with its normal, pairs around a round hole 1/D: gaps with less than the
/// middle of both are no notches.
pub(crate) fn notches<const D: usize>(
    cloud: &PointCloud<D>,
    absent: &[AbsentBond],
) -> Arc<[Notch]> {
    if !cloud.subdomain.is_whole() {
        return Arc::default();
    }
    let gap_of = first_points(&cloud.subdomain, absent.iter().map(|it| it.ends));
    let mut gaps = BTreeMap::<u32, Vec<[u32; 2]>>::new();
    for AbsentBond { ends, .. } in absent {
        gaps.entry(gap_of[ends[0] as usize])
            .or_default()
            .push(*ends);
    }
    let gaps = gaps.into_values().filter(|ends| ends.len() >= FEWEST);
    gaps.filter_map(|ends| notch(cloud, ends)).collect()
}

/// Notch between the points of some pairs, with the direction in which most of them lie as its normal; None for a gap without one.
fn notch<const D: usize>(cloud: &PointCloud<D>, ends: Vec<[u32; 2]>) -> Option<Notch> {
    let between = |[a, b]: [u32; 2]| {
        let [a, b] = [a, b].map(|point| cloud.positions[point as usize]);
        minus(b, a)
    };
    let mut directions = SymTensor::<D>::from_fn(|_, _| 0.0);
    for along in ends.iter().map(|&it| between(it)) {
        let share = 1.0 / (dot(along, along) * ends.len() as f64);
        let dyad = SymTensor::from_fn(|row, column| share * along[row] * along[column]);
        directions = directions.plus(&dyad);
    }
    let dimensions = D as f64;
    let least = 0.5 * (2.0 / (dimensions + 1.0) + 1.0 / dimensions);
    if directions.principal_values()[0] < least {
        return None;
    }
    let normal = directions.principal_direction();
    let signed = |along: [f64; D]| {
        let sign = dot(along, normal).signum();
        normal.map(|axis| sign * axis)
    };
    let distance = |along: [f64; D]| dot(along, normal).abs();
    let weight = |along: [f64; D]| (distance(along) / norm(along)).powi(2);
    let all = || ends.iter().map(|&it| between(it));
    Some(Notch {
        normals: all().flat_map(signed).collect(),
        distances: all().map(distance).collect(),
        weights: all().map(weight).collect(),
        ends,
    })
}
