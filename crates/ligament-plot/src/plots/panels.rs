//! Several plots with the same scales and one legend.

use super::sheet::PageLayout;
use super::{Plot, PlotError, Series, TITLE, corners};
use crate::drawing::{Anchor, Drawing};

/// Plots of the same quantities, one beside the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Panels {
    /// Name of the file.
    pub name: String,
    /// Title above all plots.
    pub title: String,
    /// The plots, one or more, each with its own title.
    pub plots: Vec<Plot>,
}

impl Panels {
    /// The plots for a sheet of paper of a width in mm. A single plot has the title of all.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn for_paper(&self, width: f64) -> Result<Drawing, PlotError> {
        if let [only] = self.plots.as_slice() {
            let (name, title) = (self.name.clone(), self.title.clone());
            return Plot {
                name,
                title,
                ..only.clone()
            }
            .for_paper(width);
        }
        let all = self.plots.iter().flat_map(|plot| &plot.series);
        let corners = corners(all).ok_or_else(|| PlotError::Empty {
            name: self.name.clone(),
        })?;
        let legend = self.legend();
        let (sheet, rooms) = PageLayout::for_panels(width, &legend, self.plots.len());
        let mut drawing = sheet.drawing();
        let size = sheet.pen * TITLE;
        drawing.text(
            [0.5 * sheet.plane, 1.1 * size],
            Anchor::Middle,
            size,
            &self.title,
        );
        for (plot, room) in self.plots.iter().zip(rooms) {
            plot.draw_into(&mut drawing, sheet, plot.frame(sheet, room, corners));
        }
        sheet.draw_legend(&mut drawing, &legend);
        Ok(drawing)
    }

    /// The curves of the legend: the first one of each label.
    fn legend(&self) -> Vec<Series> {
        let mut legend: Vec<Series> = Vec::new();
        for series in self.plots.iter().flat_map(|plot| &plot.series) {
            let is_new = legend.iter().all(|it| it.label() != series.label());
            if series.is_named() && is_new {
                legend.push(series.clone());
            }
        }
        legend
    }
}

#[cfg(test)]
mod tests {
    use super::super::Colour;
    use super::*;

    fn plot(title: &str, points: Vec<[f64; 2]>) -> Plot {
        let series = Series::line("coarse", Colour::Blue, points);
        Plot::new("p", title, ["x", "y"], vec![series])
    }

    /// Two panels have one legend and the same scales: the point (1, 1) of one and of the other are as high.
    #[test]
    fn panels_share_their_scales_and_legend() {
        let panels = Panels {
            name: "p".to_owned(),
            title: "Peaks".to_owned(),
            plots: vec![
                plot("4 mm", vec![[0.0, 0.0], [1.0, 1.0]]),
                plot("2 mm", vec![[0.0, 4.0], [1.0, 1.0]]),
            ],
        };
        let svg = panels.for_paper(160.0).unwrap().to_svg("");
        for words in [">4 mm<", ">2 mm<", ">Peaks<"] {
            assert_eq!(svg.matches(words).count(), 1, "{words}");
        }
        assert_eq!(svg.matches(">coarse<").count(), 1, "{svg}");
        let circles = svg.lines().filter(|it| it.contains("<circle"));
        let height = |it: &str| {
            it.split("cy=\"")
                .nth(1)
                .unwrap()
                .split('"')
                .next()
                .unwrap()
                .to_owned()
        };
        let heights: Vec<String> = circles.map(height).collect();
        // Two points of each panel and the dot of the legend.
        assert_eq!(heights.len(), 5);
        assert_eq!(heights[1], heights[3], "{heights:?}");
    }

    #[test]
    fn one_panel_is_the_plot_alone() {
        let single = plot("Peaks", vec![[0.0, 0.0], [1.0, 1.0]]);
        let panels = Panels {
            name: "p".to_owned(),
            title: "Peaks".to_owned(),
            plots: vec![Plot {
                title: "all".to_owned(),
                ..single.clone()
            }],
        };
        assert_eq!(panels.for_paper(160.0), single.for_paper(160.0));
    }
}
