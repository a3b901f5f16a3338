//! Equations that several ranks solve together, against one process with its factor. The ranks are threads here; `tools/check_ranks.py`
//! has processes.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::SetupError;
use std::sync::Arc;

use ligament_analysis::distributed_matrix::MatrixCommunicator;
use ligament_analysis::solver::{DistributedChoice, Reason, SolverChoice, Unfit};
use verification::bench::{Bench, Run};
use verification::numbers::deviation;
use verification::problems::{PLATE, SQUARE};
use verification::threads_as_ranks::{joined, on_ranks};

/// Dense factors leave rounding: 1e-16 times a condition number of some 1e6.
const EXACT: f64 = 1e-9;

/// Ranks that do not divide the points evenly, nor are a power of two.
const RANKS: usize = 3;

const EVENT: &str = "fracture={ control = \"event\", tie_tolerance = 1e-6, stop = { bonds = 60 } }";

/// Elements that couple more than their ends.
const LATTICE: &str = r#"
lattice = { cells = [12, 8], spacing = 0.002, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.1 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { x = 1e-5, y = 1e-5 } }]
"#;

/// What is compared of a run.
#[derive(Debug, Clone, PartialEq)]
struct Seen {
    bonds: Vec<(usize, usize, u32)>,
    reactions: Vec<f64>,
    displacement: Vec<f64>,
    held: Vec<usize>,
    end: &'static str,
}

fn seen(run: &Run) -> Seen {
    let breaks = run.breaks.iter();
    let rows = run.outcome.history.iter();
    Seen {
        bonds: breaks.map(|it| (it.step, it.round, it.bond)).collect(),
        reactions: rows.map(|row| row.reaction).collect(),
        displacement: run.displacement().to_vec(),
        held: run.held.clone(),
        end: run.outcome.termination.name(),
    }
}

fn bench(text: &str, settings: &[&str], together: Arc<dyn MatrixCommunicator>) -> Bench {
    Bench::on_ranks(text, settings, together)
}

/// One process and several ranks, which must have seen the same to the bit; displacements are those of the owners.
fn both(text: &str, settings: &[&str], run: impl Fn(&Bench) -> Run + Sync) -> [Seen; 2] {
    let alone = seen(&run(&Bench::new(text, settings)));
    let of_ranks = on_ranks(RANKS, |ranks| {
        let bench = bench(text, settings, ranks);
        let run = run(&bench);
        assert!(matches!(
            run.outcome.solver,
            SolverChoice::Distributed(DistributedChoice { n_ranks: RANKS, .. })
        ));
        let mut seen = seen(&run);
        let subdomain = bench.model.system.subdomain.clone();
        let own = (subdomain, std::mem::take(&mut seen.displacement));
        (seen, own)
    });
    let (together, own): (Vec<Seen>, Vec<_>) = of_ranks.into_iter().unzip();
    assert!(together.iter().all(|it| *it == together[0]));
    let n_values = own[0].1.len() / own[0].0.n_points();
    let displacement = joined(&own, n_values, 0.0);
    [
        alone,
        Seen {
            displacement,
            ..together[0].clone()
        },
    ]
}

/// Restraints that couple points, elements that couple more than their ends, and bonds with negative stiffness, which take a factor.
#[test]
fn elastic_answers_are_those_of_one_process() {
    let pull = "load=[{ group = \"right\", displacement = { x = 1e-5 } }]";
    let platen = "support=[{ group = \"left\", stiffness = { x = 2e10 } }, { group = \"corner\", stiffness = { normal = 1e9 }, normal = [0.6, 0.8] }]";
    let cases: [(&str, &[&str]); 5] = [
        (PLATE, &[pull]),
        (PLATE, &[pull, platen]),
        (
            PLATE,
            &[pull, "material.poisson=0.4", "model.poisson=bonds"],
        ),
        (PLATE, &[pull, "solver.method=direct"]),
        (LATTICE, &[]),
    ];
    for (text, settings) in cases {
        let [alone, together] = both(text, settings, Bench::solve);
        let off = deviation(&together.displacement, &alone.displacement);
        let force = deviation(&together.reactions, &alone.reactions);
        println!("{settings:?}: off by {off:.1e}, force {force:.1e}");
        assert!(off < EXACT && force < EXACT, "{settings:?}");
    }
}

/// Bonds break in the same order in load steps and along the exact path, until parts come loose and are held.
#[test]
fn bonds_break_as_with_one_process() {
    for settings in [&["fracture.tie_tolerance=1e-6"][..], &[EVENT]] {
        let [alone, together] = both(SQUARE, settings, Bench::break_up);
        assert!(alone.bonds.len() >= 60, "{settings:?}");
        assert_eq!(together.bonds, alone.bonds, "{settings:?}");
        assert_eq!(together.held, alone.held, "{settings:?}");
        assert_eq!(together.end, alone.end, "{settings:?}");
        let force = deviation(&together.reactions, &alone.reactions);
        println!(
            "{settings:?}: {} bonds, force off by {force:.1e}",
            alone.bonds.len()
        );
        // A residual of 1e-8 after a breakage, times some 10 to 100.
        assert!(force < 1e-6, "{force:e}");
    }
}

/// What ranks cannot solve is refused by name on all of them.
#[test]
fn what_ranks_cannot_solve_is_refused() {
    let pull = "load=[{ group = \"right\", displacement = { x = 1e-5 } }]";
    let cases: [(&str, &[&str], Unfit); 4] = [
        (LATTICE, &["model.form=pairwise"], Unfit::WithoutEnergy),
        (LATTICE, &["model.strains=\"true\""], Unfit::NotLinear),
        (PLATE, &[pull, "model.closing=true"], Unfit::ClosingFaces),
        (
            PLATE,
            &[pull, "solver.factorisation=ldlt"],
            Unfit::NamedForFactor("factorisation"),
        ),
    ];
    for (text, settings, unfit) in cases {
        let refused = on_ranks(2, |ranks| {
            let problem = bench(text, settings, ranks).problem();
            match ligament_analysis::Equilibrium::new(&problem, 1e-4) {
                Err(SetupError::NotDistributed(found)) => found,
                other => panic!("{settings:?}: {:?}", other.map(|it| *it.choice())),
            }
        });
        assert_eq!(refused, [unfit, unfit]);
    }
}

/// A body with negative stiffnesses says why it takes a factor.
#[test]
fn the_choice_says_why() {
    let pull = "load=[{ group = \"right\", displacement = { x = 1e-5 } }]";
    let choice = |settings: &[&str]| {
        on_ranks(2, |ranks| {
            bench(PLATE, settings, ranks).solve().outcome.solver
        })[0]
    };
    let of = |reason, tolerance| {
        SolverChoice::Distributed(DistributedChoice {
            reason,
            n_ranks: 2,
            tolerance,
        })
    };
    assert_eq!(choice(&[pull]), of(Reason::Definite, Some(1e-8)));
    let negative = Reason::Unfit(Unfit::Indefinite);
    assert_eq!(
        choice(&[pull, "material.poisson=0.4", "model.poisson=bonds"]),
        of(negative, None)
    );
    assert_eq!(
        choice(&[pull, "solver.method=direct"]),
        of(Reason::Named, None)
    );
}
