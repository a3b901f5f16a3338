//! Boxes along the axes.

use crate::setup::{Place, Position};

/// A box along the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    /// Lowest coordinates, m; zero beyond the dimensions of the body.
    pub(crate) lower: Position,
    /// Highest coordinates, m.
    pub(crate) upper: Position,
}

impl Extent {
    /// The box around some positions, enlarged on all sides by a distance `beyond`, m.
    pub(crate) fn around(positions: impl Iterator<Item = impl AsRef<[f64]>>, beyond: f64) -> Self {
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let mut bounds: Vec<[f64; 2]> = Vec::new();
        for position in positions {
            let position = position.as_ref();
            bounds.resize(position.len(), start);
            for ([lower, upper], value) in bounds.iter_mut().zip(position) {
                (*lower, *upper) = (lower.min(value - beyond), upper.max(value + beyond));
            }
        }
        let bound =
            |side: usize| std::array::from_fn(|axis| bounds.get(axis).map_or(0.0, |it| it[side]));
        Self {
            lower: bound(0),
            upper: bound(1),
        }
    }

    /// The box of a place, if it is one.
    pub(crate) fn of_place(place: &Place) -> Option<Self> {
        match *place {
            Place::Box([lower, upper]) => Some(Self { lower, upper }),
            Place::Everywhere | Place::Group(_) | Place::At(_) => None,
        }
    }

    /// The box as a place.
    pub(crate) fn into_place(self) -> Place {
        Place::Box([self.lower, self.upper])
    }

    /// Whether another box lies within this one.
    pub(crate) fn contains(&self, other: &Self) -> bool {
        let below = self
            .lower
            .iter()
            .zip(other.lower)
            .all(|(one, other)| *one <= other);
        below
            && self
                .upper
                .iter()
                .zip(other.upper)
                .all(|(one, other)| *one >= other)
    }

    /// The box around this one and another.
    fn with(&self, other: &Self) -> Self {
        Self {
            lower: std::array::from_fn(|axis| self.lower[axis].min(other.lower[axis])),
            upper: std::array::from_fn(|axis| self.upper[axis].max(other.upper[axis])),
        }
    }

    /// Area of a box in the plane, whose height is zero, or volume.
    fn size(&self) -> f64 {
        let sides = self
            .lower
            .iter()
            .zip(self.upper)
            .map(|(lower, upper)| upper - lower);
        sides.filter(|it| *it > 0.0).product()
    }

    /// Boxes, joined where the box around two of them is no larger than both together.
    pub(crate) fn joined(mut boxes: Vec<Self>) -> Vec<Self> {
        let mut place = 0;
        while place < boxes.len() {
            let one = boxes[place];
            let fits = |other: &Self| one.with(other).size() <= one.size() + other.size();
            match (place + 1..boxes.len()).find(|it| fits(&boxes[*it])) {
                Some(other) => {
                    boxes[place] = one.with(&boxes.remove(other));
                    place = 0;
                }
                None => place += 1,
            }
        }
        boxes
    }
}
