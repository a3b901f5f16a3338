//! Runs of bodies whose bonds are shared out among several ranks, against one process with its factor. The ranks are threads.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::sync::Arc;

use ligament::run::{follow, restore};
use ligament::{Loading, Message};
use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};
use ligament_analysis::driver::{Outcome, Problem};
use ligament_analysis::history::{
    BreakRecord, Moment, Observer, ObserverError, Onward, StepRecord, View,
};
use ligament_analysis::result_fields::{FieldValues, STRESS_PRINCIPAL};
use ligament_analysis::state::State;
use ligament_analysis::{Termination, fields};
use ligament_model::subdomain::Subdomain;
use ligament_run::model::{Model, build_model_on};
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;
use verification::bench::case;
use verification::numbers::deviation;
use verification::problems::SQUARE;
use verification::threads_as_ranks::{joined, on_ranks};

/// Ranks that do not divide the points evenly, nor are a power of two.
const RANKS: usize = 3;

/// Dense factors leave rounding, which breakages magnify: a residual of 1e-8 after a breakage, times some 10 to 100.
const NEAR: f64 = 1e-6;

const TIE: &str = "fracture.tie_tolerance=1e-6";

/// Block of a lattice in space with a starter crack, which its ends pull apart.
const BLOCK: &str = r#"
solid_lattice = { cells = [7, 5, 4], spacing = [0.01, 0.01, 0.01], set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 30e9, poisson = 0.2, fracture_energy = 50.0 }
model = { law = "nhpd", horizon_factor = 2.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0, z = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-3, y = 2e-4 } }]
probe = [{ name = "stress", at = [0.035, 0.025, 0.02], field = "stress_virial.xx" }, { name = "damage", at = [0.035, 0.025, 0.02], field = "damage" }, { name = "by-material", at = [0.035, 0.025, 0.02], field = "stress_principal.1" }]
[fracture]
control = "event"
tie_tolerance = 1e-6
stop = { bonds = 80 }
[[fracture.criterion]]
kind = "critical-stretch"
"#;

/// Notched plate whose bonds soften.
const SOFTENING: &str = r#"
lattice = { cells = [9, 9], spacing = 0.005, set = { bottom = { bottom = 2 }, top = { top = 2 } } }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6, fracture_energy = 30.0 }
model = { law = "mppd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.1, 0.0225], [0.0151, 0.0225]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", displacement = { y = 4e-5 } }]
no_fail = [{ group = "bottom" }, { group = "top" }]
probe = [{ name = "below", section = [[-0.01, 0.0145], [0.07, 0.0145]], component = "y" }, { name = "stress", at = [0.032, 0.031], field = "stress.yy" }]
[fracture]
steps = 8
[[fracture.criterion]]
kind = "bond-energy"
after = "linear"
"#;

/// Two loads one after the other, followed from breakage to breakage.
const STAGED: &str = r#"
mesh = { file = "reference/square.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [
    { name = "across", group = "top", force = { x = 5e2 } },
    { name = "up", group = "top", force = { y = 2e6 } },
]
stage = [{ name = "first", loads = { across = 1.0 } }, { name = "then", loads = { up = 1.0 } }]
fracture = { control = "event", tie_tolerance = 1e-6, stop = { bonds = 30 } }
"#;

/// What a run told, and a checkpoint.
#[derive(Default)]
struct Seen {
    breaks: Vec<BreakRecord>,
    messages: Vec<Message>,
    parts: Vec<Vec<usize>>,
    softened: Vec<usize>,
    /// Damage, energy density and largest principal stress of the own points after each step, without a stress 0.
    at_points: Vec<Vec<[f64; 4]>>,
    /// The moment at which a checkpoint is kept.
    keeps_at: Option<usize>,
    moments: usize,
    checkpoint: Option<(usize, Vec<u8>)>,
    /// Points of the rank.
    subdomain: Option<Subdomain>,
}

