//! Plots with one scale along x and y, cut off at a window: loci that are open.

use super::sheet::PageLayout;
use super::{Plot, PlotError};
use crate::drawing::{Drawing, Frame};

/// A plot with one scale along x and y.
#[derive(Debug, Clone, PartialEq)]
pub struct EqualScales {
    /// The curves, which need not lie in the window.
    pub plot: Plot,
    /// Lower left and upper right corner of the part that must be visible.
    pub window: [[f64; 2]; 2],
}

impl EqualScales {
    /// The plot for a screen, 600 pixels high.
    ///
    /// # Errors
    ///
    /// If the window is empty.
    pub fn for_screen(&self) -> Result<Drawing, PlotError> {
        let [lower, upper] = self.window;
        if !(0..2).all(|axis| lower[axis] < upper[axis]) {
            return Err(self.plot.empty_error());
        }
        let sheet = PageLayout::screen(600.0, &self.plot.series);
        let frame = self.plot.frame(sheet, sheet.whole(), self.window);
        // The window is enlarged along one axis until it fills the room at the common scale.
        let (size, scale) = (frame.size(), frame.scale[0].min(frame.scale[1]));
        let corner = |side: f64| {
            [0, 1].map(|axis| {
                let middle = 0.5 * (lower[axis] + upper[axis]);
                middle + 0.5 * side * size[axis] / scale
            })
        };
        let corners = [corner(-1.0), corner(1.0)];
        Ok(self.plot.draw(sheet, Frame::new(corners, [frame.at, size])))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Colour, Series};
    use super::*;

    #[test]
    fn a_window_needs_room() {
        let line = Series::curve("line", Colour::Blue, vec![[0.0, 0.0], [9.0, 9.0]]);
        let plot = Plot::new("locus", "Locus", ["s1", "s2"], vec![line]);
        let of = |window| {
            let plot = plot.clone();
            EqualScales { plot, window }.for_screen()
        };
        let drawn = of([[-1.0, -1.0], [1.0, 1.0]]).unwrap().to_svg("");
        // From the origin to the upper side of the window, along both axes alike.
        let line = drawn.lines().find(|it| it.contains("stroke=\"#0072b2\""));
        let path = line.and_then(|it| it.split("d=\"m").nth(1)).unwrap();
        let step = path.split(['l', '"']).nth(1).unwrap();
        let (along, up) = step.split_once('-').unwrap();
        let [along, up] = [along, up].map(|it| it.trim().parse::<i32>().unwrap());
        assert!(along > 20_000 && (along - up).abs() <= 2, "{step}");
        assert!(matches!(
            of([[1.0, 0.0], [1.0, 2.0]]),
            Err(PlotError::Empty { .. })
        ));
    }
}
