//! Ghost forces: the unbalanced forces of the bonds of inner points under a uniform strain.
//!
//! In a continuum the stress is uniform and no force acts inside. Two neighbours of different horizons share all their bonds, so that
//! momentum is never lost; but the bonds of one point need not balance.

use anyhow::{Context, bail};
use ligament::Model;
use ligament_model::tensor::{SymTensor, norm};
use ligament_model::{System, UnbrokenBonds};

use super::case_run::Number;

/// Ghost forces of the inner points of a body in the plane.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct GhostForces {
    points: Vec<InnerPoint>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct InnerPoint {
    /// Distance from the nearest point of the outline, m.
    margin: f64,
    /// Largest force in any uniform strain, over the largest traction times the square root of the area of the point.
    force: f64,
}

impl GhostForces {
    /// Ghost forces of a model of one material in the plane.
    ///
    /// # Errors
    ///
    /// If the body has several materials.
    pub(super) fn from_model(model: &Model) -> anyhow::Result<Self> {
        let system = &**model.plane();
        let is_outer = model.body().rim();
        let positions = &system.cloud.positions;
        let outline = positions.iter().zip(&is_outer).filter(|it| *it.1);
        let outline: Vec<[f64; 2]> = outline.map(|it| *it.0).collect();
        let margin = |[x, y]: [f64; 2]| {
            let distances = outline.iter().map(|[a, b]| (x - a).hypot(y - b));
            distances.fold(f64::INFINITY, f64::min)
        };
        let forces = largest_forces(system, &tractions(model)?);
        let all = positions.iter().zip(forces).zip(&is_outer);
        let inner = all.filter(|(_, is_outer)| !**is_outer);
        Ok(Self {
            points: inner
                .map(|((&at, force), _)| InnerPoint {
                    margin: margin(at),
                    force,
                })
                .collect(),
        })
    }

    /// The statistic of `STATISTIC.MARGIN`, `largest` or `rms`, of the points farther from the outline than a number of the experiment, m.
    pub(super) fn named(&self, name: &str, number: Number<'_>) -> anyhow::Result<f64> {
        let (statistic, margin) = name.split_once('.').context("no margin is named")?;
        let margin = number(margin)?;
        let within = self.points.iter().filter(|it| it.margin > margin);
        let forces: Vec<f64> = within.map(|it| it.force).collect();
        match statistic {
            _ if forces.is_empty() => bail!("no point is farther than {margin} m from the outline"),
            "largest" => Ok(forces.iter().copied().fold(0.0, f64::max)),
            "rms" => {
                let squares: f64 = forces.iter().map(|it| it * it).sum();
                Ok((squares / forces.len() as f64).sqrt())
            }
            other => bail!("no statistic `{other}` of ghost forces"),
        }
    }
}

/// Largest traction in each of the strains that [`largest_forces`] imposes, Pa.
fn tractions(model: &Model) -> anyhow::Result<Vec<f64>> {
    let (setup, space) = (&model.setup, model.setup.space());
    let [region] = setup.materials.as_slice() else {
        bail!("ghost forces are those of one material");
    };
    let elasticity = setup.law.effective_elasticity(&region.material, space);
    let stiffness = elasticity.stiffness_in(space).context("no stiffness")?;
    let of_strain = |(column, [i, j]): (usize, &[usize; 2])| {
        let engineering = if i == j { 1.0 } else { 2.0 };
        let components = stiffness.column(column);
        let components: Vec<f64> = components.iter().map(|it| engineering * it).collect();
        let principal = SymTensor::<2>::from_components(&components).principal_values();
        principal.map(f64::abs).into_iter().fold(0.0, f64::max)
    };
    let strains = SymTensor::<2>::COMPONENTS.iter().enumerate();
    Ok(strains.map(of_strain).collect())
}

/// Forces of the bonds on each point in the motions u_i = x_j, u_j = x_i, the largest over the traction of its strain times the square root
/// of the area of the point, shape (n_points).
fn largest_forces(system: &dyn System<2>, tractions: &[f64]) -> Vec<f64> {
    let (cloud, layout) = (&system.cloud, system.topology().layout);
    let intact = vec![true; system.bonds.len()];
    let mut largest = vec![0.0_f64; cloud.len()];
    let mut forces = vec![0.0; layout.n_degrees_of_freedom()];
    for (&[i, j], traction) in SymTensor::<2>::COMPONENTS.iter().zip(tractions) {
        let mut motions = vec![0.0; layout.n_degrees_of_freedom()];
        for (point, x) in (0..).zip(&cloud.positions) {
            let own = &mut motions[layout.range(point)];
            (own[i], own[j]) = (x[j], x[i]);
        }
        system.multiply(UnbrokenBonds::whole(&intact), &motions, &mut forces);
        for (point, (largest, volume)) in (0..).zip(largest.iter_mut().zip(&*cloud.volumes)) {
            let own = &forces[layout.range(point)];
            let side = (volume / cloud.thickness).sqrt() * cloud.thickness;
            *largest = largest.max(norm([own[0], own[1]]) / (traction * side));
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case_run::CaseRun;

    fn largest(settings: &[(&str, &str)]) -> f64 {
        let case = CaseRun::from_file("cases/verification/graded-strip.toml").unwrap();
        let case = settings
            .iter()
            .fold(case, |case, (key, value)| case.set_toml(key, value));
        let found = GhostForces::from_model(&case.model().unwrap()).unwrap();
        assert!(found.named("rms.zero", &|_| Ok(0.0)).unwrap() > 0.0);
        assert!(found.named("largest.far", &|_| Ok(1.0)).is_err());
        found.named("largest.zero", &|_| Ok(0.0)).unwrap()
    }

    /// Where the size of the cells halves at a line, forces of half of a traction are left without a correction: one of two neighbours has
    /// bonds that the other does not balance. They do not depend on the stiffness or the thickness. The equations of the patch correction are
    /// these forces, of which its regularisation leaves some.
    #[test]
    fn the_patch_correction_leaves_no_ghost_forces_where_the_mesh_becomes_finer() {
        let patch = largest(&[]);
        assert!(patch < 0.01, "{patch}");
        let none = ("correction.surface", "\"none\"");
        let without = largest(&[none]);
        assert!(without > 0.4, "{without}");
        let scaled = largest(&[none, ("material.young", "3e9"), ("mesh.thickness", "0.1")]);
        assert!((scaled / without - 1.0).abs() < 1e-9, "{scaled} {without}");
    }
}