impl Observer for Seen {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.breaks.extend_from_slice(records);
        Ok(())
    }

    fn message(&mut self, message: Message) -> Result<(), ObserverError> {
        self.messages.push(message);
        Ok(())
    }

    fn asks(&mut self, _: Option<&Termination>) -> Result<bool, ObserverError> {
        Ok(self.keeps_at == Some(self.moments))
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if self.keeps_at == Some(self.moments) {
            self.checkpoint = Some((self.breaks.len(), moment.bytes()));
        }
        self.moments += 1;
        Ok(Onward::Go)
    }

    fn step(&mut self, _: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        let extents = view.fragments.extents.iter();
        self.parts.push(extents.map(|it| it.n_points).collect());
        self.softened.push(view.softened_bonds());
        let (system, state, deformations) = (view.system, view.state, &view.balanced.deformations);
        let damage = fields::damage(system, &state.intact);
        let energy = fields::strain_energy_density(system, state.bonds(), deformations, &[]);
        let own = |point: &u32| system.subdomain.owns(*point);
        let points = (0..system.n_points() as u32).filter(own);
        let Some(FieldValues::Numbers(stress)) = STRESS_PRINCIPAL.values(view) else {
            panic!("stresses are numbers")
        };
        let count = stress.len() / system.n_points();
        let of_point = |it: u32| {
            let place = it as usize;
            let largest = Some(stress[count * place]).filter(|it| !it.is_nan());
            [
                f64::from(system.subdomain.number(it)),
                damage[place],
                energy[place],
                largest.unwrap_or(0.0),
            ]
        };
        self.at_points.push(points.map(of_point).collect());
        Ok(())
    }
}

/// A model of a case in the plane or in space, and the problem of its loads.
enum Body {
    Plane(Model),
    Space(Model),
}

fn body(text: &str, settings: &[&str], ranks: Arc<dyn MatrixCommunicator>) -> Body {
    let case = case(text, settings);
    let (mut stages, progress) = (Stages::default(), Progress::new(ProgressMode::Quiet));
    if case.case.is_solid() {
        Body::Space(build_model_on(&case, ranks, &mut stages, &progress).unwrap())
    } else {
        Body::Plane(build_model_on(&case, ranks, &mut stages, &progress).unwrap())
    }
}

fn problem(model: &Model) -> Problem {
    Loading::new(model).unwrap().problem(model)
}

/// Follows a body from its unloaded state or from a checkpoint.
fn followed(
    (text, settings): (&str, &[&str]),
    ranks: Arc<dyn MatrixCommunicator>,
    from: Option<&[u8]>,
    mut seen: Seen,
) -> (Outcome, Seen) {
    let (problem, analysis) = match &body(text, settings, ranks.clone()) {
        Body::Plane(model) => (problem(model), model.setup.analysis.clone()),
        Body::Space(model) => (problem(model), model.setup.analysis.clone()),
    };
    let subdomain = &problem.system.subdomain;
    assert_eq!(subdomain.is_whole(), ranks.size() == 1);
    seen.subdomain = Some(subdomain.clone());
    let outcome = match from {
        None => follow(&problem, &analysis, &mut seen).unwrap(),
        Some(mut from) => {
            let restored = restore(&problem, &analysis, &mut from).unwrap();
            restored.resume(&mut seen).unwrap()
        }
    };
    (outcome, seen)
}

/// Bonds in the order of breaking.
fn order(seen: &Seen) -> Vec<(usize, usize, usize, u32, [u32; 2], usize)> {
    let keys = |it: &BreakRecord| (it.order, it.step, it.round, it.bond, it.ends, it.criterion);
    seen.breaks.iter().map(keys).collect()
}

/// Columns of the history: energies, forces of all groups as one, probes.
fn columns(outcome: &Outcome) -> Vec<Vec<f64>> {
    let rows = outcome.history.iter();
    let own: [fn(&StepRecord) -> f64; 8] = [
        |it| it.load_factor,
        |it| it.displacement,
        |it| it.reaction,
        |it| it.stored_energy,
        |it| it.released_energy,
        |it| it.external_work,
        |it| it.dissipated_energy,
        |it| it.largest_ratio,
    ];
    let mut columns: Vec<Vec<f64>> = own
        .iter()
        .map(|of| rows.clone().map(of).collect())
        .collect();
    columns.push(
        rows.clone()
            .flat_map(|it| it.group_forces.concat())
            .collect(),
    );
    let n_probes = outcome.history[0].probes.len();
    columns.extend((0..n_probes).map(|k| rows.clone().map(|it| it.probes[k]).collect()));
    columns
}

