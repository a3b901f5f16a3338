//! Natural modes against closed forms, against dense eigenvalues and for what any set of modes must keep.
//!
//! Frequencies of lattices against an independent program and published numbers are in `lattices`.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::sync::Arc;

use std::f64::consts::PI;

use ligament_analysis::balanced::Stability;
use ligament_analysis::load_program::ControlKind;
use ligament_analysis::modal::{
    ModalAnalysis, ModalOutcome, ModalProblem, ModalSettings, Mode, ModeKind, Rotations,
};
use ligament_analysis::{Component, Message, SolverSettings, Supports};
use ligament_model::element::StiffnessFactors;
use ligament_model::{BondSystem, LumpedMass};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use verification::modal::ModalBench;
use verification::numbers::{largest, relative_error};
use verification::trusses::{Rod, Truss};

/// Square of side 0.1 m and 137 irregular points, free.
const SQUARE: &str = r#"
analysis = "modal"
mesh = { file = "reference/square.msh" }
material = { young = 15e9, poisson = 0.21, density = 2500 }
model = { law = "nhpd", horizon_factor = 3.0 }
"#;

/// The square with its lower side held.
const HELD: &str = r#"support=[{group="bottom",displacement={x=0,y=0,rotation=0}}]"#;

/// Beam 1 x 0.05 x 0.01 m of 200 x 10 cells.
const BEAM: &str = r#"
analysis = "modal"
lattice = { cells = [200, 10], spacing = 0.005, thickness = 0.01, set = { end = { left = 1 } } }
material = { young = 70e9, poisson = 0.21, density = 2700 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "end", displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]
modal = { modes = 5 }
"#;

fn shares(outcome: &ModalOutcome, mode: &Mode) -> [f64; 3] {
    let shares = outcome.moving.shares(&mode.participation);
    [0, 1, 2].map(|k| shares[k])
}

fn elastic(outcome: &ModalOutcome) -> impl Iterator<Item = &Mode> {
    let modes = outcome.modes.iter();
    modes.filter(|mode| mode.kind == ModeKind::Elastic)
}

/// Frequencies of a Timoshenko cantilever, Hz: the roots of Huang's equation (J. Appl. Mech. 28, 1961) for b = omega L^2
/// sqrt(rho A/(E I)), with r^2 = I/(A L^2), s^2 = E I/(k A G L^2) and k = 5/6.
fn timoshenko(length: f64, height: f64, young: f64, poisson: f64, density: f64) -> Vec<f64> {
    let r2 = (height / length).powi(2) / 12.0;
    let s2 = r2 * 2.0 * (1.0 + poisson) * 1.2;
    let equation = |b: f64| {
        let root = ((r2 - s2).powi(2) + 4.0 / (b * b)).sqrt();
        let [alpha, beta] = [root - r2 - s2, root + r2 + s2].map(|x| b * (0.5 * x).sqrt());
        2.0 + (b * b * (r2 - s2).powi(2) + 2.0) * alpha.cosh() * beta.cos()
            - b * (r2 + s2) / (1.0 - b * b * r2 * s2).sqrt() * alpha.sinh() * beta.sin()
    };
    let unit = (young / density * r2).sqrt() / length;
    let step = 1e-3;
    let changes = (1..70_000).map(|k| f64::from(k) * step);
    changes
        .filter(|&b| equation(b) * equation(b + step) < 0.0)
        .map(|b| {
            let (here, there) = (equation(b), equation(b + step));
            (b + step * here / (here - there)) * unit / (2.0 * PI)
        })
        .collect()
}

