//! Deformations of all bonds of a body.
//!
//! A bond in the plane has at most three strains, which criteria measure. One in space has a stretch and two vectors, whose lengths criteria
//! measure: the lengths are stored beside the vectors, so that criteria read the same array in the plane and in space.

use std::fmt;
use std::ops::Deref;
use std::sync::{Arc, Mutex};

use crate::element::bond_deformation::BondDeformation;
use crate::parallel::{self, CHUNK};
use crate::tensor::{minus, norm};

/// Deformation of a bond in space between the points A and B, with the unit vector n from A to B and the projection P = I - n n^T.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpaceDeformation {
    /// Stretch s = n . (u_B - u_A)/l.
    pub stretch: f64,
    /// Shear gamma = P (u_B - u_A)/l - 1/2 (phi_A + phi_B) x n, orthogonal to n, rad.
    pub shear: [f64; 3],
    /// Relative rotation phi_B - phi_A of the ends, rad.
    pub rotation: [f64; 3],
}

/// Deformation of a bond in the type of its element, from which the strains of the criteria follow.
pub trait Deformation: Copy + Default + PartialEq + fmt::Debug + Send + Sync + 'static {
    /// The deformation times a factor.
    fn scaled(&self, factor: f64) -> Self;

    /// The deformation minus another one.
    fn less(&self, other: &Self) -> Self;

    /// Strains that criteria measure.
    fn measured(&self) -> BondDeformation;

    /// A deformation with given strains of the criteria; energies do not depend on its directions.
    fn with_measures(measured: &BondDeformation) -> Self;

    /// Deformations of all bonds, shape (n_bonds).
    fn of_bonds(deformations: &Deformations) -> &[Self];

    /// Deformations of `n_bonds` bonds, filled by a function that must write every bond.
    fn written(
        room: &DeformationPool,
        n_bonds: usize,
        write: impl FnOnce(&mut [Self]),
    ) -> Deformations;
}

impl Deformation for BondDeformation {
    #[inline(always)]
    fn scaled(&self, factor: f64) -> Self {
        self.scaled(factor)
    }

    #[inline(always)]
    fn less(&self, other: &Self) -> Self {
        self.less(other)
    }

    #[inline(always)]
    fn measured(&self) -> BondDeformation {
        *self
    }

    fn with_measures(measured: &BondDeformation) -> Self {
        *measured
    }

    #[inline(always)]
    fn of_bonds(deformations: &Deformations) -> &[Self] {
        deformations.measured()
    }

    fn written(
        room: &DeformationPool,
        n_bonds: usize,
        write: impl FnOnce(&mut [Self]),
    ) -> Deformations {
        let mut measured = room.with_arbitrary_values(n_bonds, |it| &mut it.measured);
        write(&mut measured);
        Deformations {
            measured,
            in_space: Vec::new(),
            motions: Vec::new(),
            volume_changes: Vec::new(),
            room: room.clone(),
        }
    }
}

impl Deformation for SpaceDeformation {
    #[inline]
    fn scaled(&self, factor: f64) -> Self {
        Self {
            stretch: factor * self.stretch,
            shear: self.shear.map(|strain| factor * strain),
            rotation: self.rotation.map(|strain| factor * strain),
        }
    }

    #[inline]
    fn less(&self, other: &Self) -> Self {
        Self {
            stretch: self.stretch - other.stretch,
            shear: minus(self.shear, other.shear),
            rotation: minus(self.rotation, other.rotation),
        }
    }

    /// Stretch s, |gamma| and the size of the relative rotation.
    #[inline]
    fn measured(&self) -> BondDeformation {
        BondDeformation::new([self.stretch, norm(self.shear), norm(self.rotation)])
    }

    fn with_measures(measured: &BondDeformation) -> Self {
        Self {
            stretch: measured.stretch(),
            shear: [measured.shear(), 0.0, 0.0],
            rotation: [measured.rotation(), 0.0, 0.0],
        }
    }

    #[inline(always)]
    fn of_bonds(deformations: &Deformations) -> &[Self] {
        &deformations.in_space
    }

