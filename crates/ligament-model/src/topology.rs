//! Points and bonds of a body and their connections, as arrays without coordinates.

use std::sync::Arc;

use ligament_mesh::Numbering;

use crate::bonds::Incidence;
use crate::element::{ElementKind, StiffnessFactors};
use crate::layout::Layout;
use crate::subdomain::Subdomain;

/// Points and bonds of a body on this process, as arrays over points and bonds that share their memory with the stages they come from.
#[derive(Debug, Clone)]
pub struct Topology {
    /// Positions of the motions of the points in arrays over degrees of freedom.
    pub layout: Layout,
    /// Numbering of the points, internal and in the file.
    pub numbering: Numbering,
    /// The points and bonds of the body on this process.
    pub subdomain: Subdomain,
    /// Volume of each point, shape (n_points), m^3.
    pub volumes: Arc<[f64]>,
    /// Distance of each point from its nearest neighbour, shape (n_points), m.
    pub spacing: Arc<[f64]>,
    /// Points A < B of each bond, shape (n_bonds).
    pub ends: Arc<[[u32; 2]]>,
    /// Horizon of each bond, shape (n_bonds), m.
    pub horizons: Arc<[f64]>,
    /// Weight of each bond in the damage of its ends, shape (n_bonds).
    pub weights: Arc<[f64]>,
    /// Kinematics of the bonds.
    pub element: ElementKind,
    /// Bonds of each point.
    pub incidence: Arc<Incidence>,
    /// Bonds whose elements couple each point, ascending; on the imaginary lattice these include bonds that do not end at the point.
    pub elements_at_points: Arc<Incidence>,
    /// Other points that elements couple with each point, including the far field and pairs of faces that may close.
    pub coupled_points: CoupledPoints,
    /// Points that elements of the far field, which never break, couple with each point; none without a far field.
    pub far_field: Option<CoupledPoints>,
    /// Whether cells have a stiffness against changes of volume.
    pub has_volumetric_cells: bool,
    /// Whether crack faces carry pressure where they close.
    pub faces_close: bool,
}

impl Topology {
    /// Number of points.
    pub fn n_points(&self) -> usize {
        self.layout.n_points
    }

    /// Numbers in the file of the ends of a bond, ascending, by which ties are broken.
    pub fn ends_in_file(&self, bond: u32) -> [u32; 2] {
        self.numbering.ends_in_file(self.ends[bond as usize])
    }

    /// Ends of the bonds and the points that bonds and elements of the far field connect.
    pub fn families(&self) -> Families<'_> {
        Families {
            ends: &self.ends,
            incidence: &self.incidence,
            far_field: self.far_field.as_ref(),
        }
    }
}

/// Unbroken bonds with their remaining stiffness.
#[derive(Debug, Clone, Copy)]
pub struct UnbrokenBonds<'a> {
    /// For each bond, whether it is unbroken, shape (n_bonds).
    pub intact: &'a [bool],
    /// Remaining stiffness, shape (n_bonds); empty where it is whole.
    pub remaining: &'a [StiffnessFactors],
}

impl<'a> UnbrokenBonds<'a> {
    /// Unbroken bonds (n_bonds) with their whole stiffness.
    pub fn whole(intact: &'a [bool]) -> Self {
        Self {
            intact,
            remaining: &[],
        }
    }
}

/// Points that bonds and elements of the far field connect.
#[derive(Debug, Clone, Copy)]
pub struct Families<'a> {
    /// Points A < B of each bond, shape (n_bonds).
    pub ends: &'a [[u32; 2]],
    /// Bonds of each point.
    pub incidence: &'a Incidence,
    /// Points that elements of the far field, which never break, couple with each point.
    pub far_field: Option<&'a CoupledPoints>,
}

impl<'a> Families<'a> {
    /// Points that bonds marked in `intact` (n_bonds), or elements of the far field, connect with a point.
    pub fn connected(self, point: u32, intact: &[bool]) -> impl Iterator<Item = u32> {
        let bonds = self.incidence.at(point).iter();
        let intact = bonds.filter(|bond| intact[**bond as usize]);
        let by_bonds = intact.map(move |&bond| self.neighbour(bond, point));
        let far_field = self.far_field.into_iter();
        by_bonds.chain(far_field.flat_map(move |far| far.at(point)))
    }

    /// The other end of a bond of `point`.
    pub fn neighbour(self, bond: u32, point: u32) -> u32 {
        let [a, b] = self.ends[bond as usize];
        if a == point { b } else { a }
    }
}

/// Other points that elements couple with each point.
#[derive(Debug, Clone)]
pub struct CoupledPoints {
    lists: Arc<Incidence>,
    /// Ends of the bonds, where the lists contain bonds instead of points.
    ends: Option<Arc<[[u32; 2]]>>,
}

impl CoupledPoints {
    /// Points from a list of each point.
    pub(crate) fn from_lists(lists: &Arc<Incidence>) -> Self {
        Self {
            lists: lists.clone(),
            ends: None,
        }
    }

    /// The other ends of the bonds of each point.
    pub(crate) fn from_bonds(ends: &Arc<[[u32; 2]]>, incidence: &Arc<Incidence>) -> Self {
        Self {
            lists: incidence.clone(),
            ends: Some(ends.clone()),
        }
    }

    /// Points that elements couple with a point, ascending.
    pub fn at(&self, point: u32) -> impl Iterator<Item = u32> + use<'_> {
        let ends = self.ends.as_deref();
        self.lists.at(point).iter().map(move |&entry| {
            ends.map_or(entry, |ends| {
                let [a, b] = ends[entry as usize];
                if a == point { b } else { a }
            })
        })
    }

    /// Whether points are coupled by bonds to their other ends alone.
    pub fn are_ends_of_bonds(&self) -> bool {
        self.ends.is_some()
    }
}
