//! Every law with every correction under both drivers, in the plane and in space: which of them run to their end, and which are refused.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;

use ligament::body::{Cells, SolidLatticeBody};
use ligament::prelude::*;
use ligament::setup::{Iteration, Surface};
use ligament_analysis::Termination;
use ligament_model::ElementKind;
use ligament_model::correction::patch;
use ligament_model::law::LAWS;
use ligament_model::material::Space;

const YOUNG: f64 = 30e9;
/// Stretch at which bonds fail by the strength.
const STRETCH: f64 = 1e-4;
const SPACING: f64 = 0.01;

/// Combinations that are refused, as `law correction`, in any dimension and under either driver, each with the reason.
const REFUSED: [(&str, &str); 4] = [
    (
        "mppd-beam volume",
        "the discrete calibration already accounts for surfaces",
    ),
    (
        "mbb-pd volume",
        "the factors psi of `Law::MBB_PD` make all energies right",
    ),
    (
        "mbb-pd domain",
        "the factors psi of `Law::MBB_PD` make all energies right",
    ),
    (
        "mbb-pd patch",
        "the factors psi of `Law::MBB_PD` make all energies right",
    ),
];

fn surfaces() -> [(&'static str, Surface); 4] {
    [
        ("none", Surface::None),
        ("volume", Surface::Volume),
        ("domain", Surface::Domain(Iteration::default())),
        ("patch", Surface::Patch(patch::Settings::default())),
    ]
}

fn drivers() -> [(&'static str, Analysis); 2] {
    let factors = (1..=8).map(|step| f64::from(step) / 8.0).collect();
    [
        ("event", Analysis::Event(event())),
        ("stepped", Analysis::Stepped(stepped(factors))),
    ]
}

/// How a bar of a law ended that is held at one end along x and pulled at the other to a multiple of what its bonds bear, or why it is refused.
fn pulled(
    body: impl Into<AnyBody>,
    law: Law,
    surface: Surface,
    analysis: Analysis,
) -> Result<Termination, String> {
    let mut material = Material::isotropic(YOUNG, 0.2);
    material.tensile_strength = Some(STRETCH * YOUNG);
    material.fracture_energy = Some(STRETCH * STRETCH * YOUNG * SPACING);
    let mut setup = Setup::new(body, material, law);
    setup.horizon = Horizon::Factor(2.5);
    setup.correction.surface = surface;
    setup.supports = vec![Support::new(
        "first",
        &[Component::X, Component::Y, Component::Z][..setup.body.dimensions()],
    )];
    setup.loads = vec![Load::new(
        "last",
        Action::Displacement(Displacement {
            x: Some(0.5 * STRETCH),
            ..Displacement::default()
        }),
    )];
    setup.criteria = vec![(*law.row.criterion).into()];
    setup.analysis = analysis;
    let outcome = setup
        .solve(&mut NoObserver)
        .map_err(|it| it.to_string())?
        .outcome;
    assert!(outcome.broken_bonds > 0, "no bond broke");
    Ok(outcome.termination)
}

/// The ends of a bar of cells.
fn ends<const D: usize, S>() -> BTreeMap<String, Cells<D, S>> {
    let end = |name: &str, normal: i8| {
        let mut normals = [0; D];
        normals[0] = normal;
        (name.to_owned(), Cells::AtSide(normals, 1))
    };
    [end("first", -1), end("last", 1)].into()
}

#[test]
fn every_law_runs_in_its_dimensions_with_its_corrections() {
    let mut failed = Vec::new();
    for law in LAWS.map(Law::usual) {
        for (surface_name, surface) in surfaces() {
            for (driver, analysis) in drivers() {
                let plane =
                    LatticeBody::new([12, 8], [SPACING; 2], [0.0; 2], &[], &ends()).unwrap();
                let mut runs = vec![("plane", pulled(plane, law, surface, analysis.clone()))];
                if law.row.exists_in(Space::Solid) {
                    let solid =
                        SolidLatticeBody::new([5, 4, 4], [SPACING; 3], [0.0; 3], &[], &ends());
                    runs.push(("space", pulled(solid.unwrap(), law, surface, analysis)));
                }
                let combination = format!("{} {surface_name}", law.name());
                let refused = REFUSED.iter().find(|(name, _)| *name == combination);
                for (dimension, found) in runs {
                    println!("{combination} {driver} {dimension}: {found:?}");
                    let is_as_listed = match (&found, refused) {
                        (Err(found), Some((_, reason))) => found.contains(reason),
                        (
                            Ok(
                                Termination::StepsDone
                                | Termination::FullLoad
                                | Termination::FellApart,
                            ),
                            None,
                        ) => true,
                        (Ok(_), _) | (Err(_), None) => false,
                    };
                    if !is_as_listed {
                        failed.push(format!("{combination} {driver} {dimension}: {found:?}"));
                    }
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// What the row of a law says agrees with itself, and its words are those of no other.
#[test]
fn rows_agree_with_themselves() {
    for law in LAWS {
        let word = law.word;
        let element = (law.element)(&law.options);
        assert_eq!(
            law.shear_form.is_some(),
            element == ElementKind::Beam,
            "{word}"
        );
        assert_eq!(
            law.criterion.takes_strains(),
            law.has_own_strains(),
            "{word}"
        );
        assert!(law.couples_ends_alone || law.has_own_strains(), "{word}");
        assert_eq!(
            LAWS.iter().filter(|it| it.word == word).count(),
            1,
            "{word}"
        );
        assert_eq!(Law::usual(law).misplaced_option(), None, "{word}");
    }
}
