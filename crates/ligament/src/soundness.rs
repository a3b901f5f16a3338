//! Checks of points and bonds for defects that the equations would not reveal.

use ligament_model::element::Rigidities;
use ligament_model::tensor::{minus, norm};
use ligament_model::{BondSet, BondSystem, Horizons, PointCloud};

use crate::body::{Body, BodyOutline};
use crate::described::Described;
use crate::error::{Fault, Field, SetupError, Torn};
use crate::parts::Parts;
use crate::setup::Horizon;

/// Distance over the size of a point below which two points coincide.
///
/// Double nodes of exports in single precision lie up to 1e-7 of the body's size apart, which is 1e-5 of the size of cells a hundredth as
/// large. Between two nearer points a bond would be 1e5 times as stiff as all others.
const DISTINCT: f64 = 1e-5;

/// Refuses meshes whose cells overlap.
pub(crate) fn forbid_overlap<const D: usize>(
    body: &dyn Body,
    outline: &dyn BodyOutline<D>,
) -> Result<(), SetupError> {
    let Some([from, to]) = outline.first_crossing() else {
        return Ok(());
    };
    Err(Field::whole("body").error(Fault::Overlap {
        from: body.place(from),
        to: body.place(to),
    }))
}

/// Refuses points that nearly coincide, measured by the side of the square of their area, in space of the cube of their volume.
pub(crate) fn require_distinct<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
) -> Result<(), SetupError> {
    let size = |point: usize| {
        let size = match cloud.lattice_cell {
            Some(sides) => sides.iter().product(),
            None => cloud.volumes[point] / cloud.thickness,
        };
        if D == 2 { size.sqrt() } else { size.cbrt() }
    };
    let is_near = |&point: &usize| cloud.spacing[point] < DISTINCT * size(point);
    let mut in_file = (0..cloud.len() as u32).map(|it| cloud.numbering.point(it) as usize);
    let Some(point) = in_file.find(is_near) else {
        return Ok(());
    };
    let distance = |other: &usize| norm(minus(cloud.positions[*other], cloud.positions[point]));
    let others = (0..cloud.len()).filter(|other| *other != point);
    let other = others.min_by(|one, other| distance(one).total_cmp(&distance(other)));
    let other = other.unwrap_or(point);
    Err(Field::whole("body").error(Fault::NearPoints {
        places: [point, other].map(|it| body.place(it as u32)),
        distance: distance(&other),
        size: size(point),
    }))
}

/// Refuses points that have no neighbour at all: no correction gives them a stiffness.
fn require_neighbours<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
) -> Result<(), SetupError> {
    let lone = bonds.lone_points(cloud);
    let first = cloud.numbering.sorted(&lone).first().map(|&point| {
        let numbers = [
            cloud.numbering.in_file(point),
            cloud.subdomain.number(point),
        ];
        numbers.map(f64::from)
    });
    let count = cloud.subdomain.count(lone.len());
    let Some([_, first]) = cloud.subdomain.all_reduce_min(first) else {
        return Ok(());
    };
    let fault = Fault::LonePoints {
        count,
        n_points: cloud.subdomain.n_all(),
        first: body.place(first as u32),
    };
    Err(Field::whole("horizon").error(fault))
}

/// Refuses bonds that leave points without a neighbour, or that connect a body of cells in more parts than its cells do, because edges of
/// cells are longer than the horizons.
pub(crate) fn require_connected<const D: usize>(
    Described { setup, names }: Described<'_>,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
    bonds: &BondSet<D>,
) -> Result<(), SetupError> {
    require_neighbours(names, cloud, bonds)?;
    let parts = Parts::of_bonds(cloud, bonds);
    if parts.count() == 1 {
        return Ok(());
    }
    let along = |[from, to]: [u32; 2]| -> [f64; D] {
        minus(cloud.positions[to as usize], cloud.positions[from as usize]).map(f64::abs)
    };
    let length = |ends: [u32; 2]| norm(along(ends));
    let radius =
        |[from, to]: [u32; 2]| horizons.radius[from as usize].max(horizons.radius[to as usize]);
    let excess = |ends: &[u32; 2]| length(*ends) / radius(*ends);
    let edges = setup.body.edges();
    let torn = (edges.iter().copied())
        .filter(|ends| parts.part(ends[0]) != parts.part(ends[1]) && excess(ends) > 1.0);
    let worst = torn.max_by(|one, other| excess(one).total_cmp(&excess(other)));
    let row = worst.map(|ends| {
        let [a, b] = cloud.subdomain.numbers(ends).map(f64::from);
        let along: [f64; D] = along(ends).map(|it| it / length(ends));
        let [x, y, z] = [0, 1, 2].map(|axis| along.get(axis).copied().unwrap_or(0.0));
        [-excess(&ends), a, b, length(ends), radius(ends), x, y, z]
    });
    let Some([excess, a, b, length, horizon, along @ ..]) = cloud.subdomain.all_reduce_min(row)
    else {
        return Ok(());
    };
    let torn = Torn {
        parts: parts.count(),
        of_body: Parts::new(&cloud.subdomain, edges.iter().copied()).count(),
        places: [a, b].map(|it| names.place(it as u32)),
        along: along[..D].to_vec(),
        length,
        horizon,
        remedy: match setup.horizon {
            Horizon::Factor(factor) => format!("a horizon factor above {:.2}", -factor * excess),
            Horizon::Length(length) => format!("a horizon above {:.4e} m", -length * excess),
        },
    };
    Err(Field::whole("horizon").error(Fault::Torn(Box::new(torn))))
}

