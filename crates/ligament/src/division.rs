//! Division of a body between processes, each of which keeps its part of the body. Only rank 0 has the cells of a mesh: it evaluates them,
//! and sends each other rank its part.

use std::sync::Arc;

use ligament_analysis::messages::{Way, of_first, receive, send};
use ligament_analysis::serial::{self, Damaged, Serial};
use ligament_model::PointCloud;
use ligament_model::communicator::Communicator;

use crate::body::{AnyBody, MeshedBody};
use crate::cutting::{Part, Whole};
use crate::error::{Fault, Field, SetupError};
use crate::local::Discrete;
use crate::setup::Setup;

/// The points of the part of a body that this process keeps: owned points, points that may have bonds with them, points known to all
/// processes, and all corners of cells that these bonds may cross. The cells of a meshed body are needed on rank 0 only. Collective.
///
/// # Errors
///
/// If cells are wrong, or a place of a material, a support, a load or a probe is wrong.
pub(crate) fn divided<const D: usize>(
    setup: Setup,
    communicator: &Arc<dyn Communicator>,
) -> Result<Discrete<D>, SetupError> {
    let body = setup.body.geometry::<D>().clone();
    let names = setup.body.as_body().names();
    let (cloud, part) = match body.meshed() {
        None => {
            let mut whole = Whole::new(&setup)?;
            let near = near_points(&setup, &mut whole.cloud, communicator);
            let corners = whole.cloud.box_around(near.iter().copied());
            let cutter = whole.cutter(vec![corners]);
            let part = cutter.part(0, &near);
            (cutter.into_cloud(), part)
        }
        Some(meshed) => of_first_process(&setup, meshed, communicator)?,
    };
    let cloud = PointCloud {
        volumes: part.volumes.into(),
        material_shares: part.material_shares,
        ..cloud.part(&part.points)
    };
    Ok(Discrete {
        names,
        cloud: part.body.completed(cloud, &part.material_of_cell),
        setup: Setup {
            body: AnyBody::shared(part.body),
            ..setup
        },
        material_of_cell: part.material_of_cell,
        no_fail: part.no_fail,
    })
}

/// Divides the points of a body between processes; returns the points of this process and all points that may have bonds with them,
/// ascending.
fn near_points<const D: usize>(
    setup: &Setup,
    cloud: &mut PointCloud<D>,
    communicator: &Arc<dyn Communicator>,
) -> Vec<u32> {
    cloud.subdomain = cloud.divided(communicator.clone());
    let horizon = |point: u32| setup.horizon.at_spacing(cloud.spacing[point as usize]);
    let is_near = cloud.near_owned(horizon);
    let points = (0..cloud.len() as u32).filter(|&it| is_near[it as usize]);
    points.collect()
}

/// All points of a meshed body, on ranks other than 0 without volumes and materials, and the part of this process.
fn of_first_process<const D: usize>(
    setup: &Setup,
    meshed: &dyn MeshedBody<D>,
    communicator: &Arc<dyn Communicator>,
) -> Result<(PointCloud<D>, Part<D>), SetupError> {
    let together = &**communicator;
    let whole = together.is_root().then(|| Whole::new(setup));
    let Some(mut whole) = agreed(together, whole)? else {
        let mut cloud = meshed.nodes(setup.thickness(), setup.materials.len());
        let spacing = receive(together, Way::ToAll, Vec::read);
        let spacing: Vec<f64> = spacing.map_err(unreadable)?;
        cloud.spacing = spacing.into();
        let near = near_points(setup, &mut cloud, communicator);
        together.all_gather_list(cloud.box_around(near.iter().copied()).to_vec());
        let (from, to) = (0, together.rank());
        let back = Way::Between { from: to, to: from };
        send(together, back, |out| near.write(out));
        let part = receive(together, Way::Between { from, to }, |it| {
            Part::read(meshed, it)
        });
        return Ok((cloud, part.map_err(unreadable)?));
    };
    let spacing = &whole.cloud.spacing;
    send(together, Way::ToAll, |out| serial::write(&**spacing, out));
    let near = near_points(setup, &mut whole.cloud, communicator);
    let own = whole.cloud.box_around(near.iter().copied());
    let boxes = together.all_gather_list(own.to_vec());
    let cutter = whole.cutter(boxes.as_chunks().0.to_vec());
    for rank in 1..together.size() {
        let way = Way::Between { from: rank, to: 0 };
        let near: Vec<u32> = receive(together, way, Vec::read).map_err(unreadable)?;
        let part = cutter.part(rank, &near);
        let way = Way::Between { from: 0, to: rank };
        send(together, way, |out| part.write(out));
    }
    let part = cutter.part(0, &near);
    Ok((cutter.into_cloud(), part))
}

/// The result of rank 0, `None` on other ranks; an error of rank 0 ends all processes. Collective.
fn agreed<T>(
    communicator: &dyn Communicator,
    found: Option<Result<T, SetupError>>,
) -> Result<Option<T>, SetupError> {
    let error = found.as_ref().and_then(|it| it.as_ref().err());
    let words = of_first(communicator, error.map(ToString::to_string));
    match (found, words.map_err(unreadable)?) {
        (Some(found), _) => found.map(Some),
        (None, None) => Ok(None),
        (None, Some(words)) => Err(refused(words)),
    }
}

/// The error of a message of rank 0 that cannot be read.
fn unreadable(error: Damaged) -> SetupError {
    refused(format!("its message cannot be read: {error}"))
}

fn refused(words: String) -> SetupError {
    Field::whole("body").error(Fault::OfFirstProcess(words))
}
