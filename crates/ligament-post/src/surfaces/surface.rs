//! Crack of a solid as triangles: orientation, parts, area and shape.

use std::collections::HashMap;

use ligament_model::tensor::{cross, dot, minus, norm};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};

/// Cracks of a solid as triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CrackSurface {
    /// Positions of the corners, each in the middle of an edge, a face or a tetrahedron between sides, shape (n_places), m.
    pub places: Vec<[f64; 3]>,
    /// Pairs of neighbouring points separated at each place, the lower one first, shape (n_places).
    pub parted: Vec<Vec<[u32; 2]>>,
    /// Corners of the triangles, counter-clockwise seen from the same side of a part, shape (n_triangles).
    pub triangles: Vec<[u32; 3]>,
    /// Whether each triangle belongs to a pre-crack: all its separated pairs were cut before the first load, shape (n_triangles).
    pub is_precrack: Vec<bool>,
    /// Connected part of each triangle, from 0, the largest first, shape (n_triangles).
    pub part: Vec<u32>,
}

/// A connected part of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePart {
    /// Area without pre-cracks, m^2.
    pub area: f64,
    /// Area of pre-cracks, m^2.
    pub precrack: f64,
    /// Lowest and highest coordinates, m.
    pub extent: [[f64; 3]; 2],
}

/// Best plane through triangles, by least squares over their area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BestPlane {
    /// Centre of the area, m.
    pub centre: [f64; 3],
    /// Unit normal; its largest component is positive.
    pub normal: [f64; 3],
    /// Largest distance of a place from the plane, m.
    pub largest_distance: f64,
}

impl CrackSurface {
    /// Area of a triangle, m^2.
    pub fn area_of(&self, triangle: usize) -> f64 {
        norm(area_vector(&self.places, self.triangles[triangle]))
    }

    /// Area without pre-cracks, m^2.
    pub fn area(&self) -> f64 {
        let grown = (0..self.triangles.len()).filter(|it| !self.is_precrack[*it]);
        grown
            .map(|it| self.area_of(it))
            .fold(0.0, |sum, area| sum + area)
    }

    /// Connected parts, in the order of their numbers.
    pub fn parts(&self) -> Vec<SurfacePart> {
        let count = self.part.iter().max().map_or(0, |it| *it as usize + 1);
        let nothing = SurfacePart {
            area: 0.0,
            precrack: 0.0,
            extent: [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]],
        };
        let mut parts = vec![nothing; count];
        for (triangle, part) in self.part.iter().enumerate() {
            let part = &mut parts[*part as usize];
            let area = self.area_of(triangle);
            match self.is_precrack[triangle] {
                true => part.precrack += area,
                false => part.area += area,
            }
            for place in self.triangles[triangle].map(|it| self.places[it as usize]) {
                for axis in 0..3 {
                    let [low, high] = &mut part.extent;
                    low[axis] = low[axis].min(place[axis]);
                    high[axis] = high[axis].max(place[axis]);
                }
            }
        }
        parts
    }

    /// Best plane through the surface without pre-cracks; `None` for an empty surface.
    pub fn best_plane(&self) -> Option<BestPlane> {
        let grown = || (0..self.triangles.len()).filter(|it| !self.is_precrack[*it]);
        let middle = |triangle: usize| {
            let corners = self.triangles[triangle].map(|it| self.places[it as usize]);
            [0, 1, 2].map(|axis| (corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3.0)
        };
        let area = self.area();
        if area <= 0.0 {
            return None;
        }
        let centre = [0, 1, 2].map(|axis| {
            let moments = grown().map(|it| self.area_of(it) * middle(it)[axis]);
            moments.sum::<f64>() / area
        });
        let mut spread = Matrix3::<f64>::zeros();
        for triangle in grown() {
            let weight = self.area_of(triangle) / area;
            let from = Vector3::from(minus(middle(triangle), centre));
            spread += weight * from * from.transpose();
        }
        let eigen = SymmetricEigen::new(spread);
        let least = eigen.eigenvalues.imin();
        let normal: [f64; 3] = eigen.eigenvectors.column(least).into_owned().into();
        let largest = normal.into_iter().fold(
            0.0,
            |best: f64, it| if it.abs() > best.abs() { it } else { best },
        );
        let normal = normal.map(|it| it * largest.signum());
        let places = grown().flat_map(|it| self.triangles[it]);
        let distances = places.map(|it| dot(minus(self.places[it as usize], centre), normal).abs());
        Some(BestPlane {
            centre,
            normal,
            largest_distance: distances.fold(0.0, f64::max),
        })
    }
}

