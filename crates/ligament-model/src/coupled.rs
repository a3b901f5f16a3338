//! Points that elements couple with each other.

use crate::bonds::Incidence;

/// Other points that elements couple with each point.
#[derive(Debug, Clone, Copy)]
pub struct CoupledPoints<'a> {
    pub(crate) lists: &'a Incidence,
    /// Ends of the bonds, where the lists contain bonds instead of points.
    pub(crate) ends: Option<&'a [[u32; 2]]>,
}

impl<'a> CoupledPoints<'a> {
    /// Points that elements couple with a point, ascending.
    pub fn at(self, point: u32) -> impl Iterator<Item = u32> + 'a {
        self.lists.at(point).iter().map(move |&entry| {
            self.ends.map_or(entry, |ends| {
                let [a, b] = ends[entry as usize];
                if a == point { b } else { a }
            })
        })
    }
}