/// Counts of the history.
fn counts(outcome: &Outcome) -> Vec<[usize; 4]> {
    let row = |it: &StepRecord| [it.broken_bonds, it.broken_in_step, it.rounds, it.fragments];
    outcome.history.iter().map(row).collect()
}

/// Largest deviation of columns of a history from those of another one, each relative to its largest value.
fn off(one: &Outcome, other: &Outcome) -> f64 {
    let both = columns(one).into_iter().zip(columns(other));
    let off = both.map(|(found, expected)| {
        let is_zero = expected.iter().all(|value| *value == 0.0);
        if is_zero {
            0.0
        } else {
            deviation(&found, &expected)
        }
    });
    off.fold(0.0, f64::max)
}

/// Values of a state at the points of the body, from those of its ranks.
fn at_points<T: Copy>(together: &[(Outcome, Seen)], of: fn(&State) -> &Vec<T>, usual: T) -> Vec<T> {
    let of_rank = |(outcome, seen): &(Outcome, Seen)| {
        (seen.subdomain.clone().unwrap(), of(&outcome.state).clone())
    };
    let of_ranks: Vec<_> = together.iter().map(of_rank).collect();
    let (subdomain, values) = &of_ranks[0];
    joined(&of_ranks, values.len() / subdomain.n_points(), usual)
}

/// Displacements that a rank knows of points of others are those of their owners; it has no number for the rest.
fn compare_ghosts(together: &[(Outcome, Seen)]) {
    let displacement = at_points(together, |state| &state.displacement, f64::NAN);
    assert!(displacement.iter().all(|it| !it.is_nan()));
    for (outcome, seen) in together {
        let subdomain = seen.subdomain.as_ref().unwrap();
        let n_values = outcome.state.displacement.len() / subdomain.n_points();
        let known = outcome.state.displacement.iter().enumerate();
        for (place, value) in known.filter(|(_, value)| !value.is_nan()) {
            assert_eq!(
                *value,
                displacement[subdomain.index_in_body(place, n_values)]
            );
        }
    }
}

/// Several ranks do what one process does, and agree with each other to the bit.
fn compare((text, settings): (&str, &[&str]), (alone, expected): (Outcome, Seen), least: usize) {
    let together = on_ranks(RANKS, |ranks| {
        followed((text, settings), ranks, None, Seen::default())
    });
    assert!(expected.breaks.len() >= least, "{}", expected.breaks.len());
    let first = &together[0].0;
    for (outcome, seen) in &together {
        assert_eq!(order(seen), order(&expected));
        assert_eq!(counts(outcome), counts(&alone));
        assert_eq!(seen.parts, expected.parts);
        assert_eq!(seen.softened, expected.softened);
        assert_eq!(outcome.termination.name(), alone.termination.name());
        assert_eq!(outcome.broken_bonds, alone.broken_bonds);
        assert_eq!(outcome.softened_bonds, alone.softened_bonds);
        let kinds = |seen: &Seen| -> Vec<_> {
            let kinds = seen.messages.iter().map(|it| it.kind.clone());
            kinds.collect()
        };
        assert_eq!(kinds(seen), kinds(&expected));
        assert_eq!(outcome.history, first.history);
        assert!(outcome.state.intact.len() < alone.state.intact.len());
    }
    compare_ghosts(&together);
    let held = at_points(&together, |state| &state.held, false);
    assert_eq!(held, alone.state.held);
    let history = off(first, &alone);
    println!(
        "{} bonds, history off by {history:.1e}",
        expected.breaks.len()
    );
    assert!(history < NEAR, "{history:e}");
    // A body that came apart has rounding alone: fields are judged by the largest value of all steps.
    for field in [1, 2, 3] {
        let of = |rows: &[[f64; 4]]| rows.iter().map(|it| it[field]).collect::<Vec<f64>>();
        let whole: Vec<f64> = expected.at_points.iter().flat_map(|it| of(it)).collect();
        let joined = (0..expected.at_points.len()).flat_map(|step| {
            let of_ranks = together.iter();
            let mut all: Vec<[f64; 4]> = of_ranks
                .flat_map(|it| it.1.at_points[step].clone())
                .collect();
            all.sort_by(|one, other| one[0].total_cmp(&other[0]));
            of(&all)
        });
        let off = deviation(&joined.collect::<Vec<f64>>(), &whole);
        assert!(off < NEAR, "field {field}: {off:e}");
    }
}

