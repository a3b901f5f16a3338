//! What `model.vtu` should hold.

use ligament_model::Absence;

use super::super::expected::Place;
use super::{Recorder, single};

impl Recorder<'_> {
    /// The file `model.vtu`.
    pub(super) fn model_file(&mut self) {
        let (file, system, fixed) = ("model.vtu", &**self.model.plane(), &self.model.fixed);
        let absent = &fixed.absent;
        let n_lines = system.bonds.len() + absent.len();
        let expected = &mut self.expected;
        expected.lines(file, &self.model.setup.body.geometry().positions(), n_lines);
        fn point(name: &str) -> Place<'_> {
            let (file, part) = ("model.vtu", "point");
            Place { file, part, name }
        }
        expected.reals(point("volume"), system.cloud.volumes.iter().copied());
        expected.reals(point("horizon"), fixed.horizon.iter().copied());
        let no_fail = fixed.no_fail.iter().map(|&it| i64::from(it));
        expected.integers(point("no_fail"), no_fail);
        let tags = (0..system.cloud.len() as u32).map(|it| self.model.body().tag(it) as i64);
        expected.integers(point(self.model.body().tagged()), tags);
        for group in self.problem.loads.groups() {
            let at = (0..system.cloud.len() as u32).map(|it| i64::from(group.points.contains(&it)));
            expected.integers(point(&format!("group.{}", group.name)), at);
        }

        fn cell(name: &str) -> Place<'_> {
            let (file, part) = ("model.vtu", "cell");
            Place { file, part, name }
        }
        let n_bonds = system.bonds.len();
        let none = || absent.iter().map(|_| f64::NAN);
        let words = absent.iter().map(|it| match it.absence {
            Absence::PreCrack => 1,
            Absence::Void => 2,
        });
        expected.integers(cell("absent"), std::iter::repeat_n(0, n_bonds).chain(words));
        let horizons = system.bonds.horizon.iter().copied();
        let horizons = horizons.chain(absent.iter().map(|it| it.horizon));
        expected.singles(cell("horizon"), horizons.map(single));
        let alpha = (0..n_bonds).map(|bond| system.weight[bond] / fixed.domain_factor[bond]);
        expected.singles(cell("length_factor"), alpha.chain(none()).map(single));
        let omega = fixed.domain_factor.iter().copied();
        expected.singles(cell("domain_factor"), omega.chain(none()).map(single));
        for (criterion, label) in self.problem.criteria.list.iter().zip(&self.labels) {
            let limits = criterion.limit.iter().copied();
            expected.reals(cell(&format!("limit.{label}")), limits.chain(none()));
            let count = criterion.coefficient.len() / n_bonds;
            let names = ["coefficient", "toughness_ratio", "mixed_mode_exponent"];
            for (place, name) in names.into_iter().enumerate().take(count) {
                let values = (0..n_bonds).map(|bond| criterion.coefficients(bond)[place]);
                expected.reals(cell(&format!("{name}.{label}")), values.chain(none()));
            }
            let parameters = criterion.after.parameter();
            if parameters.is_empty() {
                continue;
            }
            let values = parameters.iter().copied().chain(none());
            expected.reals(cell(&format!("after.{label}")), values);
        }
        if self.problem.criteria.list.is_empty() {
            return;
        }
        let nothing = || absent.iter().map(|_| (f32::NAN, 0, 0));
        let all = || self.largest.iter().copied().chain(nothing());
        expected.singles(cell("largest_utilisation"), all().map(|it| it.0));
        expected.integers(cell("step_of_largest"), all().map(|it| it.1));
        expected.integers(cell("criterion_of_largest"), all().map(|it| it.2));
        let dissipated = self.dissipated.iter().copied();
        expected.reals(cell("dissipated_energy"), dissipated.chain(none()));
    }
}
