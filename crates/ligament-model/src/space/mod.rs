//! Bodies in space: what differs there from the plane.
//!
//! Points, bonds, horizons and corrections are those of [`cloud`](crate::cloud), [`bonds`](crate::bonds) and
//! [`correction`](crate::correction) with three coordinates. A bond in space has a
//! stretch s and two vectors, the shear gamma and the relative rotation dphi of its ends:
//!
//! s = n . du/l, gamma = P du/l - phi x n, dphi = phi_B - phi_A, E = 1/2 Omega alpha V_A V_B (k_n l s^2 + k_t l |gamma|^2 + k_theta |dphi|^2)
//!
//! with du = u_B - u_A, the mean rotation phi of the ends, the unit vector n from A to B and P = I - n n^T. Bending and torsion have one
//! rotational stiffness, so that no bond needs axes of its own. The equations and constants in space are our own, derived in
//! `docs/space.md`.
//!
//! | stage | module |
//! |---|---|
//! | failure criteria with their limits | [`criteria`] |

pub mod criteria;