/// Slender cantilever against Timoshenko's beam of the free length: from the held column of cells, 0.995 m and half a cell.
///
/// 0.5 %: the closed form knows no lateral contraction at the clamp, and the model's bending stiffness depends on how many
/// cells the height has; measured -0.27, -0.25 and -0.22 %.
#[test]
fn bending_of_a_slender_cantilever() {
    let outcome = ModalBench::new(BEAM, &[]).find();
    let bending = elastic(&outcome)
        .filter(|mode| shares(&outcome, mode)[1] > shares(&outcome, mode)[0])
        .map(Mode::frequency);
    let expected = timoshenko(0.9975, 0.05, 70e9, 0.21, 2700.0);
    let euler =
        1.875104_f64.powi(2) * (70e9_f64 / 2700.0 / 12.0).sqrt() * 0.05 / 0.9975_f64.powi(2);
    assert!(
        relative_error(expected[0], euler / (2.0 * PI)) < 3e-3,
        "near Euler and Bernoulli"
    );
    for (found, expected) in bending.take(3).zip(expected) {
        println!(
            "bending: {found:.3} Hz, {:+.3} %",
            100.0 * (found / expected - 1.0)
        );
        assert!(relative_error(found, expected) < 5e-3);
    }
}

/// The same body as a rod, nu = 0. Closed form: f_n = (2n - 1)/(4 L) sqrt(E/rho), effective masses 8/((2n - 1)^2 pi^2) of the
/// moving mass.
///
/// 0.2 % and 0.002 of the mass: dispersion of the lattice is some (k delta)^2/24, below 1e-4 here; the bonds next to the clamp
/// see one held column where the continuum has a wall, which moves it by a part of a cell (0.5 % of the length). Measured
/// +0.04 and +0.03 %, 0.0007 of the mass.
#[test]
fn longitudinal_vibration_of_a_rod() {
    let outcome = ModalBench::new(BEAM, &["material.poisson=0", "modal.modes=16"]).find();
    let axial: Vec<&Mode> = elastic(&outcome)
        .filter(|mode| shares(&outcome, mode)[0] > 0.01)
        .collect();
    for (n, mode) in axial.iter().take(2).enumerate() {
        let odd = 2.0 * n as f64 + 1.0;
        let expected = odd / (4.0 * 0.9975) * (70e9_f64 / 2700.0).sqrt();
        let mass = 8.0 / (odd * PI).powi(2);
        let share = shares(&outcome, mode)[0];
        println!(
            "axial: {:+.3} %, mass {share:.4} for {mass:.4}",
            100.0 * (mode.frequency() / expected - 1.0)
        );
        assert!(relative_error(mode.frequency(), expected) < 2e-3);
        assert!((share - mass).abs() < 2e-3);
    }
    assert!(axial.len() >= 2);
}

/// A truss of axial rods along x: three points, two springs k, two or three masses m. By hand: held at one end omega^2 m/k is
/// (3 -+ sqrt 5)/2, free 0, 1 and 3. A solution of two or three unknowns is exact to rounding; the rigid one is below 1e-12.
#[test]
fn three_masses_on_two_springs() {
    let rod = |a: u32| Rod {
        ends: [a, a + 1],
        stiffness: 2e6,
        critical_elongation: 1.0,
    };
    let mut truss = Truss::new(&[0.0, 1.0, 3.0], &[rod(0), rod(1)], ControlKind::Force, 2);
    truss.system.rigidities.shear.fill(0.0);
    truss.system.rigidities.rotational.fill(0.0);
    let mass = LumpedMass {
        mass: vec![0.5; 3],
        inertia: vec![1.0; 3],
    };
    let root = 5_f64.sqrt();
    for (held, expected) in [
        (true, vec![0.5 * (3.0 - root), 0.5 * (3.0 + root)]),
        (false, vec![0.0, 1.0, 3.0]),
    ] {
        let mut supports = Supports::none(truss.system.clone().with_elements().topology().layout);
        supports.hold("line", vec![0, 1, 2], &[Component::Y]);
        if held {
            supports.hold("end", vec![0], &[Component::X]);
        }
        let outcome = modes_of(truss.system.clone(), &mass, &supports, 3, None);
        assert_eq!(outcome.modes.len(), expected.len());
        assert_eq!(outcome.rigid_motions, usize::from(!held));
        for (mode, expected) in outcome.modes.iter().zip(expected) {
            let value = mode.eigenvalue * 0.5 / 2e6;
            assert!((value - expected).abs() < 1e-12, "{value} for {expected}");
        }
    }
}

