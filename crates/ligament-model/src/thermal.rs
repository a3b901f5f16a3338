//! Stress-free thermal strains.

use crate::tensor::SymTensor;

/// Stress-free strains of the points, without components out of the plane for a body in the plane.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StressFreeStrains {
    of_points: Vec<SymTensor<3>>,
}

impl StressFreeStrains {
    /// Strains of all points, shape (n_points).
    pub fn new<const D: usize>(strains: impl IntoIterator<Item = SymTensor<D>>) -> Self {
        Self {
            of_points: strains.into_iter().map(|it| it.resized()).collect(),
        }
    }

    /// Whether no point has a strain.
    pub fn is_empty(&self) -> bool {
        self.of_points.is_empty()
    }

    /// Strains of all points, shape (n_points); empty without thermal strains.
    pub fn of_points(&self) -> &[SymTensor<3>] {
        &self.of_points
    }

    /// The strains times a load factor.
    pub fn times(&self, load_factor: f64) -> ThermalStrain<'_> {
        ThermalStrain {
            of_points: &self.of_points,
            load_factor,
        }
    }
}

/// Stress-free thermal strains of the points at a load factor.
#[derive(Debug, Clone, Copy)]
pub struct ThermalStrain<'a> {
    of_points: &'a [SymTensor<3>],
    load_factor: f64,
}

impl ThermalStrain<'_> {
    /// Zero strain at all points.
    pub const NONE: Self = ThermalStrain {
        of_points: &[],
        load_factor: 0.0,
    };

    /// Whether no point has a strain.
    pub fn is_none(&self) -> bool {
        self.of_points.is_empty()
    }

    /// The strains at load factor 1.
    pub fn at_full_load(&self) -> Self {
        Self {
            load_factor: 1.0,
            ..*self
        }
    }

    /// Strain of a point.
    pub fn of_point(&self, point: usize) -> SymTensor<3> {
        self.of_points[point].scaled(self.load_factor)
    }

    /// Strain of a point in the space of its body; zero where no point has one.
    pub(crate) fn in_body<const D: usize>(&self, point: u32) -> SymTensor<D> {
        match self.is_none() {
            true => SymTensor::ZERO,
            false => self.of_point(point as usize).resized(),
        }
    }

    /// Mean strain of the ends of a bond.
    #[inline]
    pub fn of_bond<const D: usize>(&self, ends: [u32; 2]) -> SymTensor<D> {
        let [a, b] = ends.map(|end| &self.of_points[end as usize]);
        SymTensor::from_fn(|row, column| {
            self.load_factor * (0.5 * (a.at(row, column) + b.at(row, column)))
        })
    }
}