/// Refuses bonds whose stiffness is not finite or out of range.
pub(crate) fn require_finite_rigidities<const D: usize>(
    body: &dyn Body,
    system: &BondSystem<D>,
) -> Result<(), SetupError> {
    require_rigidities(body, &system.cloud, &system.rigidities, &system.bonds.ends)
}

/// Refuses factors of a correction (n_bonds) that are not finite, unless the axial stiffness (n_bonds) of the bond is out of range. `ends`
/// has shape (n_bonds).
pub(crate) fn require_factors<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    (factors, axial): (&[f64], &[f64]),
    ends: &[[u32; 2]],
) -> Result<(), SetupError> {
    // The square of a larger or smaller stiffness overflows or underflows.
    let is_sound = |stiffness: &f64| (1e-150..1e150).contains(&stiffness.abs());
    let mut both = factors.iter().zip(axial);
    let wrong = both.position(|(factor, axial)| !factor.is_finite() && is_sound(axial));
    let Some(places) = first_of(body, cloud, wrong, ends) else {
        return Ok(());
    };
    let distances = cloud.spacing.iter().copied();
    let shortest = distances.clone().fold(f64::INFINITY, f64::min);
    let spacing = [
        -cloud.subdomain.max(-shortest),
        cloud.subdomain.max(distances.fold(0.0, f64::max)),
    ];
    Err(Field::whole("correction").error(Fault::NoCorrection { places, spacing }))
}

/// Descriptions of the ends of the first wrong bond of all processes; `wrong` is the first one of this process, if any.
fn first_of<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    wrong: Option<usize>,
    ends: &[[u32; 2]],
) -> Option<[String; 2]> {
    let wrong = wrong.map(|bond| cloud.subdomain.numbers(ends[bond]).map(f64::from));
    let first = cloud.subdomain.all_reduce_min(wrong);
    let ends = first?.map(|it| it as u32);
    Some((body.numbering().ordered(ends)).map(|end| body.place(end)))
}

/// Refuses rigidities of bonds that are not finite or out of range; `ends` has shape (n_bonds).
fn require_rigidities<const D: usize>(
    body: &dyn Body,
    cloud: &PointCloud<D>,
    rigidities: &Rigidities,
    ends: &[[u32; 2]],
) -> Result<(), SetupError> {
    let Rigidities {
        axial,
        shear,
        rotational,
        ..
    } = rigidities;
    let is_wrong = |bond: &usize| {
        let mut all = [axial, shear, rotational].into_iter().map(|it| it[*bond]);
        all.any(|it| !it.is_finite())
    };
    let wrong = (0..axial.len()).find(is_wrong);
    if let Some(places) = first_of(body, cloud, wrong, ends) {
        return Err(Field::whole("materials").error(Fault::NoNumber { places }));
    }
    // The square of a strain of one in 10^14 counts as well.
    let sizes = axial.iter().map(|it| it.abs());
    let largest = cloud.subdomain.max(sizes.fold(f64::NEG_INFINITY, f64::max));
    // A body without bonds has no largest rigidity.
    if largest < 0.0 || (1e-270..1e270).contains(&largest) {
        return Ok(());
    }
    Err(Field::whole("materials").error(Fault::OutOfNumbers { rigidity: largest }))
}
