//! Measured and computed curves.

use std::path::Path;

use anyhow::Context;
use ligament_output::csv::read::CsvTable;

use super::test::Axis;
use crate::places::repository;

/// Points of a curve in their order, shape (n, 2).
pub(super) type Points = [[f64; 2]];

/// A measured curve, one column of y for each specimen over a common x, or the curve of an independent solution.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KnownCurve {
    /// Specimens with their points.
    pub(super) specimens: Vec<(String, Vec<[f64; 2]>)>,
}

impl KnownCurve {
    /// Reads a table whose first column is x, and whose others are y of one specimen each.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, a value is no number, or x does not grow.
    pub(super) fn read(path: &Path) -> anyhow::Result<Self> {
        let text = std::fs::read_to_string(path);
        let text = text.with_context(|| format!("cannot read {}", path.display()))?;
        Self::parse(path, &text)
    }

    /// Reads the curve of an independent solution, in m and N, into the units of the axes of a test: mm, and the load times the factor of y.
    ///
    /// # Errors
    ///
    /// As for a measured curve.
    pub(super) fn independent(file: &str, y: &Axis) -> anyhow::Result<Self> {
        let mut curve = Self::read(&repository().join(file))?;
        for point in curve.specimens.iter_mut().flat_map(|(_, points)| points) {
            *point = [1e3 * point[0], y.factor * point[1]];
        }
        Ok(curve)
    }

    fn parse(path: &Path, text: &str) -> anyhow::Result<Self> {
        let sheet = CsvTable::parse(path, text)?;
        let shown = path.display();
        let [x, names @ ..] = sheet.columns() else {
            anyhow::bail!("{shown} is empty");
        };
        anyhow::ensure!(!names.is_empty(), "{shown} has no column beside `{x}`");
        let x: Vec<f64> = sheet.values(x)?;
        anyhow::ensure!(
            x.len() > 1 && x.windows(2).all(|pair| pair[0] < pair[1]),
            "{shown}: the first column must grow from row to row, in two rows or more"
        );
        let specimen = |name: &String| {
            let y: Vec<f64> = sheet.values(name)?;
            let points = x.iter().zip(y).map(|(&x, y)| [x, y]).collect();
            Ok((name.clone(), points))
        };
        let specimens = names.iter().map(specimen).collect::<anyhow::Result<_>>()?;
        Ok(Self { specimens })
    }

    /// Mean of a value over the specimens.
    fn mean(&self, of: impl Fn(&Points) -> f64) -> f64 {
        let sum: f64 = self.specimens.iter().map(|(_, points)| of(points)).sum();
        sum / self.specimens.len() as f64
    }

    /// Mean of the specimens' peaks.
    pub(super) fn peak(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.mean(|points| peak(points)[axis]))
    }

    /// Mean of the areas under the specimens' curves up to an x.
    pub(super) fn area(&self, end: f64) -> f64 {
        self.mean(|points| area(points, end))
    }

    /// Largest x.
    pub(super) fn end(&self) -> f64 {
        self.mean(|points| points.last().map_or(0.0, |point| point[0]))
    }
}

/// Point with the largest y, the first of equal ones.
pub(super) fn peak(points: &Points) -> [f64; 2] {
    let largest = points
        .iter()
        .copied()
        .reduce(|best, point| if point[1] > best[1] { point } else { best });
    largest.unwrap_or([f64::NAN; 2])
}

/// Area under a curve by trapezia, up to where its x first passes `end`. Parts that run back in x count as negative, so that the area of a
/// force over its displacement is its work.
pub(super) fn area(points: &Points, end: f64) -> f64 {
    let mut sum = 0.0;
    for pair in points.windows(2) {
        let [[x, y], [next, above]] = [pair[0], pair[1]];
        if next >= end {
            let share = if next > x {
                (end - x) / (next - x)
            } else {
                0.0
            };
            return sum + 0.5 * (2.0 * y + share * (above - y)) * (end - x);
        }
        sum += 0.5 * (y + above) * (next - x);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "x (mm),one (N),two (N)\n0,0,0\n1,10,8\n2,4,12\n3,0,4\n";

    fn parse(text: &str) -> anyhow::Result<KnownCurve> {
        KnownCurve::parse(Path::new("curve.csv"), text)
    }

    /// By hand: peaks 10 at 1 and 12 at 2; areas 5 + 7 + 2 = 14 and 4 + 10 + 8 = 22.
    #[test]
    fn a_measured_curve_is_the_mean_of_its_specimens() {
        let curve = parse(TEXT).unwrap();
        assert_eq!(curve.specimens[1].0, "two (N)");
        assert_eq!(curve.peak(), [1.5, 11.0]);
        assert_eq!((curve.area(3.0), curve.end()), (18.0, 3.0));
    }

    #[test]
    fn wrong_tables_are_refused() {
        for (text, expected) in [
            ("x (mm)\n0\n1\n", "no column beside"),
            ("x,y\n0,1\n0,2\n", "must grow"),
            ("x,y\n0,1\n1,high\n", "high"),
            ("x,y\n0,1\n1\n", "row 2"),
        ] {
            let found = format!("{:#}", parse(text).unwrap_err());
            assert!(found.contains(expected), "{found}");
        }
    }

    /// By hand: up to 1.5 the triangle 0.5 and the trapezium 0.5 (1 + 1.5)/2; a return in x takes its area back.
    #[test]
    fn an_area_ends_where_it_is_told_and_counts_returns() {
        let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]];
        assert_eq!(area(&line, 1.5), 0.5 + 0.625);
        assert_eq!(area(&line, 9.0), 2.0);
        let back = [[0.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(area(&back, 9.0), 0.0);
        assert_eq!(peak(&back), [2.0, 2.0]);
    }
}
