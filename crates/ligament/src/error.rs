//! Errors of a setup: field, fault and remedy.

use std::borrow::Cow;
use std::fmt;

use ligament_analysis::Message;
use ligament_analysis::modal::ModalError;
use ligament_model::Advice;
use ligament_model::failure::{NoLimit, Unfit};
use rayon::ThreadPoolBuildError;
use thiserror::Error;

use crate::body::OffOutline;
use crate::coordinates::coordinates;
use crate::setup::setting::Setting;
use crate::suggestion::hint;

/// Error that prevents a computation from starting. The end of a computation that started is in its outcome.
#[derive(Debug, Error)]
pub enum Error {
    /// A field of the setup is wrong.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The equations of a loading cannot be set up.
    #[error(transparent)]
    Equations(#[from] ligament_analysis::SetupError),
    /// The equations of natural modes cannot be set up or solved.
    #[error(transparent)]
    Modes(#[from] ModalError),
    /// The threads could not be started.
    #[error(transparent)]
    Threads(#[from] ThreadPoolBuildError),
}

/// The error of a field of a setup that is wrong.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{field}: {fault}")]
pub struct SetupError {
    /// Path of the field in the setup.
    pub field: Field,
    /// Fault of the field, with advice.
    pub fault: Box<Fault>,
}

/// Path of a field of [`Setup`](crate::Setup): `loads[1].place`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Field {
    /// Name of the field: `loads`.
    pub name: &'static str,
    /// Index of the element, where the field is a list.
    pub index: Option<usize>,
    /// Part of the field or of its element: `place`.
    pub part: Option<&'static str>,
    /// Key of the part, where the part has several.
    pub key: Option<&'static str>,
}

/// Fault of a field of a setup.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Fault {
    /// A name that the body does not have.
    #[error(
        "no {what} is called `{found}`{}",
        hint(found, candidates, "there are", '`')
    )]
    UnknownName {
        /// Kind of the named object, and its place: `physical group in the mesh`.
        what: &'static str,
        /// The name as given.
        found: String,
        /// Names that exist.
        candidates: Vec<String>,
    },
    /// A value outside of its range.
    #[error("must be {expected}, found {found}")]
    OutOfRange {
        /// Description of the condition.
        expected: Cow<'static, str>,
        /// The value as given.
        found: String,
    },
    /// A name that is given twice.
    #[error("`{name}` is already the name of {first}: give one of the two another name")]
    NameTwice {
        /// The name.
        name: String,
        /// The field that has the name first.
        first: Field,
    },
    /// A property of a material that another field needs and that is missing.
    #[error("missing {property}: it is required {reason}")]
    Missing {
        /// The field of the material: `density`.
        property: &'static str,
        /// The setting that needs the property.
        reason: String,
    },
    /// A criterion that contradicts itself, a material or the analysis.
    #[error(transparent)]
    Unfit(Box<Unfit>),
    /// A criterion that leaves bonds without a limit, or without energy for softening after the limit.
    #[error("{reason}{}", cause.as_ref().map_or(String::new(), |it| format!(". {it}")))]
    NoLimit {
        /// Reason why there is no limit.
        reason: NoLimit,
        /// Message about an implausible constant of a material that may be the cause.
        cause: Option<Box<Message>>,
    },
    /// Points without a neighbour, which have no stiffness under any correction.
    #[error(
        "{count} of {n_points} points have no neighbour in their horizon (the first is {first}): enlarge the horizon, or remove these \
         points"
    )]
    LonePoints {
        /// Number of such points.
        count: usize,
        /// Number of points.
        n_points: usize,
        /// Description of the first of these points.
        first: String,
    },
    /// Two points that nearly coincide.
    #[error(
        "{} and {} are only {distance:.1e} m apart, where points are {size:.1e} m in size: their bond would be far stiffer than all others. \
         If they are one, merge them (`Coherence Mesh;`, or a larger Geometry.Tolerance); if they are the faces of a slit, move these apart",
        places[0], places[1]
    )]
    NearPoints {
        /// Descriptions of the two points.
        places: [String; 2],
        /// Distance between the two points, m.
        distance: f64,
        /// Side of a square with the area of the first point, m.
        size: f64,
    },
    /// A body with connected cells that its bonds do not connect.
    #[error(transparent)]
    Torn(Box<Torn>),
    /// A bond whose stiffness is not a finite number.
    #[error(
        "the stiffness of the bond from {} to {} is not a number: look for a size, thickness or stiffness that is out of all \
         proportion (SI units: m, Pa)", places[0], places[1]
    )]
    NoNumber {
        /// Descriptions of the bond's ends.
        places: [String; 2],
    },
    /// A factor of a correction that is not a finite number.
    #[error(
        "the surface correction failed: its factor for the bond from {} to {} is not a number. Its equations have no solution for cells \
         that are much longer than wide, or for sizes that change too steeply (the nearest neighbours of points are {:.1e} to {:.1e} m \
         away): take cells with about equal sides, or correction.surface = \"volume\"", places[0], places[1], spacing[0], spacing[1]
    )]
    NoCorrection {
        /// Descriptions of the bond's ends.
        places: [String; 2],
        /// Smallest and largest distance of a point of the body to its nearest neighbour, m.
        spacing: [f64; 2],
    },
    /// Bonds too stiff or too soft for their energies to be finite numbers.
    #[error(
        "the stiffest bond has {rigidity:.1e} J, and numbers end at 1e308 and 1e-308: look for a size, thickness or stiffness that \
         is out of all proportion (SI units: m, Pa)"
    )]
    OutOfNumbers {
        /// The largest axial rigidity, J.
        rigidity: f64,
    },
    /// A position that is not on the body.
    #[error(
        "({}) is not on the body: the nearest point, {nearest}, is {distance:.3e} m away",
        coordinates(position)
    )]
    OffBody {
        /// The position, m.
        position: Vec<f64>,
        /// Description of the nearest point.
        nearest: String,
        /// Distance from the nearest point, m.
        distance: f64,
    },
    /// A line that no bond crosses.
    #[error("no bond crosses this line, so the force through it would always be 0 N")]
    NothingCrossed,
    /// Parts of the near field that are too small for its border.
    #[error(
        "the parts of the near field are single cells, which its border leaves out: make them several horizons large"
    )]
    NoNearCells,
    /// A line through elements of the far field.
    #[error(
        "the line passes through elements of the far field, and the force through it is summed over bonds: enlarge the near field"
    )]
    ThroughElements,
    /// Cells of a mesh that overlap.
    #[error(
        "cells of the mesh overlap: its outline crosses itself between {from} and {to}. Bodies that touch share nodes: mesh them as one \
         geometry (`Coherence;`)"
    )]
    Overlap {
        /// Description of one end of an edge that a side of the outline crosses.
        from: String,
        /// Description of the edge's other end.
        to: String,
    },
    /// A rigid body that begins inside the body.
    #[error("begins {depth:.3e} m deep inside the body, at {place}: move it outside")]
    StartsInside {
        /// Depth, m.
        depth: f64,
        /// Description of the deepest point.
        place: String,
    },
    /// A rectangle without a point.
    #[error("there is no point of the body in this box")]
    EmptyBox,
    /// A part of the near field without a cell.
    #[error("no cell of the mesh has all its corners in this part: make it larger")]
    NoCellInside,
    /// A group of a material without cells.
    #[error(
        "`{group}` has no cells: a material needs a physical surface, of a solid a physical volume"
    )]
    NoCells {
        /// Name of the group.
        group: String,
    },
    /// A cell with two materials.
    #[error("cells of this material belong to material `{other}` as well")]
    CellsTwice {
        /// Name of the other material.
        other: String,
    },
    /// Cells without a material.
    #[error("{missing} of {n_cells} cells belong to the group of no material")]
    CellsWithout {
        /// Number of such cells.
        missing: usize,
        /// Number of cells.
        n_cells: usize,
    },
    /// Two prescribed values for a component of a point.
    #[error(
        "component {component} of {place} is prescribed twice: as {first:?} by an earlier support or load, as {second:?} here"
    )]
    PrescribedTwice {
        /// The component.
        component: &'static str,
        /// Description of the point.
        place: String,
        /// Value of the earlier support or load.
        first: f64,
        /// Value of this support or load.
        second: f64,
    },
    /// A motion of a point that two loads with different load factors prescribe.
    #[error(
        "component {component} of {place} is moved by load `{other}` as well, and each load follows a factor of its own: let one load move \
         it"
    )]
    MovedTwice {
        /// The component.
        component: &'static str,
        /// Description of the point.
        place: String,
        /// Name of the other load.
        other: String,
    },
    /// A setup without a load and without a change of temperature.
    #[error("there is no load and no change of temperature, so nothing would happen")]
    NothingHappens,
    /// A first load of zero.
    #[error(
        "the first load must be other than zero: it is the axis of the force-displacement curve"
    )]
    ZeroControl,
    /// A platen on points that all have one position across the load.
    #[error(
        "a platen tilts about points that lie beside each other across the load, and its group has {points} in one place: give a group \
         that is wider, or leave `tilts` out"
    )]
    NoPlaten {
        /// Number of points of the group.
        points: usize,
    },
    /// A load that is zero at all of its points.
    #[error("the load does nothing: its profile is zero at every point that it acts on")]
    ZeroProfile,
    /// A force per length on a group without a length.
    #[error(
        "a force per length needs a physical curve of a mesh, or rows or columns at a side of a lattice: this group has no length; a \
         surface of a solid takes a force per area"
    )]
    NoLength,
    /// A force per area on a group without an area.
    #[error(
        "a force per area needs a physical surface of a solid mesh, or cells at a side of a box: this group has no area"
    )]
    NoArea,
    /// A quiet edge on a group without an outline.
    #[error(
        "waves leave through a physical curve on the outline of a mesh, a physical surface of a solid, or cells of a lattice at a side or a \
         hole: this group has no part of the outline"
    )]
    NoQuietOutline,
    /// A pressure on a group without an outline.
    #[error(
        "a pressure needs a physical curve on the outline of a mesh, a physical surface of a solid, or cells of a lattice at a side or a \
         hole: this group has no part of the outline"
    )]
    NoOutline,
    /// A pressure on an edge inside of the body.
    #[error(transparent)]
    OffOutline(OffOutline),
    /// A couple on points without rotational stiffness.
    #[error(
        "the couple acts on {points} points that no bond keeps from turning (Poisson's ratio makes the shear stiffness of their \
         bonds zero, or the bonds have no rotations): apply it as a pair of forces"
    )]
    IdleCouple {
        /// Number of such points.
        points: usize,
    },
    /// Two samples of a value at a point.
    #[error("{place} has sample {first} already: sample {second} must go")]
    SampledTwice {
        /// Description of the point.
        place: String,
        /// Index of the first sample.
        first: usize,
        /// Index of the second sample.
        second: usize,
    },
    /// Points within the place of a table or a field that get no value from it.
    #[error("{points} points have no {what} (the first is {first}): {reason}")]
    NoValue {
        /// The value.
        what: &'static str,
        /// Number of such points.
        points: usize,
        /// Reason why the points get no value.
        reason: &'static str,
        /// Description of the first of these points.
        first: String,
    },
    /// A field of the mesh that does not exist or is not a scalar field at one time.
    #[error("{0}")]
    NoSuchField(String),
    /// A setup with another analysis than the requested one.
    #[error("the setup says {found}, but the call computes {wanted}: change one of the two")]
    OtherAnalysis {
        /// The analysis of the setup.
        found: &'static str,
        /// The requested analysis.
        wanted: &'static str,
    },
    /// A fault found by rank 0, which alone has the cells of a mesh, as text.
    #[error("the first process refuses it: {0}")]
    OfFirstProcess(String),
    /// Settings that contradict each other.
    #[error("{0}")]
    Contradiction(Advice<Setting>),
}