fn against_one_process(text: &str, settings: &[&str], least: usize) {
    let alone = followed(
        (text, settings),
        Arc::new(SingleProcess),
        None,
        Seen::default(),
    );
    compare((text, settings), alone, least);
}

/// Load steps and the exact path to the end, where parts of the body came loose and are held.
#[test]
fn bonds_break_and_parts_come_loose() {
    let until_loose =
        "fracture={ steps = 50, tie_tolerance = 1e-6, stop = { load_fraction = 0.01 } }";
    let event =
        "fracture={ control = \"event\", tie_tolerance = 1e-6, stop = { load_fraction = 0.01 } }";
    against_one_process(SQUARE, &[until_loose], 60);
    against_one_process(SQUARE, &[event], 60);
}

#[test]
fn a_solid_breaks() {
    against_one_process(BLOCK, &[], 80);
}

#[test]
fn stages_are_followed() {
    against_one_process(STAGED, &[], 30);
}

/// Equilibria of bonds that soften are found to a residual of 1e-8, and one process gets there with other factors, so that bonds which are
/// nearly tied break in another order: the reference is one rank that has all bonds.
#[test]
fn bonds_soften() {
    let one = on_ranks(1, |ranks| {
        followed((SOFTENING, &[]), ranks, None, Seen::default())
    });
    compare((SOFTENING, &[]), one.into_iter().next().unwrap(), 60);
}

/// Strains of points come from bonds whose other ends lie on other ranks: along the exact path by the stress across the bonds, and with
/// bonds that begin to soften by the stress around them. 1 and 3 ranks as for the others that soften.
#[test]
fn criteria_of_stress_see_the_bonds_of_all_ranks() {
    let event = "fracture={ control = \"event\", tie_tolerance = 1e-6, stop = { bonds = 60 }, criterion = [{ kind = \"bond-rankine\" }] }";
    against_one_process(SQUARE, &[event], 60);
    let rankine = ["fracture.criterion=[{ kind = \"rankine\", after = \"linear\" }]"];
    let one = on_ranks(1, |ranks| {
        followed((SOFTENING, &rankine), ranks, None, Seen::default())
    });
    compare((SOFTENING, &rankine), one.into_iter().next().unwrap(), 20);
}

/// What several ranks have written others go on with, also one process, and so they do with what they have written themselves.
#[test]
fn any_number_goes_on_from_a_checkpoint() {
    let event = "fracture={ control = \"event\", tie_tolerance = 1e-6, stop = { bonds = 60 } }";
    let cases: [(&str, &[&str], usize); 3] = [
        (SQUARE, &[TIE], 30),
        (SQUARE, &[event], 20),
        (SOFTENING, &[], 4),
    ];
    for (text, settings, keeps_at) in cases {
        let keeping = || Seen {
            keeps_at: Some(keeps_at),
            ..Seen::default()
        };
        let whole = on_ranks(RANKS, |ranks| {
            followed((text, settings), ranks, None, keeping())
        });
        let (outcome, seen) = &whole[0];
        let (broken, checkpoint) = seen.checkpoint.as_ref().unwrap();
        let gone_on = |ranks: Arc<dyn MatrixCommunicator>| {
            let went = followed((text, settings), ranks, Some(checkpoint), Seen::default());
            assert_eq!(order(&went.1), order(seen)[*broken..]);
            assert_eq!(counts(&went.0), counts(outcome));
            assert_eq!(went.0.broken_bonds, outcome.broken_bonds);
            (off(&went.0, outcome), went.0)
        };
        let (alone, _) = gone_on(Arc::new(SingleProcess));
        let two = on_ranks(2, |ranks| gone_on(ranks).0)[0];
        println!("{broken} bonds before; one process off by {alone:.1e}, two ranks by {two:.1e}");
        assert!(alone < NEAR && two < NEAR);
        // As many go on to the bit.
        let same = on_ranks(RANKS, |ranks| gone_on(ranks).1);
        assert_eq!(same[0].history, outcome.history);
    }
}