/// Half of the vector product of two sides of a triangle: its area times its unit normal, m^2.
pub(super) fn area_vector(places: &[[f64; 3]], triangle: [u32; 3]) -> [f64; 3] {
    let [a, b, c] = triangle.map(|it| places[it as usize]);
    cross(minus(b, a), minus(c, a)).map(|it| 0.5 * it)
}

/// The surface with its triangles oriented alike over edges of two triangles, and with its parts.
pub(super) fn with_orientation_and_parts(mut surface: CrackSurface) -> CrackSurface {
    orient_consistently(&mut surface.triangles);
    surface.part = parts(&surface);
    surface
}

fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Directed sides of a triangle.
fn directed_edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Orients triangles so that two at an edge run along it in opposite directions, beginning with the first of each part.
fn orient_consistently(triangles: &mut [[u32; 3]]) {
    let mut at: HashMap<[u32; 2], Vec<u32>> = HashMap::new();
    for (number, triangle) in (0..).zip(triangles.iter()) {
        for side in directed_edges(*triangle) {
            at.entry(ascending(side)).or_default().push(number);
        }
    }
    let mut is_turned = vec![false; triangles.len()];
    for first in 0..triangles.len() {
        let mut stack = vec![first];
        while let Some(number) = stack.pop() {
            if std::mem::replace(&mut is_turned[number], true) {
                continue;
            }
            for side in directed_edges(triangles[number]) {
                let [one, other] = match at[&ascending(side)].as_slice() {
                    &[one, other] => [one as usize, other as usize],
                    _ => continue,
                };
                let next = if one == number { other } else { one };
                if !is_turned[next] {
                    if directed_edges(triangles[next]).contains(&side) {
                        triangles[next].swap(1, 2);
                    }
                    stack.push(next);
                }
            }
        }
    }
}

/// Number of the connected part of each triangle, by common places; the largest part first, then in the order of triangles.
fn parts(surface: &CrackSurface) -> Vec<u32> {
    let mut lowest: Vec<u32> = (0..surface.places.len() as u32).collect();
    fn root(lowest: &mut [u32], mut place: u32) -> u32 {
        while lowest[place as usize] != place {
            lowest[place as usize] = lowest[lowest[place as usize] as usize];
            place = lowest[place as usize];
        }
        place
    }
    for [a, b, c] in &surface.triangles {
        for other in [b, c] {
            let [one, other] = [*a, *other].map(|it| root(&mut lowest, it));
            lowest[one.max(other) as usize] = one.min(other);
        }
    }
    let roots: Vec<u32> = surface
        .triangles
        .iter()
        .map(|it| root(&mut lowest, it[0]))
        .collect();
    let mut areas: HashMap<u32, f64> = HashMap::new();
    for (triangle, part) in roots.iter().enumerate() {
        *areas.entry(*part).or_default() += surface.area_of(triangle);
    }
    let mut order: Vec<(u32, f64)> = areas.into_iter().collect();
    order.sort_by(|one, other| other.1.total_cmp(&one.1).then(one.0.cmp(&other.0)));
    let numbers: HashMap<u32, u32> = (order.iter().map(|it| it.0)).zip(0..).collect();
    roots.iter().map(|root| numbers[root]).collect()
}
