//! The papers behind what a case uses.

use super::scatter::Distribution;
use super::sections::Case;
use ligament::setup::Alpha;
use ligament_analysis::motion::Scheme;

impl Case {
    /// Papers of the law, the corrections, the criteria with what bonds do after them, random properties and the motion, as texts with keys
    /// of the references; each text stands once.
    pub fn sources(&self) -> Vec<&'static str> {
        let mut found = vec![self.model.law.0.row.source];
        found.extend(self.correction.alpha.map(Alpha::source));
        found.extend(self.correction.surface.map(|it| it.0.source()));
        let fracture = self.fracture.as_ref();
        let criteria = fracture.and_then(|it| it.criteria.as_deref());
        for criterion in criteria.into_iter().flatten() {
            found.extend([criterion.kind.0.source, criterion.after.0.source]);
        }
        let scatter = fracture.and_then(|it| it.scatter.as_ref());
        for scatter in scatter.iter().flat_map(|it| &it.0) {
            found.push(match scatter.distribution {
                Distribution::Weibull => "Weibull 1951",
                Distribution::Normal => "",
                Distribution::Lognormal => "Aitchison and Brown 1957",
            });
            if scatter.correlation_length > 0.0 {
                found.push("Shinozuka and Jan 1972");
            }
        }
        let motion = self.motion.as_ref();
        if motion.is_some_and(|it| it.scheme != Scheme::Explicit) {
            found.push("Hilber 1977");
        }
        if !self.quiet.is_empty() {
            found.push("Lysmer and Kuhlemeyer 1969");
        }
        let mut each = Vec::new();
        for source in found {
            if !source.is_empty() && !each.contains(&source) {
                each.push(source);
            }
        }
        each
    }
}
