//! Displacements of plates of imaginary elements, compared with finite elements at all points.

use anyhow::Context;
use ligament::run::Solution;
use ligament_output::csv::read::Sheet;

use super::places::repository;
use super::trial::displacement_at;

/// Table of problem, d, x, y (mm), u_x, u_y (um) by finite elements.
const ELEMENTS: &str = "tests/reference/mbb-pd-elements.csv";

/// L2 norm over the points of the difference of a component of the displacement over that by finite elements, for a problem and a spacing of its
/// points, mm.
pub(super) fn difference(
    solution: &Solution,
    problem: &str,
    spacing: f64,
    axis: usize,
) -> anyhow::Result<f64> {
    let text = std::fs::read_to_string(repository().join(ELEMENTS)).context(ELEMENTS)?;
    let sheet = Sheet::parse(ELEMENTS, &text)?;
    let problems = sheet.values::<String>("problem")?.into_iter();
    let numbers = sheet.numbers(["d_mm", "x_mm", "y_mm", "ux_um", "uy_um"])?;
    let (mut apart, mut size) = (0.0, 0.0);
    for (of, [d, x, y, along, across]) in problems.zip(numbers) {
        if of == problem && d == spacing {
            let element = [along, across][axis] / 1e6;
            let found = displacement_at(solution, [1e-3 * x, 1e-3 * y])[axis];
            apart += (found - element).powi(2);
            size += element.powi(2);
        }
    }
    Ok((apart / size).sqrt())
}