/// Error of a body with connected cells that its bonds do not connect, because sides of cells are longer than the horizon.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "the bonds connect {parts} separate parts, but the cells form {of_body}: from {} to {} the distance is {length:.4e} m (direction {}), \
     and their horizon is {horizon:.4e} m. Cells this long need {remedy}; for cells with equal sides a horizon factor of 3 is enough",
    places[0], places[1], direction(along)
)]
pub struct Torn {
    /// Number of parts that the bonds connect.
    pub parts: usize,
    /// Number of parts of the mesh.
    pub of_body: usize,
    /// Descriptions of the ends, in two parts, of a side of a cell.
    pub places: [String; 2],
    /// Direction of the side, without sign.
    pub along: Vec<f64>,
    /// Length of the side, m.
    pub length: f64,
    /// Horizon of the side's ends, m.
    pub horizon: f64,
    /// Description of the horizon that the side needs.
    pub remedy: String,
}

fn direction(cosines: &[f64]) -> String {
    let cosines = cosines.iter().map(|it| format!("{it:.2}"));
    cosines.collect::<Vec<_>>().join(", ")
}

impl Field {
    /// A field as a whole.
    pub const fn whole(name: &'static str) -> Self {
        Self {
            name,
            index: None,
            part: None,
            key: None,
        }
    }

    /// An element of a list.
    pub const fn element(name: &'static str, index: usize) -> Self {
        Self {
            name,
            index: Some(index),
            part: None,
            key: None,
        }
    }

    /// A part of this field.
    pub const fn part(self, part: &'static str) -> Self {
        Self {
            part: Some(part),
            ..self
        }
    }

    /// A key of this part of the field.
    pub const fn key(self, key: &'static str) -> Self {
        Self {
            key: Some(key),
            ..self
        }
    }

    /// The error of a fault of this field.
    pub(crate) fn error(self, fault: Fault) -> SetupError {
        SetupError {
            field: self,
            fault: Box::new(fault),
        }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name)?;
        if let Some(index) = self.index {
            write!(formatter, "[{index}]")?;
        }
        let mut below = self.part.iter().chain(&self.key);
        below.try_for_each(|it| write!(formatter, ".{it}"))
    }
}
