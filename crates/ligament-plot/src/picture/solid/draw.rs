//! Drawing of a scene as paths.

use super::outline::unit_normal;
use super::visible::DepthBuffer;
use super::{Scene, View};
use crate::drawing::{Anchor, Drawing, Frame, OUTLINE, Paint, PathData, Rgb};
use crate::picture::panel::Scale;

/// Direction of the light: to the right, up, to the eye.
const LIGHT: [f64; 3] = [-0.35, 0.55, 0.76];

/// Brightness of triangles turned away from the light.
const SHADE: f64 = 0.62;

/// Steps of brightness.
const STEPS: f64 = 24.0;

/// Colour of triangles without a field or a value.
const BARE: Rgb = [205, 210, 216];

/// Colour and widths (pixels) of edges, and of edges that the body hides.
const EDGE: (Rgb, f64) = ([0x30; 3], 0.55);
const FAINT: (Rgb, f64) = ([0x9a; 3], 0.4);

/// Width of the rim of each piece in its own colour, pixels, so that no seam is left between two pieces.
const SEAM: f64 = 0.5;

/// Length of the arrows that show the axes, pixels.
const ARROW: f64 = 15.0;

impl Scene {
    /// Draws the scene into a frame, seen from a side, with displacements magnified by a factor.
    pub(crate) fn draw(
        &self,
        drawing: &mut Drawing,
        (frame, scale): (Frame, Option<&Scale>),
        view: View,
        factor: f64,
    ) {
        let seen = self.deformed(view, factor);
        let window = [frame.low, frame.high];
        let buffer = DepthBuffer::new(&seen, &self.triangles, window, frame.scale[0]);
        if self.shows_all_edges {
            let places =
                |ends: &[u32; 2]| ends.map(|end| frame.to_pixels(flat(seen[end as usize])));
            let (colour, width) = FAINT;
            drawing.lines(self.edges.iter().map(places), colour, width);
        }
        self.paint(drawing, (frame, scale), &seen, &buffer);
        let pieces = self
            .edges
            .iter()
            .flat_map(|ends| buffer.visible_pieces(ends.map(|end| seen[end as usize])));
        let pieces = pieces.map(|ends| ends.map(|end| frame.to_pixels(end)));
        let (colour, width) = if self.shows_all_edges { FAINT } else { EDGE };
        drawing.lines(pieces, colour, width);
        axes(drawing, frame, view);
    }

    /// Paints the visible triangles, the farthest first; consecutive ones of one colour are painted together.
    fn paint(
        &self,
        drawing: &mut Drawing,
        (frame, scale): (Frame, Option<&Scale>),
        seen: &[[f64; 3]],
        buffer: &DepthBuffer,
    ) {
        let visible = buffer.visible(seen, &self.triangles);
        let depth = |number: usize| -> f64 {
            self.triangles[number]
                .iter()
                .map(|it| seen[*it as usize][2])
                .sum()
        };
        let mut order: Vec<usize> = (0..visible.len()).filter(|it| visible[*it]).collect();
        order.sort_by(|one, other| depth(*one).total_cmp(&depth(*other)).then(one.cmp(other)));
        let mut path = PathData::default();
        let mut colour = BARE;
        for number in order {
            let triangle = self.triangles[number];
            let corners = triangle.map(|it| seen[it as usize]);
            let light = brightness(corners);
            for (base, polygon) in self.bands(triangle, corners, scale) {
                let painted = base.map(|it| (f64::from(it) * light).round() as u8);
                if painted != colour {
                    fill(drawing, std::mem::take(&mut path), colour);
                    colour = painted;
                }
                frame.add(&mut path, &polygon);
            }
        }
        fill(drawing, path, colour);
    }

    /// A triangle in pieces of one band each, with the colour of the band.
    fn bands(
        &self,
        triangle: [u32; 3],
        corners: [[f64; 3]; 3],
        scale: Option<&Scale>,
    ) -> Vec<(Rgb, Vec<[f64; 2]>)> {
        let whole: Vec<[f64; 2]> = corners.map(flat).to_vec();
        let Some(scale) = scale.filter(|_| !self.values.is_empty()) else {
            return vec![(BARE, whole)];
        };
        let values = triangle.map(|it| self.values[it as usize]);
        if values.iter().any(|it| !it.is_finite()) {
            return vec![(BARE, whole)];
        }
        let bands = values.map(|it| scale.levels.band(it));
        let [first, last] =
            [bands.iter().min(), bands.iter().max()].map(|it| it.copied().unwrap_or(0));
        let with_values: Vec<([f64; 2], f64)> = whole.into_iter().zip(values).collect();
        let pieces = (first..=last).map(|band| {
            let mut piece = with_values.clone();
            if band > first {
                piece = cut(&piece, scale.levels.bounds[band], 1.0);
            }
            if band < last {
                piece = cut(&piece, scale.levels.bounds[band + 1], -1.0);
            }
            (
                scale.colours[band],
                piece.into_iter().map(|it| it.0).collect(),
            )
        });
        pieces.collect()
    }
}

/// The part of a polygon in which the value times a sign is not below the level times this sign.
fn cut(polygon: &[([f64; 2], f64)], level: f64, sign: f64) -> Vec<([f64; 2], f64)> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (place, &(from, start)) in polygon.iter().enumerate() {
        let (to, end) = polygon[(place + 1) % polygon.len()];
        let [starts_in, ends_in] = [start, end].map(|it| sign * (it - level) >= 0.0);
        if starts_in {
            kept.push((from, start));
        }
        if starts_in != ends_in {
            let share = (level - start) / (end - start);
            let at = [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
            kept.push((at, level));
        }
    }
    kept
}

fn flat([x, y, _]: [f64; 3]) -> [f64; 2] {
    [x, y]
}

/// Brightness of a triangle, seen from either side.
fn brightness(corners: [[f64; 3]; 3]) -> f64 {
    let normal = unit_normal(corners);
    let to_eye = if normal[2] < 0.0 { -1.0 } else { 1.0 };
    let met: f64 = (0..3).map(|axis| to_eye * normal[axis] * LIGHT[axis]).sum();
    let light = SHADE + (1.0 - SHADE) * met.clamp(0.0, 1.0) / 0.9;
    (light.min(1.0) * STEPS).round() / STEPS
}

fn fill(drawing: &mut Drawing, path: PathData, colour: Rgb) {
    let paint = Paint {
        fill: Some(colour),
        ..Paint::stroke(colour, SEAM)
    };
    drawing.path(path, paint);
}

/// Draws the axes as seen below the left of the frame.
fn axes(drawing: &mut Drawing, frame: Frame, view: View) {
    let [x, y] = frame.to_pixels(frame.low);
    let axes = view.axes();
    // The arrows that point away from the eye lie below the others.
    let seen = |axis: usize| axes.map(|it| it[axis]);
    let arrows = [0, 1, 2].map(|axis| (["x", "y", "z"][axis], seen(axis)));
    let reach = |place: usize| arrows.iter().map(|it| it.1[place]).fold(0.0, f64::min);
    let at = [x + 7.0 - ARROW * reach(0), y - 7.0 + ARROW * reach(1)];
    for (name, [right, up, _]) in arrows {
        if right.hypot(up) < 0.05 {
            continue;
        }
        let end = [at[0] + ARROW * right, at[1] - ARROW * up];
        drawing.line([at, end], OUTLINE, 0.7);
        let label = [end[0] + 4.5 * right, end[1] - 4.5 * up + 2.5];
        drawing.text(label, Anchor::Middle, 7.5, name);
    }
}