fn modes_of(
    system: BondSystem,
    mass: &LumpedMass,
    supports: &Supports,
    modes: usize,
    rotations: Option<Rotations>,
) -> ModalOutcome {
    let problem = ModalProblem {
        system: system.with_elements(),
        mass: Arc::new(mass.clone()),
        supports: Arc::new(supports.clone()),
        solver: SolverSettings::default(),
    };
    let settings = ModalSettings {
        modes,
        rotations,
        tolerance: 1e-10,
    };
    ModalAnalysis::new(&problem, settings)
        .unwrap()
        .find()
        .unwrap()
}

/// Stiffness of the unknowns as a dense matrix, from the elements' rows.
fn dense_stiffness(bench: &ModalBench, dofs: &[(usize, f64)]) -> DMatrix<f64> {
    let system = &**bench.model.plane();
    let mut place = vec![usize::MAX; system.topology().layout.n_degrees_of_freedom()];
    for (k, (dof, _)) in dofs.iter().enumerate() {
        place[*dof] = k;
    }
    let mut matrix = DMatrix::zeros(dofs.len(), dofs.len());
    for bond in 0..system.bonds.len() {
        for (rigidity, mut row) in system.terms(&[], bond, &StiffnessFactors::WHOLE) {
            row.retain(|(dof, _)| place[*dof] != usize::MAX);
            for &(i, a) in &row {
                for &(j, b) in &row {
                    matrix[(place[i], place[j])] += rigidity * a * b;
                }
            }
        }
    }
    matrix
}

/// All eigenvalues omega^2 by nalgebra, ascending: rotations without mass are condensed, K_uu - K_ur K_rr^-1 K_ru.
fn dense_eigenvalues(bench: &ModalBench, rotations: Rotations) -> Vec<f64> {
    let mut dofs = bench.unknown_masses(rotations);
    dofs.sort_by_key(|(dof, mass)| (*mass == 0.0, *dof));
    let whole = dense_stiffness(bench, &dofs);
    let n = dofs.iter().filter(|(_, mass)| *mass > 0.0).count();
    let rest = dofs.len() - n;
    let mut matrix = whole.view((0, 0), (n, n)).into_owned();
    if rest > 0 {
        let coupling = whole.view((n, 0), (rest, n)).into_owned();
        let block = whole.view((n, n), (rest, rest)).into_owned();
        matrix -= coupling.transpose() * block.lu().solve(&coupling).unwrap();
    }
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (dofs[i].1 * dofs[j].1).sqrt());
    let mut values: Vec<f64> = SymmetricEigen::new(scaled)
        .eigenvalues
        .iter()
        .copied()
        .collect();
    values.sort_by(f64::total_cmp);
    values
}

