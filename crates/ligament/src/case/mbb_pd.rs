//! What the law MBB-PD asks of the other sections of a case.

use super::analysis::Analysis;
use super::correction::{Alpha, Surface};
use super::fault::KeyFault;
use super::fracture::StressField;
use super::key_path::KeyPath;
use super::model::Law;
use super::probe::Reading;
use super::{BodySection, Case};

/// The fault of a case that has the law but not what its elements need: the rows and columns of a square lattice, no correction beside
/// their own factors, and nothing that looks at forces between two points.
pub(super) fn check(case: &Case) -> Result<(), KeyFault> {
    if case.model.law != Law::MbbPd {
        return Ok(());
    }
    let section = |name: &str| KeyPath::default().child(name);
    let fault = |key: KeyPath, reason: &str| Err(KeyFault::new(key, reason.to_owned()));
    let BodySection::Lattice(lattice) = &case.body else {
        let reason = "\"mbb-pd\" classes bonds by the rows and columns of a lattice: give [lattice] in the place of [mesh], or take \
                      another law";
        return fault(section("model").child("law"), reason);
    };
    let [dx, dy] = lattice.spacing;
    if dx != dy {
        let reason = "the cells must be square for model.law = \"mbb-pd\"";
        return fault(section("lattice").child("spacing"), reason);
    }
    if case.correction.alpha != Alpha::None {
        let reason = "the factors psi of \"mbb-pd\" make all energies right: take \"none\"";
        return fault(section("correction").child("alpha"), reason);
    }
    if case.correction.surface != Surface::None {
        let reason = "the factors psi of \"mbb-pd\" make all energies right: take \"none\"";
        return fault(section("correction").child("surface"), reason);
    }
    if case.analysis != Analysis::Modal && case.output.stress.contains(&StressField::Traction) {
        let reason = "the elements of \"mbb-pd\" couple up to six points, so that their forces go through no line: take \"virial\"";
        return fault(section("output").child("stress"), reason);
    }
    let mut probes = case.probes.iter().enumerate();
    if let Some((place, _)) = probes.find(|(_, it)| matches!(it.reading, Reading::Section { .. })) {
        let reason = "the elements of \"mbb-pd\" couple up to six points, so that their forces go through no line: the forces of \
                      supports and loads are in the history";
        return fault(section("probe").child(place).child("section"), reason);
    }
    Ok(())
}
