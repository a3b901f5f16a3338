//! What the law MBB-PD asks of the other sections of a case.

use super::analysis::Analysis;
use super::body_section::BodySection;
use super::checked::Case;
use super::correction::Surface;
use super::fault::KeyFault;
use super::fracture::StressField;
use super::key_path::KeyPath;
use super::model::Law;
use super::probe::Reading;
use super::word::Word;
use ligament::setup::{Alpha, Form, Strains};

/// The fault of a criterion that looks at what bonds of the law do not have.
fn check_criteria(case: &Case) -> Result<(), KeyFault> {
    let Some(fracture) = &case.fracture else {
        return Ok(());
    };
    let is_law = case.model.law == Law::MbbPd;
    for (place, criterion) in fracture.criteria.iter().enumerate() {
        if criterion.kind.takes_strains() == is_law {
            continue;
        }
        let list = KeyPath::default().child("fracture").child("criterion");
        let (key, kind) = (list.child(place).child("kind"), criterion.kind.word);
        let reason = if is_law {
            format!(
                "\"{kind}\" looks at stretch and sliding of a bond between two points, and the bonds of model.law = \"mbb-pd\" have \
                 strains of their own: take \"mixed-mode\""
            )
        } else {
            format!(
                "\"mixed-mode\" looks at strains of the bond's own, which only model.law = \"mbb-pd\" has: for \"{}\" take \
                 \"critical-stretch\" or \"bond-energy\"",
                case.model.law.word()
            )
        };
        return Err(KeyFault::new(key, reason));
    }
    Ok(())
}

/// The fault of a variant of the law in an analysis that it is not made for.
fn check_variants(case: &Case) -> Result<(), KeyFault> {
    let model = KeyPath::default().child("model");
    let is_static = case.analysis == Analysis::Static;
    let is_true = case.model.strains == Some(Word(Strains::True));
    if case.model.form == Some(Word(Form::Pairwise)) {
        let reason = if !is_static {
            "the printed forces are not those of an energy, so that there is no stiffness whose modes or breakages could be followed: it \
             is for elastic analyses; take \"full\""
        } else if !case.precracks.is_empty() {
            "the printed factors are those of whole families: it takes no pre-cracks; take \"full\""
        } else if is_true {
            "it takes strains = \"small\" alone"
        } else {
            return Ok(());
        };
        return Err(KeyFault::new(model.child("form"), reason));
    }
    if is_true && !is_static {
        let reason = "true strains are not proportional to the load, as the paths of fracture and modes are: they are for elastic \
                      analyses; take \"small\"";
        return Err(KeyFault::new(model.child("strains"), reason));
    }
    Ok(())
}

/// The fault of a case that has the law but not what its elements need: the rows and columns of a square lattice, no correction beside
/// their own factors, and nothing that looks at forces between two points.
pub(super) fn check(case: &Case) -> Result<(), KeyFault> {
    check_criteria(case)?;
    if case.model.law != Law::MbbPd {
        return Ok(());
    }
    check_variants(case)?;
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
    if case.correction.alpha.0 != Alpha::None {
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
