//! Connected parts of a body whose points belong to several processes, as all of these know them.

use super::ElementSystem;
use crate::element::Element;
use crate::interface::FreeShapes;
use crate::layout::Layout;
use crate::rigid_motions::{FreeMotion, RigidMotions, Turn};

/// Values at a degree of freedom of a part.
#[derive(Debug, Clone, Copy)]
struct Given {
    /// Whether the degree of freedom is fixed.
    is_fixed: bool,
    /// Whether a support can be added.
    can_hold: bool,
    /// Force on the degree of freedom, N or N m.
    force: f64,
}

/// Points of a part with the values at their degrees of freedom, in the order of their numbers in the body.
pub(super) struct Part<const D: usize> {
    layout: Layout,
    turn: Turn,
    /// Number of each point in the body, shape (n_points).
    numbers: Vec<u32>,
    /// Points in the order of the file.
    in_file: Vec<u32>,
    positions: Vec<[f64; D]>,
    /// Values, shape (n_degrees_of_freedom).
    given: Vec<Given>,
}

impl<const D: usize, const M: usize, E: Element<D, M>> ElementSystem<D, M, E> {
    /// A part with some points on this process, or none where its fixed degrees of freedom prevent all rigid motions: several processes then exchange no other points. Collective.
    pub(super) fn free_part(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        can_hold: &dyn Fn(usize) -> bool,
    ) -> Option<Part<D>> {
        let resisting = self.resisting(is_fixed);
        let given = &|dof| Given {
            is_fixed: resisting(dof),
            can_hold: can_hold(dof),
            force: 0.0,
        };
        let turn = self.turn(points);
        if !self.topology.subdomain.is_whole() {
            let layout = self.topology.layout;
            let has_fixed = |point: &u32| layout.range(*point).any(|dof| given(dof).is_fixed);
            let fixed: Vec<u32> = points.iter().copied().filter(has_fixed).collect();
            let of_fixed = self.part(&fixed, turn, given);
            if of_fixed.shapes().motions.is_empty() {
                return None;
            }
        }
        Some(self.part(points, turn, given))
    }

    /// A part with some points on this process, with the forces on it; collective.
    pub(super) fn part_with_forces(
        &self,
        points: &[u32],
        is_fixed: &dyn Fn(usize) -> bool,
        force: &dyn Fn(usize) -> f64,
    ) -> Part<D> {
        let resisting = self.resisting(is_fixed);
        let given = |dof| Given {
            is_fixed: resisting(dof),
            can_hold: false,
            force: force(dof),
        };
        self.part(points, self.turn(points), &given)
    }

    /// A part with some points on this process, with values at their degrees of freedom; collective.
    fn part(&self, points: &[u32], turn: Turn, given: &dyn Fn(usize) -> Given) -> Part<D> {
        let (cloud, layout) = (&self.system.cloud, self.topology.layout);
        let row = |&point: &u32| {
            let at_point = layout.range(point).flat_map(|dof| {
                let Given {
                    is_fixed,
                    can_hold,
                    force,
                } = given(dof);
                [
                    f64::from(u8::from(is_fixed)),
                    f64::from(u8::from(can_hold)),
                    force,
                ]
            });
            let numbers = [
                cloud.subdomain.number(point),
                cloud.numbering.in_file(point),
            ];
            let numbers = numbers.map(f64::from).into_iter();
            let position = cloud.positions[point as usize];
            numbers
                .chain(position)
                .chain(at_point)
                .collect::<Vec<f64>>()
        };
        let rows: Vec<f64> = points.iter().flat_map(row).collect();
        let rows = cloud.subdomain.all_gather_list(rows);
        let mut rows: Vec<&[f64]> = rows.chunks_exact(2 + D + 3 * M).collect();
        rows.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
        let mut in_file: Vec<u32> = (0..rows.len() as u32).collect();
        in_file.sort_unstable_by(|&one, &other| {
            rows[one as usize][1].total_cmp(&rows[other as usize][1])
        });
        let at_point = rows.iter().flat_map(|row| row[2 + D..].as_chunks().0);
        Part {
            layout: Layout {
                n_points: rows.len(),
                ..layout
            },
            turn,
            numbers: rows.iter().map(|row| row[0] as u32).collect(),
            in_file,
            positions: (rows.iter())
                .map(|row| std::array::from_fn(|axis| row[2 + axis]))
                .collect(),
            given: at_point
                .map(|&[is_fixed, can_hold, force]| Given {
                    is_fixed: is_fixed > 0.0,
                    can_hold: can_hold > 0.0,
                    force,
                })
                .collect(),
        }
    }
}

impl<const D: usize> Part<D> {
    fn points(&self) -> Vec<u32> {
        (0..self.layout.n_points as u32).collect()
    }

    fn motions(&self, points: &[u32]) -> RigidMotions<'_, D> {
        RigidMotions::new(self.layout, &self.positions, points, self.turn)
    }

    /// Number in the body of a degree of freedom of the part.
    fn in_body(&self, degree_of_freedom: usize) -> usize {
        let n = self.layout.components.len();
        let number = self.numbers[degree_of_freedom / n] as usize;
        n * number + degree_of_freedom % n
    }

    /// Degrees of freedom of the body to fix so that no rigid motion is free.
    pub(super) fn holds(&self) -> Vec<usize> {
        let motions = self.motions(&self.in_file);
        let given = |dof: usize| self.given[dof];
        let holds = motions.holds(
            &self.in_file,
            |it| given(it).is_fixed,
            |it| given(it).can_hold,
        );
        holds.into_iter().map(|dof| self.in_body(dof)).collect()
    }

    /// Displacements and rotations in each free rigid motion.
    pub(super) fn shapes(&self) -> FreeShapes {
        let points = self.points();
        let shapes = self
            .motions(&points)
            .free_shapes(&points, |it| self.given[it].is_fixed);
        FreeShapes {
            degrees_of_freedom: (0..self.given.len()).map(|it| self.in_body(it)).collect(),
            can_hold: self.given.iter().map(|it| it.can_hold).collect(),
            motions: shapes,
        }
    }

    /// Free rigid motions with the work of the forces.
    pub(super) fn free_motions(&self) -> Vec<FreeMotion> {
        let points = self.points();
        let given = |dof: usize| self.given[dof];
        let motions = self.motions(&points);
        motions.free_motions(&points, |it| given(it).is_fixed, |it| given(it).force)
    }
}
