//! One quadrilateral: isoparametric, with Lagrange's shape functions.

use super::mesh::Degree;

/// Plane stiffness C: (sigma_xx, sigma_yy, sigma_xy) = C (eps_xx, eps_yy, gamma_xy), Pa.
pub(super) type PlaneStiffness = [[f64; 3]; 3];

/// Derivatives of the shape functions of all nodes by x and y at a position (xi, eta) of [-1, 1]^2, and the determinant of the Jacobian.
pub(super) struct Shapes {
    /// Derivatives dN/dx and dN/dy of each node.
    gradients: Vec<[f64; 2]>,
    /// Determinant of the Jacobian.
    area: f64,
}

impl Shapes {
    /// The shape functions of an element with these nodes.
    pub(super) fn at(degree: Degree, nodes: &[[f64; 2]], [xi, eta]: [f64; 2]) -> Self {
        let (of_xi, of_eta) = (lagrange(degree, xi), lagrange(degree, eta));
        let local: Vec<[f64; 2]> = (of_eta.iter())
            .flat_map(|&[n, dn]| of_xi.iter().map(move |&[m, dm]| [dm * n, m * dn]))
            .collect();
        let jacobian = |of: usize, by: usize| -> f64 {
            let terms = nodes.iter().zip(&local);
            terms.map(|(node, local)| node[of] * local[by]).sum()
        };
        let [[x_xi, x_eta], [y_xi, y_eta]] = [0, 1].map(|of| [jacobian(of, 0), jacobian(of, 1)]);
        let area = x_xi * y_eta - x_eta * y_xi;
        let gradients = (local.iter())
            .map(|[a, b]| [(y_eta * a - y_xi * b) / area, (x_xi * b - x_eta * a) / area])
            .collect();
        Self { gradients, area }
    }

    /// (eps_xx, eps_yy, gamma_xy) from the displacements of the nodes.
    pub(super) fn strain(&self, displacements: impl Iterator<Item = [f64; 2]>) -> [f64; 3] {
        let mut strain = [0.0; 3];
        for ([x, y], [u, v]) in self.gradients.iter().zip(displacements) {
            strain[0] += x * u;
            strain[1] += y * v;
            strain[2] += y * u + x * v;
        }
        strain
    }
}

/// The stiffness matrix of an element of thickness 1, row by row, unknowns u_x, u_y of one node after the other:
/// the integral of B^T C B by Gauss's rule of as many points along a side as nodes.
pub(super) fn stiffness(degree: Degree, nodes: &[[f64; 2]], c: &PlaneStiffness) -> Vec<f64> {
    let n = 2 * nodes.len();
    let mut sum = vec![0.0; n * n];
    let rule = gauss(degree);
    for &[xi, of_xi] in rule {
        for &[eta, of_eta] in rule {
            let shapes = Shapes::at(degree, nodes, [xi, eta]);
            let weight = of_xi * of_eta * shapes.area;
            // The columns of B: strains of a unit displacement of an unknown.
            let columns: Vec<[f64; 3]> = (shapes.gradients.iter())
                .flat_map(|&[x, y]| [[x, 0.0, y], [0.0, y, x]])
                .collect();
            for (row, left) in columns.iter().enumerate() {
                let stress = [0, 1, 2].map(|i| weight * dot(&c[i], left));
                for (entry, right) in sum[row * n..].iter_mut().zip(&columns) {
                    *entry += dot(&stress, right);
                }
            }
        }
    }
    sum
}

/// The area of each node of an element: the integral of its shape function by the rule with the nodes as points (the trapezoidal rule,
/// Simpson's rule). The same rule gives a diagonal mass matrix.
pub(super) fn nodal_areas(degree: Degree, nodes: &[[f64; 2]]) -> Vec<f64> {
    let rule: &[[f64; 2]] = match degree {
        Degree::Linear => &[[-1.0, 1.0], [1.0, 1.0]],
        Degree::Quadratic => &[[-1.0, 1.0 / 3.0], [0.0, 4.0 / 3.0], [1.0, 1.0 / 3.0]],
    };
    (rule.iter())
        .flat_map(|&[eta, of_eta]| {
            rule.iter()
                .map(move |&[xi, of_xi]| ([xi, eta], of_xi * of_eta))
        })
        .map(|(place, weight)| weight * Shapes::at(degree, nodes, place).area)
        .collect()
}

/// Points and weights of Gauss's rule on [-1, 1], as many as there are nodes along a side.
fn gauss(degree: Degree) -> &'static [[f64; 2]] {
    /// Gauss points 1/sqrt(3) and sqrt(3/5).
    const TWO: f64 = 0.577_350_269_189_625_8;
    const THREE: f64 = 0.774_596_669_241_483_4;
    match degree {
        Degree::Linear => &[[-TWO, 1.0], [TWO, 1.0]],
        Degree::Quadratic => &[[-THREE, 5.0 / 9.0], [0.0, 8.0 / 9.0], [THREE, 5.0 / 9.0]],
    }
}

/// Values and derivatives of Lagrange's polynomials at a position in [-1, 1].
fn lagrange(degree: Degree, x: f64) -> Vec<[f64; 2]> {
    match degree {
        Degree::Linear => vec![[0.5 * (1.0 - x), -0.5], [0.5 * (1.0 + x), 0.5]],
        Degree::Quadratic => vec![
            [0.5 * x * (x - 1.0), x - 0.5],
            [1.0 - x * x, -2.0 * x],
            [0.5 * x * (x + 1.0), x + 0.5],
        ],
    }
}

/// Scalar product a . b.
pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