    fn written(
        room: &DeformationPool,
        n_bonds: usize,
        write: impl FnOnce(&mut [Self]),
    ) -> Deformations {
        let mut in_space = room.with_arbitrary_values(n_bonds, |it| &mut it.in_space);
        write(&mut in_space);
        let mut measured = room.with_arbitrary_values(n_bonds, |it| &mut it.measured);
        fill(&mut measured, &in_space, |from| from.measured());
        Deformations {
            measured,
            in_space,
            motions: Vec::new(),
            volume_changes: Vec::new(),
            room: room.clone(),
        }
    }
}

/// Reusable memory of deformations for the next sweeps, common to all clones.
///
/// Fresh memory of a large body comes from the operating system, which clears it page by page, and is returned to it: a quarter of the time
/// of a sweep.
#[derive(Clone, Default)]
pub struct DeformationPool(Arc<Mutex<Spare>>);

impl fmt::Debug for DeformationPool {
    /// Prints the type only: the spare memory belongs to no system.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("DeformationPool")
    }
}

/// Largest number of arrays kept: a sweep writes one while the previous one is in use.
const SPARE: usize = 2;

#[derive(Default)]
struct Spare {
    measured: Vec<Vec<BondDeformation>>,
    in_space: Vec<Vec<SpaceDeformation>>,
}

impl DeformationPool {
    /// An array of `n_bonds` deformations with arbitrary values.
    fn with_arbitrary_values<T: Clone + Default>(
        &self,
        n_bonds: usize,
        of: impl Fn(&mut Spare) -> &mut Vec<Vec<T>>,
    ) -> Vec<T> {
        let spare = self.0.lock().ok().and_then(|mut it| of(&mut it).pop());
        let mut array = spare.unwrap_or_default();
        if array.len() != n_bonds {
            array = vec![T::default(); n_bonds];
        }
        array
    }
}

/// Deformations of all bonds; dereferences to the strains of the criteria, shape (n_bonds).
#[derive(Debug, Clone, Default)]
pub struct Deformations {
    measured: Vec<BondDeformation>,
    /// Deformations of bonds in space, shape (n_bonds); empty in the plane.
    in_space: Vec<SpaceDeformation>,
    /// Motions of the points that deform the elements of the far field, shape (n_degrees_of_freedom); empty without a far field.
    motions: Vec<f64>,
    /// Changes of the volumes of cells with a volumetric stiffness less those by temperature, shape (n_cells), m^3; empty without such cells.
    volume_changes: Vec<f64>,
    /// Memory pool to which the arrays return.
    room: DeformationPool,
}

impl Drop for Deformations {
    fn drop(&mut self) {
        let Ok(mut spare) = self.room.0.lock() else {
            return;
        };
        keep(&mut spare.measured, std::mem::take(&mut self.measured));
        keep(&mut spare.in_space, std::mem::take(&mut self.in_space));
    }
}

fn keep<T>(spare: &mut Vec<Vec<T>>, array: Vec<T>) {
    if spare.len() < SPARE && !array.is_empty() {
        spare.push(array);
    }
}

impl PartialEq for Deformations {
    fn eq(&self, other: &Self) -> bool {
        self.measured == other.measured
            && self.in_space == other.in_space
            && self.motions == other.motions
            && self.volume_changes == other.volume_changes
    }
}

impl Deformations {
    /// Strains that criteria measure, shape (n_bonds).
    #[inline]
    pub fn measured(&self) -> &[BondDeformation] {
        &self.measured
    }

    /// The deformations with the motions of the points (n_degrees_of_freedom), which deform the elements of the far field.
    pub(crate) fn with_motions(mut self, motions: Vec<f64>) -> Self {
        self.motions = motions;
        self
    }

    /// Motions of the points that deform the elements of the far field, shape (n_degrees_of_freedom).
    pub(crate) fn motions(&self) -> &[f64] {
        &self.motions
    }

    /// The deformations with the changes of the volumes of cells (n_cells), m^3.
    pub(crate) fn with_volume_changes(mut self, volume_changes: Vec<f64>) -> Self {
        self.volume_changes = volume_changes;
        self
    }

    /// Changes of the volumes of cells with a volumetric stiffness less those by temperature, shape (n_cells), m^3.
    pub(crate) fn volume_changes(&self) -> &[f64] {
        &self.volume_changes
    }

