//! Stiffness against changes of volume that bonds cannot have, carried by the cells of the body.
//!
//! Bonds between pairs of points have the Poisson's ratio nu_l of central forces, 1/4, in plane stress 1/3. A material with a larger ratio is
//! split ([`VolumetricSplit`](crate::material::VolumetricSplit)): bonds have its shear modulus at the ratio nu_l, and the rest of its
//! stiffness, kappa = lambda' - mu times the square of the dilatation, belongs to the cells. As the average nodal pressure of finite elements
//! (Bonet and Burton 1998, Commun. Numer. Meth. Engng 14, 437) the dilatation is averaged over the cells around a point, so that nearly
//! incompressible bodies do not lock; the split is that of ordinary state-based bodies (Silling et al. 2007). With the mean dilatation of a
//! cell c of the volume V_c and of m_c corners a, and the shape functions N_a,
//!
//! theta_c = 1/V_c sum over a of G_ca . u_a, G_ca = integral of grad N_a over c,
//!
//! the energy of a body is the sum over the points P
//!
//! W = sum kappa w_P theta_P^2/2, w_P = sum over c at P of f_c V_c/m_c, theta_P = sum over c at P of (f_c V_c/m_c) theta_c / w_P.
//!
//! In a uniform strain these are exactly the consistent forces of a mesh, whatever its cells. f_c is the smallest share of its stiffness that
//! a bond along an edge of the cell still has: 0 as soon as one of them is broken, or cut by a pre-crack. Cells that died at two broken edges
//! would bridge a crack. Each point adds one term of rank one to the stiffness, kappa w_P t t^T with the row t of theta_P = t . u; around a
//! point with several materials each has a term of its own, its cells alone.

mod cells;
mod change;
mod patches;

pub use cells::VolumetricCells;
pub(crate) use change::ChangedPatch;
pub(crate) use patches::VolumetricStress;
pub use patches::{CellPatch, VolumetricTerms};