/// Held and free, with and without rotational inertia, below and above nu = 1/3: the 20 lowest of 274 to 411 eigenvalues
/// against a dense decomposition, which shares neither factor nor search. It is exact to rounding (1e-15) of the largest,
/// 3e3 times the lowest elastic one: 1e-10 of each is allowed, and for the rigid ones of the first elastic.
#[test]
fn modes_are_those_of_a_dense_decomposition() {
    let cases: [(&str, &str, Rotations); 5] = [
        ("0.21", HELD, Rotations::Inertia),
        ("0.21", "support=[]", Rotations::Inertia),
        ("0.21", "support=[]", Rotations::Massless),
        ("0.38", HELD, Rotations::Massless),
        ("0.38", "support=[]", Rotations::Massless),
    ];
    for (poisson, support, rotations) in cases {
        let word = if rotations == Rotations::Inertia {
            "inertia"
        } else {
            "massless"
        };
        let settings = [
            format!("material.poisson={poisson}"),
            format!("modal.rotations={word}"),
        ];
        let by_bonds = "model.poisson=bonds";
        let bench = ModalBench::new(
            SQUARE,
            &[
                &settings[0],
                &settings[1],
                support,
                "modal.modes=20",
                by_bonds,
            ],
        );
        let outcome = bench.find();
        let expected = dense_eigenvalues(&bench, rotations);
        let first = elastic(&outcome).next().unwrap().eigenvalue;
        let rigid = if support == HELD { 0 } else { 3 };
        assert_eq!((outcome.modes.len(), outcome.rigid_motions), (20, rigid));
        assert_eq!(
            (outcome.complete, &outcome.messages),
            (Some(true), &Vec::new())
        );
        for (k, (mode, expected)) in outcome.modes.iter().zip(expected).enumerate() {
            assert_eq!(
                mode.kind == ModeKind::Rigid,
                k < rigid,
                "{poisson} {support} {word}"
            );
            let error = (mode.eigenvalue - expected).abs() / expected.abs().max(first);
            assert!(
                error < 1e-10,
                "{poisson} {support} {word} mode {k}: {error:.1e}"
            );
        }
    }
}

/// All modes of the held square: orthonormal with M, diagonal with K (by the dense matrix), and the effective masses add up to
/// what moves. Sums of 300 products of numbers near one are exact to 1e-13; 1e-9 of the largest eigenvalue covers what K makes
/// of an angle of 1e-11 between two shapes.
#[test]
fn all_modes_are_orthogonal_and_move_all_of_the_mass() {
    let bench = ModalBench::new(SQUARE, &[HELD, "modal.modes=1000"]);
    let outcome = bench.find();
    let dofs = bench.unknown_masses(Rotations::Inertia);
    let n = dofs.len();
    assert_eq!(outcome.modes.len(), n);
    let fewer = format!("the body has {n} modes with mass, 1000 were asked for");
    assert_eq!(outcome.messages, [Message::new("fewer-modes", fewer)]);
    let shapes = DMatrix::from_fn(n, n, |row, k| outcome.modes[k].shape[dofs[row].0]);
    let mass = DMatrix::from_diagonal(&DVector::from_iterator(n, dofs.iter().map(|it| it.1)));
    let highest = outcome.modes[n - 1].eigenvalue;
    let identity = shapes.transpose() * mass * &shapes - DMatrix::identity(n, n);
    assert!(largest(identity.iter().copied()) < 1e-10);
    let mut products = shapes.transpose() * dense_stiffness(&bench, &dofs) * &shapes;
    for (k, mode) in outcome.modes.iter().enumerate() {
        products[(k, k)] -= mode.eigenvalue;
    }
    assert!(largest(products.iter().copied()) < 1e-9 * highest);
    for k in 0..3 {
        let together: f64 = (outcome.modes.iter())
            .map(|mode| shares(&outcome, mode)[k])
            .sum();
        assert!((together - 1.0).abs() < 1e-10, "{together}");
    }
    let moving: f64 = (dofs.iter().filter(|(dof, _)| dof % 3 == 0))
        .map(|(_, mass)| mass)
        .sum();
    assert!(relative_error(outcome.moving.free[0], moving) < 1e-13);
    assert!(
        relative_error(outcome.moving.total, 2500.0 * 0.01) < 1e-12,
        "square of side 0.1 m"
    );
}

