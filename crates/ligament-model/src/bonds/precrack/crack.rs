//! Pre-cracks of any dimension.

use super::plane::PreCrack;
use super::solid::SolidPreCrack;
use super::{Crossing, Cut};

/// A pre-crack of a body in the plane or in space.
#[derive(Debug, Clone)]
pub enum Crack {
    /// A polyline in the plane.
    Line(PreCrack),
    /// A surface in space.
    Surface(SolidPreCrack),
}

/// A position with E coordinates, zero beyond the first D.
fn resized<const D: usize, const E: usize>(position: [f64; D]) -> [f64; E] {
    std::array::from_fn(|axis| position.get(axis).copied().unwrap_or(0.0))
}

impl<const D: usize> Cut<D> for Crack {
    fn moved(&self, by: impl Fn([f64; D]) -> [f64; D]) -> Self {
        match self {
            Self::Line(line) => Self::Line(line.moved(|it| resized(by(resized(it))))),
            Self::Surface(it) => Self::Surface(it.moved(|it| resized(by(resized(it))))),
        }
    }

    fn n_pieces(&self) -> u32 {
        match self {
            Self::Line(line) => line.n_pieces(),
            Self::Surface(surface) => surface.n_pieces(),
        }
    }

    fn bounds(&self, piece: u32) -> [[f64; D]; 2] {
        match self {
            Self::Line(line) => line.bounds(piece).map(resized),
            Self::Surface(surface) => surface.bounds(piece).map(resized),
        }
    }

    fn cuts(&self, piece: u32, bond: [[f64; D]; 2], slack: f64) -> bool {
        match self {
            Self::Line(line) => line.cuts(piece, bond.map(resized), slack),
            Self::Surface(surface) => surface.cuts(piece, bond.map(resized), slack),
        }
    }

    fn touches(&self, piece: u32, bond: [[f64; D]; 2], slack: f64) -> bool {
        match self {
            Self::Line(line) => line.touches(piece, bond.map(resized), slack),
            Self::Surface(surface) => surface.touches(piece, bond.map(resized), slack),
        }
    }

    fn crossing(&self, piece: u32, bond: [[f64; D]; 2]) -> Crossing<D> {
        match self {
            Self::Line(line) => line.crossing(piece, bond.map(resized)).resized(),
            Self::Surface(surface) => surface.crossing(piece, bond.map(resized)).resized(),
        }
    }
}

impl<const D: usize> Crossing<D> {
    fn resized<const E: usize>(self) -> Crossing<E> {
        Crossing {
            normal: resized(self.normal),
            depth: self.depth,
        }
    }
}
