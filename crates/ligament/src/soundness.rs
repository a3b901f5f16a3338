//! Whether points and bonds are fit for a computation: what no equation would tell.

use ligament_model::bonds::outline::{Outline, PlaneOutline};
use ligament_model::element::Rigidities;
use ligament_model::{BondSet, BondSystem, Horizons, PointCloud};

use crate::body::Body;
use crate::error::{Fault, Field, SetupError, Torn};
use crate::setup::{Horizon, Setup};

/// Part of the size of a point below which its nearest point is one with it.
///
/// Double nodes of exports in single precision lie up to 1e-7 of the body's size apart, 1e-5 of cells of a hundredth of it. Of two
/// points nearer than this one bond would be 1e5 times as stiff as all others.
pub(crate) const DISTINCT: f64 = 1e-5;

/// Refuses cells that lie on others.
pub(crate) fn forbid_overlap(body: &dyn Body, cloud: &PointCloud) -> Result<(), SetupError> {
    let outline = PlaneOutline::of_cells(body.cells(), cloud);
    let Some([from, to]) = outline.first_crossing() else {
        return Ok(());
    };
    Err(Field::whole("body").error(Fault::Overlap {
        from: body.place(from),
        to: body.place(to),
    }))
}

/// Refuses points that nearly coincide, measured by the side of the square of their area.
pub(crate) fn require_distinct(body: &dyn Body, cloud: &PointCloud) -> Result<(), SetupError> {
    let size = |point: usize| (cloud.volumes[point] / cloud.thickness).sqrt();
    let is_near = |&point: &usize| cloud.spacing[point] < DISTINCT * size(point);
    let mut in_file = (0..cloud.len() as u32).map(|it| cloud.numbering.point(it) as usize);
    let Some(point) = in_file.find(is_near) else {
        return Ok(());
    };
    let from = cloud.positions[point];
    let distance = |other: &usize| {
        let to = cloud.positions[*other];
        (to[0] - from[0]).hypot(to[1] - from[1])
    };
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
pub(crate) fn require_neighbours<const D: usize>(
    body: &dyn Body<D>,
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
) -> Result<(), SetupError> {
    let lone = bonds.lone_points(cloud);
    let Some(&first) = cloud.numbering.sorted(&lone).first() else {
        return Ok(());
    };
    let fault = Fault::LonePoints {
        count: lone.len(),
        n_points: bonds.incidence.n_points(),
        first: body.place(first),
    };
    Err(Field::whole("horizon").error(fault))
}

/// Refuses bonds that leave points alone, or a body of cells in more parts than it has.
pub(crate) fn require_connected(
    setup: &Setup,
    cloud: &PointCloud,
    horizons: &Horizons,
    bonds: &BondSet,
) -> Result<(), SetupError> {
    require_neighbours(&*setup.body, cloud, bonds)?;
    require_whole(setup, cloud, horizons, bonds)
}

/// Refuses bonds that leave a body of cells in more parts than it has: sides of its cells are longer than the horizons.
fn require_whole(
    setup: &Setup,
    cloud: &PointCloud,
    horizons: &Horizons,
    bonds: &BondSet,
) -> Result<(), SetupError> {
    let body = &*setup.body;
    let corners = body.cells().iter().map(|cell| cell.corners());
    let sides = corners.flat_map(|it| (0..it.len()).map(|k| [it[k], it[(k + 1) % it.len()]]));
    let parts = Parts::of_bonds(cloud, bonds);
    // A side whose ends hang together in the body, but not by its bonds.
    let length = |&[from, to]: &[u32; 2]| {
        let [from, to] = [from, to].map(|it| cloud.positions[it as usize]);
        (to[0] - from[0]).hypot(to[1] - from[1])
    };
    let radius = |&[from, to]: &[u32; 2]| {
        let [from, to] = [from, to].map(|it| horizons.radius[it as usize]);
        from.max(to)
    };
    let torn = sides
        .filter(|ends| parts.part(ends[0]) != parts.part(ends[1]) && length(ends) > radius(ends));
    let Some(worst) = torn.max_by(|one, other| {
        (length(one) / radius(one)).total_cmp(&(length(other) / radius(other)))
    }) else {
        return Ok(());
    };
    let of_mesh = Parts::new(
        cloud.len(),
        body.cells().iter().flat_map(|cell| {
            let corners = cell.corners();
            corners.iter().map(|&it| [corners[0], it])
        }),
    );
    let [from, to] = worst.map(|it| cloud.positions[it as usize]);
    let excess = length(&worst) / radius(&worst);
    let torn = Torn {
        parts: parts.count(),
        of_body: of_mesh.count(),
        places: worst.map(|it| body.place(it)),
        along: (0..2)
            .map(|axis| (to[axis] - from[axis]).abs() / length(&worst))
            .collect(),
        length: length(&worst),
        horizon: radius(&worst),
        remedy: match setup.horizon {
            Horizon::Factor(factor) => format!("a horizon factor above {:.2}", factor * excess),
            Horizon::Length(length) => format!("a horizon above {:.4e} m", length * excess),
        },
    };
    Err(Field::whole("horizon").error(Fault::Torn(Box::new(torn))))
}

/// Refuses bonds whose stiffness is no number that equations can be made of.
pub(crate) fn require_numbers<const D: usize>(
    body: &dyn Body<D>,
    system: &BondSystem<D>,
) -> Result<(), SetupError> {
    require_rigidities(body, &system.cloud, &system.rigidities, &system.bonds.ends)
}

/// Refuses factors of a correction (n_bonds) that are no numbers, of bonds between some ends with an axial stiffness (n_bonds both) of a size
/// with which a correction can compute.
pub(crate) fn require_factors<const D: usize>(
    body: &dyn Body<D>,
    cloud: &PointCloud<D>,
    (factors, axial): (&[f64], &[f64]),
    ends: &[[u32; 2]],
) -> Result<(), SetupError> {
    // What is larger or smaller has a square that is no number.
    let is_sound = |stiffness: &f64| (1e-150..1e150).contains(&stiffness.abs());
    let mut both = factors.iter().zip(axial);
    let wrong = both.position(|(factor, axial)| !factor.is_finite() && is_sound(axial));
    let Some(places) = first_of(body, cloud, wrong, ends) else {
        return Ok(());
    };
    let distances = cloud.spacing.iter().copied();
    let spacing = [
        distances.clone().fold(f64::INFINITY, f64::min),
        distances.fold(0.0, f64::max),
    ];
    Err(Field::whole("correction").error(Fault::NoCorrection { places, spacing }))
}

/// The first bond that is wrong, over all processes, by its ends in words; `wrong` is the one of this process, if it has one.
fn first_of<const D: usize>(
    body: &dyn Body<D>,
    cloud: &PointCloud<D>,
    wrong: Option<usize>,
    ends: &[[u32; 2]],
) -> Option<[String; 2]> {
    let wrong = wrong.map(|bond| ends[bond].map(f64::from));
    let first = (cloud.portion.as_ref()).map_or(wrong, |portion| portion.least(wrong));
    let ends = first?.map(|it| it as u32);
    Some((cloud.numbering.ordered(ends)).map(|end| body.place(end)))
}

/// Refuses rigidities of bonds between some ends (n_bonds) that are no numbers to make equations of.
pub(crate) fn require_rigidities<const D: usize>(
    body: &dyn Body<D>,
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
    let largest = cloud.largest(sizes.fold(f64::NEG_INFINITY, f64::max));
    // Without any bond there is no largest one.
    if largest < 0.0 || (1e-270..1e270).contains(&largest) {
        return Ok(());
    }
    Err(Field::whole("materials").error(Fault::OutOfNumbers { rigidity: largest }))
}

/// Points that hang together by pairs.
pub(crate) struct Parts {
    /// The first point of the part of each point.
    first: Vec<u32>,
}

impl Parts {
    pub(crate) fn new(n_points: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Self {
        let mut first: Vec<u32> = (0..n_points as u32).collect();
        let root = |first: &mut [u32], mut point: u32| {
            while first[point as usize] != point {
                first[point as usize] = first[first[point as usize] as usize];
                point = first[point as usize];
            }
            point
        };
        for [one, other] in pairs {
            let roots = [one, other].map(|it| root(&mut first, it));
            first[roots[0].max(roots[1]) as usize] = roots[0].min(roots[1]);
        }
        for point in 0..n_points as u32 {
            first[point as usize] = root(&mut first, point);
        }
        Self { first }
    }

    /// Points of a body that hang together by its bonds.
    pub(crate) fn of_bonds<const D: usize>(cloud: &PointCloud<D>, bonds: &BondSet<D>) -> Self {
        let known = Self::new(cloud.len(), bonds.ends.iter().copied());
        let Some(portion) = &cloud.portion else {
            return known;
        };
        let numbered = (0..)
            .zip(known.first)
            .filter(|(point, first)| point != first);
        let pairs: Vec<[f64; 2]> = numbered
            .map(|(point, first)| [point, first].map(f64::from))
            .collect();
        let all = portion.concatenated(&pairs).into_iter();
        Self::new(cloud.len(), all.map(|pair| pair.map(|it| it as u32)))
    }

    pub(crate) fn part(&self, point: u32) -> u32 {
        self.first[point as usize]
    }

    pub(crate) fn count(&self) -> usize {
        let firsts = self.first.iter().enumerate();
        firsts
            .filter(|(point, first)| *point == **first as usize)
            .count()
    }
}