/// Held along y only, the square may move along x: one rigid mode, that moves all of the mass along x. At one corner it turns
/// about it instead. Where bonds have no rotations, a rotation costs energy, and a free body has two rigid modes.
#[test]
fn rigid_modes_are_what_supports_and_bonds_leave() {
    let along_y = r#"support=[{group="bottom",displacement={y=0}}]"#;
    let outcome = ModalBench::new(SQUARE, &[along_y]).find();
    assert_eq!(outcome.rigid_motions, 1);
    let [first, second] = [&outcome.modes[0], &outcome.modes[1]];
    assert_eq!(
        [first.kind, second.kind],
        [ModeKind::Rigid, ModeKind::Elastic]
    );
    assert!((shares(&outcome, first)[0] - 1.0).abs() < 1e-12);
    assert!(first.eigenvalue < 1e-12 * second.eigenvalue);

    let pinned = r#"support=[{group="corner",displacement={x=0,y=0}}]"#;
    let outcome = ModalBench::new(SQUARE, &[pinned]).find();
    assert_eq!(outcome.rigid_motions, 1);
    let shape = &outcome.modes[0].shape;
    let turn = shape[2];
    assert!(
        turn != 0.0
            && shape
                .iter()
                .skip(2)
                .step_by(3)
                .all(|it| relative_error(*it, turn) < 1e-9)
    );

    let springs = ModalBench::new(SQUARE, &["model.law=pds"]).find();
    assert_eq!(springs.rigid_motions, 2);
    let rigid = springs
        .modes
        .iter()
        .filter(|mode| mode.kind == ModeKind::Rigid);
    assert_eq!((rigid.count(), springs.complete), (2, Some(true)));
}

/// Five equal squares that nothing connects: fifteen rigid motions, and every frequency of one occurs five times, more often
/// than a block of the search sees. The count finds what is missing, and the search goes on. The iterated correction would not
/// be the same for one square and for five.
#[test]
fn equal_bodies_have_equal_modes() {
    let lattice = |count: u32| {
        let removed: Vec<String> = (1..count)
            .map(|k| {
                format!(
                    "{{ rectangle = [[{0}, -1], [{1}, 1]] }}",
                    f64::from(10 * k) - 4.0,
                    10 * k
                )
            })
            .collect();
        format!(
            "analysis = \"modal\"\nlattice = {{ cells = [{}, 6], spacing = 1.0, remove = [{}] }}\n\
             material = {{ young = 1e9, poisson = 0.21, density = 2500 }}\n\
             model = {{ law = \"nhpd\", horizon_factor = 3.0 }}\ncorrection = {{ surface = \"none\" }}",
            10 * count - 4,
            removed
                .join(",")
                .replace("-1]", "-1.0]")
                .replace("1]]", "10.0]]"),
        )
    };
    let one = ModalBench::new(&lattice(1), &["modal.modes=6"]).find();
    let five = ModalBench::new(&lattice(5), &["modal.modes=30"]).find();
    assert_eq!(five.rigid_motions, 15);
    assert_eq!(five.complete, Some(true), "{:?}", five.messages);
    for (k, mode) in five.modes.iter().enumerate().skip(15) {
        let expected = one.modes[k / 5].eigenvalue;
        let error = relative_error(mode.eigenvalue, expected);
        assert!(error < 1e-10, "mode {k}: {error:.1e}");
    }
}

/// More modes than a basis of 128 vectors gives, all of them exact.
#[test]
fn many_modes_are_as_exact_as_few() {
    let outcome = ModalBench::new(BEAM, &["modal.modes=60"]).find();
    assert_eq!((outcome.modes.len(), outcome.complete), (60, Some(true)));
    assert!(largest(outcome.modes.iter().map(|mode| mode.residual)) < 1e-10);
    assert_eq!(outcome.messages, []);
}

/// An unstable model is told of: nu = 0.45 with a horizon factor of 4 has more negative eigenvalues than rotations.
#[test]
fn an_unstable_model_is_told_of() {
    let settings = [
        "material.poisson=0.45",
        "model.poisson=bonds",
        "model.horizon_factor=4",
    ];
    let outcome = ModalBench::new(SQUARE, &settings).find();
    assert_eq!(outcome.rotations, Rotations::Massless);
    assert_eq!(outcome.messages[0].kind, "massless-rotations");
    let Stability { negative, expected } = outcome.stability.unwrap();
    assert!(negative > expected);
    let told = format!("{negative} negative eigenvalues, {expected} expected");
    assert!(
        outcome.messages.iter().any(|it| it.text.contains(&told)),
        "{:?}",
        outcome.messages
    );
}