    /// All deformations times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let of_bonds = match self.in_space.is_empty() {
            true => scaled::<BondDeformation>(self, factor),
            false => scaled::<SpaceDeformation>(self, factor),
        };
        let scaled = |values: &[f64]| values.iter().map(|it| factor * it).collect();
        (of_bonds.with_motions(scaled(&self.motions)))
            .with_volume_changes(scaled(&self.volume_changes))
    }

    /// The sum of the deformations and `by` times their slopes (n_bonds).
    pub fn ahead(&self, slopes: &Self, by: f64) -> Self {
        let of_bonds = match self.in_space.is_empty() {
            true => ahead::<BondDeformation>(self, slopes, by),
            false => ahead::<SpaceDeformation>(self, slopes, by),
        };
        let ahead = |values: &[f64], slopes: &[f64]| {
            let both = values.iter().zip(slopes);
            both.map(|(value, slope)| value + by * slope).collect()
        };
        (of_bonds.with_motions(ahead(&self.motions, &slopes.motions)))
            .with_volume_changes(ahead(&self.volume_changes, &slopes.volume_changes))
    }
}

/// Fills an array with the values of a function of another of the same shape.
fn fill<T: Send, F: Sync>(all: &mut [T], of: &[F], value: impl Fn(&F) -> T + Sync) {
    parallel::for_each(all.chunks_mut(CHUNK).zip(of.chunks(CHUNK)), |(to, from)| {
        (to.iter_mut().zip(from)).for_each(|(to, from)| *to = value(from));
    });
}

fn scaled<B: Deformation>(all: &Deformations, factor: f64) -> Deformations {
    B::written(&all.room, all.len(), |to| {
        fill(to, B::of_bonds(all), |from| from.scaled(factor));
    })
}

fn ahead<B: Deformation>(all: &Deformations, slopes: &Deformations, by: f64) -> Deformations {
    let (values, slopes) = (B::of_bonds(all), B::of_bonds(slopes));
    B::written(&all.room, all.len(), |to| {
        let tasks = values.chunks(CHUNK).zip(slopes.chunks(CHUNK));
        parallel::for_each(to.chunks_mut(CHUNK).zip(tasks), |(to, (values, slopes))| {
            for (to, (value, slope)) in to.iter_mut().zip(values.iter().zip(slopes)) {
                *to = value.less(&slope.scaled(-by));
            }
        });
    })
}

impl Deref for Deformations {
    type Target = [BondDeformation];

    fn deref(&self) -> &[BondDeformation] {
        &self.measured
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths of sums are no sums of lengths: what criteria measure ahead on a line comes from the vectors.
    #[test]
    fn a_line_in_space_is_one_of_vectors() {
        let deformation = |stretch, x, y| SpaceDeformation {
            stretch,
            shear: [x, y, 0.0],
            rotation: [0.0, y, x],
        };
        let room = DeformationPool::default();
        let start = SpaceDeformation::written(&room, 1, |all| all[0] = deformation(1.0, 3.0, 0.0));
        let slopes =
            SpaceDeformation::written(&room, 1, |all| all[0] = deformation(-1.0, 0.0, 2.0));
        let ahead = start.ahead(&slopes, 2.0);
        assert_eq!(ahead[0], BondDeformation::new([-1.0, 5.0, 5.0]));
        assert_eq!(
            ahead.scaled(-2.0)[0],
            BondDeformation::new([2.0, 10.0, 10.0])
        );
        assert_eq!(
            SpaceDeformation::of_bonds(&ahead)[0],
            deformation(-1.0, 3.0, 4.0)
        );
    }

    /// Deformations are written into the memory of those that are gone, and never into that of others of another number.
    #[test]
    fn memory_is_used_again() {
        let room = DeformationPool::default();
        let written = |n_bonds: usize, size: f64| {
            BondDeformation::written(&room, n_bonds, |all| {
                all.fill(BondDeformation::new([size, 0.0, 0.0]));
            })
        };
        let (first, second) = (written(3, 1.0), written(3, 2.0));
        let place = first.as_ptr();
        drop(first);
        let third = second.scaled(2.0);
        assert_eq!(third.as_ptr(), place);
        assert_eq!(third[2], BondDeformation::new([4.0, 0.0, 0.0]));
        drop(third);
        assert_eq!(written(5, 3.0).len(), 5);
        assert_eq!(second[0], BondDeformation::new([2.0, 0.0, 0.0]));
    }
}
