//! A body in the plane or in space.

use std::any::Any;
use std::ops::Deref;
use std::sync::Arc;

use ligament_analysis::messages::{Way, receive, send};
use ligament_analysis::serial::{Damaged, Serial, Sink};
use ligament_mesh::AnyMesh;
use ligament_model::communicator::Communicator;
use ligament_model::dimension::cast;

use super::interface::{Body, Geometry};
use super::lattice::{LatticeBody, SolidLatticeBody};
use super::mesh::{MeshBody, SolidMeshBody};
use super::points::Points;

/// A body in the plane or in space.
#[derive(Debug, Clone)]
pub enum AnyBody {
    /// A body in the plane.
    Plane(Arc<dyn Geometry<2>>),
    /// A solid.
    Solid(Arc<dyn Geometry<3>>),
}

impl AnyBody {
    /// A body of D dimensions behind a shared pointer.
    ///
    /// # Panics
    ///
    /// Panics for other dimensions than 2 and 3.
    pub fn shared<const D: usize>(body: Arc<dyn Geometry<D>>) -> Self {
        let plane = cast(body.clone()).map(Self::Plane);
        let any = plane.or_else(|| cast(body).map(Self::Solid));
        any.expect("bodies have two or three dimensions")
    }

    /// Number of dimensions.
    pub fn dimensions(&self) -> usize {
        match self {
            Self::Plane(_) => 2,
            Self::Solid(_) => 3,
        }
    }

    /// The body without its dimension.
    pub fn as_body(&self) -> Arc<dyn Body> {
        match self {
            Self::Plane(body) => body.clone(),
            Self::Solid(body) => body.clone(),
        }
    }

    /// The meshed body of rank 0; other ranks get its nodes without cells, or `None` where rank 0 has no meshed body. Collective.
    ///
    /// # Errors
    ///
    /// If received bytes encode no body.
    pub fn of_first(
        communicator: &dyn Communicator,
        own: Option<Self>,
    ) -> Result<Option<Self>, Damaged> {
        if communicator.is_root() {
            let dimensions = own.as_ref().map(|it| it.dimensions() as u8);
            send(communicator, Way::ToAll, |out| {
                dimensions.write(out);
                match &own {
                    Some(Self::Plane(body)) => write_nodes(&**body, out),
                    Some(Self::Solid(body)) => write_nodes(&**body, out),
                    None => {}
                }
            });
            return Ok(own);
        }
        receive(communicator, Way::ToAll, |from| {
            let body = match Option::<u8>::read(from)? {
                Some(2) => MeshBody::read(from)?.into(),
                Some(_) => SolidMeshBody::read(from)?.into(),
                None => return Ok(None),
            };
            Ok(Some(body))
        })
    }

    /// The geometry of a body of D dimensions.
    ///
    /// # Panics
    ///
    /// Panics if the body has another number of dimensions.
    pub fn geometry<const D: usize>(&self) -> &Arc<dyn Geometry<D>> {
        let body: &dyn Any = match self {
            Self::Plane(body) => body,
            Self::Solid(body) => body,
        };
        body.downcast_ref()
            .expect("code over D is called for bodies of D dimensions")
    }
}

/// Conversions of each kind of body, compiled only in this crate, because each of them compiles all functions of the body's geometry.
macro_rules! from_bodies {
    ($($variant:ident: $($body:ty),*;)*) => {$($(
        impl From<$body> for AnyBody {
            #[inline(never)]
            fn from(body: $body) -> Self {
                Self::$variant(Arc::new(body))
            }
        }
    )*)*};
}

from_bodies! {
    Plane: MeshBody, LatticeBody, Points<2>;
    Solid: SolidMeshBody, SolidLatticeBody, Points<3>;
}

impl From<AnyMesh> for AnyBody {
    fn from(mesh: AnyMesh) -> Self {
        match mesh {
            AnyMesh::Plane(mesh) => MeshBody::from(mesh).into(),
            AnyMesh::Solid(mesh) => SolidMeshBody::from(mesh).into(),
        }
    }
}

impl Deref for AnyBody {
    type Target = dyn Body;

    fn deref(&self) -> &Self::Target {
        match self {
            Self::Plane(body) => &**body,
            Self::Solid(body) => &**body,
        }
    }
}

/// Appends the bytes of the nodes of a meshed body.
fn write_nodes<const D: usize>(body: &dyn Geometry<D>, out: &mut dyn Sink) {
    if let Some(meshed) = body.meshed() {
        meshed.write_nodes(out);
    }
}
