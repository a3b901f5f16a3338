//! Advances of the tips of cracks from one state to a later one.

use super::faces::distance;
use super::lines::{CrackEnd, CrackLine};

impl CrackLine {
    /// Advances of the [tips](Self::tips) along the line since an earlier state with other tips, m, each with the index of the earlier tip, in the
    /// order of the tips.
    ///
    /// A tip comes from the earlier tip that is nearest along the line, among those at most `reach` (m) away from it. From a tip before the
    /// junction of a branch, the path goes straight to the junction, if that is not farther than `reach` or the branch is long. `None`
    /// for a tip of a new crack, which comes from no earlier tip.
    pub fn advances_of_tips(&self, earlier: &[[f64; 2]], reach: f64) -> Vec<Option<(usize, f64)>> {
        let backwards = || self.places.iter().rev().copied().collect();
        let from_tips: [&dyn Fn() -> Vec<[f64; 2]>; 2] = [&|| self.places.clone(), &backwards];
        let ends = self.ends.into_iter().zip(from_tips);
        let of_tips = ends.filter(|(end, _)| *end == CrackEnd::Tip);
        of_tips
            .map(|(_, places)| {
                let places = places();
                let numbered = earlier.iter().enumerate();
                let advances =
                    numbered.filter_map(|(k, it)| Some((k, advance(&places, *it, reach)?)));
                advances.min_by(|one, other| one.1.total_cmp(&other.1))
            })
            .collect()
    }
}

/// Distance from an earlier tip to the first of some places along the line through them, m.
fn advance(places: &[[f64; 2]], earlier: [f64; 2], reach: f64) -> Option<f64> {
    let mut along = 0.0;
    let mut nearest = (f64::INFINITY, 0.0);
    for pair in places.windows(2) {
        let length = distance(pair[0], pair[1]);
        let part = |from: [f64; 2], axis: usize| from[axis] - pair[0][axis];
        let product = (0..2).map(|axis| part(earlier, axis) * part(pair[1], axis));
        let share = (product.sum::<f64>() / (length * length)).clamp(0.0, 1.0);
        let foot = [0, 1].map(|axis| pair[0][axis] + share * part(pair[1], axis));
        let away = distance(earlier, foot);
        if away < nearest.0 {
            nearest = (away, along + share * length);
        }
        along += length;
    }
    let (away, advance) = nearest;
    match advance < along {
        true => (away <= reach).then_some(advance),
        false => (away <= reach.max(along)).then_some(advance + away),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(places: &[[f64; 2]], ends: [CrackEnd; 2]) -> CrackLine {
        CrackLine {
            places: places.to_vec(),
            ends,
        }
    }

    fn is_close(found: &[Option<(usize, f64)>], expected: &[Option<(usize, f64)>]) {
        assert_eq!(found.len(), expected.len());
        for pair in found.iter().zip(expected) {
            match pair {
                (Some(found), Some(expected)) => {
                    assert_eq!(found.0, expected.0);
                    assert!((found.1 - expected.1).abs() < 1e-12);
                }
                (found, expected) => assert_eq!(found, expected),
            }
        }
    }

    /// Around a corner, with the earlier tips beside the line.
    #[test]
    fn tips_come_from_the_nearest_ones_along_the_line() {
        let bent = line(
            &[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]],
            [CrackEnd::Tip, CrackEnd::Tip],
        );
        let earlier = [[1.0, 0.1], [2.5, -0.1]];
        is_close(
            &bent.advances_of_tips(&earlier, 0.5),
            &[Some((0, 1.0)), Some((1, 4.5))],
        );
        is_close(&bent.advances_of_tips(&earlier, 0.05), &[None, None]);
        let ahead = line(&bent.places, [CrackEnd::PreCrack, CrackEnd::Tip]);
        is_close(
            &ahead.advances_of_tips(&[[4.0, 3.2]], 0.5),
            &[Some((0, 0.0))],
        );
    }

    #[test]
    fn a_branch_comes_from_the_tip_before_its_junction_and_a_new_one_from_none() {
        let branch = line(
            &[[2.0, 0.0], [3.0, 1.0]],
            [CrackEnd::Junction, CrackEnd::Tip],
        );
        let advance = 1.0 + 2.0_f64.sqrt();
        is_close(
            &branch.advances_of_tips(&[[1.0, 0.0]], 0.5),
            &[Some((0, advance))],
        );
        is_close(&branch.advances_of_tips(&[[0.0, 0.0]], 0.5), &[None]);
        is_close(&branch.advances_of_tips(&[], 0.5), &[None]);
    }
}
