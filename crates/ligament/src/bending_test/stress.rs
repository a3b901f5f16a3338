//! Stresses that are linear in the position.

/// A stress (Pa) or a strain.
pub(super) type Tensor<const D: usize> = [[f64; D]; D];

/// A stress that is linear in the position from the middle of a strip: its gradient along each coordinate, Pa/m.
pub(super) type LinearStress<const D: usize> = [Tensor<D>; D];
