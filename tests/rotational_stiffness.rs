//! The rotational stiffness of bonds, free in size: what a bond has of it, and what it makes of a body, against sums and closed forms
//! written here.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::f64::consts::PI;

use ligament_analysis::history::BreakRecord;
use ligament_analysis::internal;
use ligament_analysis::state::UnbrokenBonds;
use ligament_model::ElementKind;
use ligament_model::thermal::ThermalStrain;
use verification::bench::Bench;
use verification::numbers::{Random, of_all, relative_error};
use verification::problems::{DISK, SQUARE};

const YOUNG: f64 = 15e9;
const POISSON: f64 = 0.21;
const SHEAR_MODULUS: f64 = YOUNG / (2.0 * (1.0 + POISSON));

/// Laws whose points turn.
const LAWS: [&str; 4] = ["nhpd", "mppd", "mppd-beam", "orthotropic"];

/// The square elastic, with bonds that no correction changes.
fn square(settings: &[&str]) -> Bench {
    let lines = SQUARE.lines().filter(|line| !line.starts_with("fracture"));
    let text = lines.collect::<Vec<_>>().join("\n");
    let bare = ["correction.alpha=none", "correction.surface=none"];
    Bench::new(&text, &[&bare[..], settings].concat())
}

/// Energy of a motion (x, y, rotation) of all points, J.
fn stored_energy(bench: &Bench, motion: impl FnMut(&[f64; 2]) -> [f64; 3]) -> f64 {
    let system = &**bench.model.plane();
    let u = of_all(
        system.topology().layout,
        system.cloud.positions.iter().map(motion),
    );
    let intact = vec![true; system.bonds.len()];
    internal::sweep(
        system,
        UnbrokenBonds::whole(&intact),
        &u,
        ThermalStrain::NONE,
    )
    .stored_energy
}

/// Energy of a bond by the printed matrix (MPPD eq. 33, with rotations counter-clockwise) in its own axes.
fn bond_energy([k_n, k_t, k_theta]: [f64; 3], l: f64, u: [f64; 6]) -> f64 {
    let (half, fourth) = (0.5 * k_t * l, 0.25 * k_t * l * l);
    let (same, other) = (k_theta * l + fourth, fourth - k_theta * l);
    let matrix = [
        [k_n, 0.0, 0.0, -k_n, 0.0, 0.0],
        [0.0, k_t, half, 0.0, -k_t, half],
        [0.0, half, same, 0.0, -half, other],
        [-k_n, 0.0, 0.0, k_n, 0.0, 0.0],
        [0.0, -k_t, -half, 0.0, k_t, -half],
        [0.0, half, other, 0.0, -half, same],
    ];
    let row = |(i, row): (usize, &[f64; 6])| -> f64 {
        u[i] * row.iter().zip(&u).map(|(k, u)| k * u).sum::<f64>()
    };
    0.5 / l * matrix.iter().enumerate().map(row).sum::<f64>()
}

/// Any motion costs the sum of the printed matrices of the bonds, with k_theta times the factor. Stiffnesses by MPPD eqs 7, 21 and
/// 43 and OMPPD after eq. 57.
#[test]
fn bonds_are_those_of_the_printed_matrix_with_the_factor() {
    let central = 6.0 * YOUNG / (PI * (1.0 - POISSON));
    let constant = 6.0 * YOUNG * (1.0 - 3.0 * POISSON) / (PI * (1.0 - POISSON.powi(2)));
    for law in LAWS.into_iter().filter(|law| *law != "mppd-beam") {
        for factor in [0.0, 0.5, 1.0, 3.0] {
            let settings = [
                format!("model.law={law}"),
                format!("model.rotational_factor={factor}"),
            ];
            let bench = square(&settings.each_ref().map(String::as_str));
            let system = &**bench.model.plane();
            let mut random = Random(7);
            let motions: Vec<[f64; 3]> = (0..bench.points())
                .map(|_| [(); 3].map(|()| 1e-5 * random.uniform()))
                .collect();
            let mut each = motions.iter();
            let found = stored_energy(&bench, |_| *each.next().unwrap());
            let mut expected = 0.0;
            for (bond, ends) in system.bonds.ends.iter().enumerate() {
                let [a, b] = ends.map(|end| end as usize);
                let (l, h) = (system.bonds.length[bond], system.bonds.horizon[bond]);
                let [cos, sin] = system.bonds.direction[bond];
                let (k_t, k_theta) = if law == "nhpd" {
                    let d = constant / (36.0 * h);
                    (12.0 * d / l.powi(2), d / l)
                } else {
                    let k_t = constant / h.powi(3);
                    (k_t, 0.5 * k_t * l * (1.0 - l / h))
                };
                let along = |u: [f64; 3]| [cos * u[0] + sin * u[1], cos * u[1] - sin * u[0], u[2]];
                let [ua, ub] = [a, b].map(|end| along(motions[end]));
                let u = [ua[0], ua[1], ua[2], ub[0], ub[1], ub[2]];
                let stiffness = [central / h.powi(3), k_t, factor * k_theta];
                let volumes = system.cloud.volumes[a] * system.cloud.volumes[b];
                expected += volumes * bond_energy(stiffness, l, u);
            }
            let error = relative_error(found, expected);
            println!("{law} {factor}: {error:.1e}");
            // A thousand terms of one sign.
            assert!(error < 1e-12, "{law} {factor}: {error:e}");
        }
    }
}

/// A factor of one changes no bit, one of zero is the law without rotational stiffness, and what is left of a bond is the PDS one.
#[test]
fn factors_of_one_and_zero_are_known_laws() {
    for law in LAWS {
        let with = |setting: &str| {
            let bench = square(&[&format!("model.law={law}"), setting]);
            bench.model.plane().rigidities.clone()
        };
        let (own, one, zero) = (
            with("model.horizon_factor=3.0"),
            with("model.rotational_factor=1.0"),
            with("model.rotational_factor=0.0"),
        );
        assert_eq!(own, one, "{law}");
        assert!(own.rotational.iter().any(|&it| it > 0.0), "{law}");
        assert!(zero.rotational.iter().all(|&it| it == 0.0), "{law}");
        assert_eq!(
            (&own.axial, &own.shear),
            (&zero.axial, &zero.shear),
            "{law}"
        );
        if law == "mppd" {
            assert_eq!(zero, with("model.rotational_stiffness=none"));
            let pds = square(&["model.law=pds"]);
            assert_eq!(pds.model.plane().element, ElementKind::Spring);
            let of_pds = &pds.model.plane().rigidities;
            assert_eq!((&of_pds.axial, &of_pds.shear), (&zero.axial, &zero.shear));
        }
    }
}

/// Where all rotations are held, the displacements are those of PDS whatever the factor (MPPD section 2.2: "when the rotational
/// degree of freedom is not taken into account or is kept restrained").
#[test]
fn with_held_rotations_it_is_pds() {
    let held = "support=[{ group = \"bottom\", displacement = { y = 0.0 } }, { group = \"corner\", displacement = { x = 0.0 } }, \
                { box = [[-1.0, -1.0], [1.0, 1.0]], displacement = { rotation = 0.0 } }]";
    let pds = square(&["model.law=pds"]).solve();
    for factor in [
        "model.rotational_factor=0.0",
        "model.rotational_factor=50.0",
    ] {
        let run = square(&["model.law=mppd", factor, held]).solve();
        let error = relative_error(run.last().stored_energy, pds.last().stored_energy);
        assert!(error < 1e-11, "{factor}: {error:e}");
    }
}

/// The micro-rotations of a uniform curvature chi cost gamma chi^2/2 with gamma = 4 G l_b^2: in the mean over two directions to
/// rounding where the constants are sums over the families, on any mesh; and inside a lattice, by integrals, the better the more
/// points a horizon has.
#[test]
fn a_cosserat_length_is_that_of_the_curvature() {
    let (length, curvature) = (2e-3, 0.1);
    let density = 0.5 * 4.0 * SHEAR_MODULUS * length * length * curvature * curvature;
    let of_rotations = |bench: &Bench, with: fn(&[f64; 2]) -> f64| {
        let energy = |it: &Bench| stored_energy(it, |p| [0.0, 0.0, curvature * with(p)]);
        energy(bench)
    };
    let settings = ["model.law=mppd-beam", "model.cosserat_length=2e-3"];
    let without = ["model.law=mppd-beam", "model.rotational_factor=0.0"];
    let [bench, bare] = [settings, without].map(|it| square(&it));
    let volume: f64 = bench.model.plane().cloud.volumes.iter().sum();
    let both: [fn(&[f64; 2]) -> f64; 2] = [|p| p[0], |p| p[1]];
    let of_curvature = |with| of_rotations(&bench, with) - of_rotations(&bare, with);
    let mean = 0.5 * both.map(of_curvature).iter().sum::<f64>() / volume;
    // Differences lose the digits that the shear of the bonds takes, here four.
    assert!(relative_error(mean, density) < 1e-9, "{mean:e} {density:e}");

    for m in [3, 5, 8] {
        let of_beam = lattice_sum(m, |l, _| l, 1.0 / 3.0);
        let of_decaying = lattice_sum(m, |l, h| l.powi(3) * (1.0 - l / h) / h.powi(2), 1.0 / 30.0);
        for law in LAWS {
            let ratio = middle_density(law, m, length) * curvature * curvature / density;
            let expected = match law {
                "nhpd" => of_beam,
                "mppd-beam" => 1.0,
                _ => of_decaying,
            };
            println!("{law}, m = {m}: {ratio:.4} of the continuum");
            assert!((ratio - expected).abs() < 1e-9, "{law} {m}: {ratio}");
        }
    }
}

/// Sum of alpha q(l, m) over the points of a lattice within m spacings, alpha by MPPD eq. 9, over the integral of q, which is
/// 2 pi m^3 times `integral`.
fn lattice_sum(m: usize, q: impl Fn(f64, f64) -> f64, integral: f64) -> f64 {
    let (most, h) = (m as i32, m as f64);
    let offsets =
        (-most..=most).flat_map(|i| (-most..=most).map(move |j| f64::from(i).hypot(f64::from(j))));
    let inside = offsets.filter(|l| *l > 0.0 && *l < h + 1e-9);
    let sum: f64 = inside.map(|l| (h + 0.5 - l).min(1.0) * q(l, h)).sum();
    sum / (2.0 * PI * h.powi(3) * integral)
}

/// Energy density of the micro-rotations theta = x at the middle of a lattice of unit spacing over 1000: a fourth of the sum of
/// k_theta dx^2 V over its bonds.
fn middle_density(law: &str, m: usize, length: f64) -> f64 {
    let cells = 4 * m + 1;
    let text = format!(
        "lattice = {{ cells = [{cells}, {cells}], spacing = 0.001, thickness = 0.001, set = {{ base = {{ left = 1 }} }} }}\n\
         material = {{ young = 15e9, poisson = {POISSON} }}\n\
         model = {{ law = \"{law}\", horizon_factor = {m}.0, cosserat_length = {length} }}\n\
         correction = {{ alpha = \"partial-volume\", surface = \"none\" }}\n\
         support = [{{ group = \"base\", displacement = {{ x = 0.0, y = 0.0, rotation = 0.0 }} }}]\n\
         load = [{{ group = \"base\", moment = 1.0 }}]"
    );
    let bench = Bench::new(&text, &[]);
    let system = &**bench.model.plane();
    let middle = (cells * cells / 2) as u32;
    let of_bond = |&bond: &u32| {
        let bond = bond as usize;
        let dx = system.bonds.length[bond] * system.bonds.direction[bond][0];
        0.25 * system.rigidities.rotational[bond] * dx * dx
    };
    let sum: f64 = system.bonds.incidence.at(middle).iter().map(of_bond).sum();
    sum / system.cloud.volumes[middle as usize]
}

/// A strip of height h in pure bending has the moment t (E h^3/12 + gamma h) chi of a Cosserat continuum (Gauthier and Jahsman 1975):
/// a thin strip is stiffer than its height says. Its ends are turned against each other, and nothing else is prescribed. Points at the
/// long sides have more bonds along the strip than across it, because the row that they are in is whole: so the strip has more than its
/// gamma, by as much as the sum over its rows says, which falls as the height grows.
#[test]
fn strips_bend_like_those_of_a_cosserat_continuum() {
    let height = 0.012_f64;
    let of = |settings: &[&str]| {
        let text = format!(
            "lattice = {{ cells = [96, 12], spacing = 0.001, corner = [0.0, -0.006], thickness = 0.001, \
             set = {{ left = {{ left = 1 }}, right = {{ right = 1 }} }} }}\n\
             material = {{ young = 15e9, poisson = {POISSON} }}\n\
             model = {{ law = \"mppd-beam\", horizon_factor = 3.0 }}\n\
             support = [{{ group = \"left\", displacement = {{ x = 0.0, rotation = 0.0 }} }}, \
             {{ at = [0.0005, 0.0005], displacement = {{ y = 0.0 }} }}]\n\
             load = [{{ name = \"turn\", group = \"right\", displacement = {{ rotation = 1e-3 }} }}, \
             {{ group = \"right\", displacement = {{ x = -1e-3 }}, profile = {{ along = \"y\", zero = 0.0, one = 1.0 }} }}]"
        );
        Bench::new(&text, settings).solve().last().stored_energy
    };
    let (length, curvature) = (0.095, 1e-3 / 0.095);
    let unit = 0.5 * 1e-3 * length * curvature * curvature;
    let plain = of(&["model.rotational_factor=0.0"]);
    let bending = plain / (unit * YOUNG * height.powi(3) / 12.0);
    println!("without: {bending:.4} of E h^3/12");
    for ratio in [0.1, 0.25, 0.5] {
        let setting = format!("model.cosserat_length={}", ratio * height);
        let added = of(&[&setting]) - plain;
        let gamma = 4.0 * SHEAR_MODULUS * (ratio * height).powi(2);
        let found = added / (unit * gamma * height);
        println!("l_b/h = {ratio}: {found:.4} of gamma h");
        // What is left are the ends, whose bonds run to one side: 3 of 95 spacings each.
        assert!(
            (found / in_strip(12, 3) - 1.0).abs() < 0.01,
            "{ratio}: {found}"
        );
    }
    let [thin, thick] = [12, 48].map(|rows| in_strip(rows, 3) - 1.0);
    println!("bonds of the strip: {thin:.4}, four times as high {thick:.4}");
    assert!(thin > 3.9 * thick && thick > 0.0);
}

/// Share of gamma that the bonds of an endless strip of so many rows have along it, where each point's have gamma in the mean over the
/// directions: the sum of alpha (q_A + q_B)/4 dx^2/l with q = 4/sum(alpha l).
fn in_strip(rows: i32, m: i32) -> f64 {
    let bonds = |row: i32| {
        let all = (-m..=m).flat_map(|i| (-m..=m).map(move |j| (i, j)));
        let in_strip = all.filter(move |(_, j)| (0..rows).contains(&(row + j)));
        let with_length =
            in_strip.map(|(i, j)| (f64::from(i), j, f64::from(i).hypot(f64::from(j))));
        let horizon = f64::from(m);
        let inside = with_length.filter(move |(.., l)| *l > 0.0 && *l < horizon + 1e-9);
        inside.map(move |(x, j, l)| (x, row + j, l, (horizon + 0.5 - l).min(1.0)))
    };
    let q = |row: i32| 4.0 / bonds(row).map(|(.., l, alpha)| alpha * l).sum::<f64>();
    let of_bond = |row, (x, other, l, alpha): (f64, i32, f64, f64)| {
        0.25 * alpha * (q(row) + q(other)) * x * x / l
    };
    let of_row = |row: i32| bonds(row).map(|bond| of_bond(row, bond)).sum::<f64>();
    (0..rows).map(of_row).sum::<f64>() / f64::from(rows)
}

/// The end of a bond between two points turns: a fibre at the distance kappa stretches by kappa |theta_rel|/l, and breaks the bond at
/// that, whichever way it turns; with kappa = 0 nothing stretches.
#[test]
fn a_bond_that_bends_breaks_at_the_stretch_of_its_fibre() {
    for turn in [0.02, -0.02] {
        for (distance, expected) in [(1e-3, Some(0.25)), (0.5e-3, Some(0.5)), (0.0, None)] {
            let text = format!(
                "lattice = {{ cells = [2, 1], spacing = 0.002, thickness = 0.001, set = {{ a = {{ left = 1 }}, b = {{ right = 1 }} }} }}\n\
                 material = {{ young = 15e9, poisson = 0.2 }}\n\
                 model = {{ law = \"mppd\", horizon_factor = 1.5 }}\n\
                 support = [{{ group = \"a\", displacement = {{ x = 0.0, y = 0.0, rotation = 0.0 }} }}, \
                 {{ group = \"b\", displacement = {{ x = 0.0, y = 0.0 }} }}]\n\
                 load = [{{ group = \"b\", displacement = {{ rotation = {turn} }} }}]\n\
                 fracture = {{ control = \"event\", criterion = [{{ kind = \"fibre\", limit = 2.5e-3, fibre_distance = {distance} }}] }}"
            );
            let broken = Bench::new(&text, &[]).break_up().breaks;
            let found = broken.first().map(|it| it.load_factor);
            match expected {
                Some(factor) => {
                    assert!(relative_error(found.unwrap(), factor) < 1e-12, "{found:?}")
                }
                None => assert_eq!(found, None),
            }
        }
    }
}

/// A disk broken by the stretch of fibres on the axis is broken by the stretch of the axis, bond by bond; and cohesion and friction as
/// the strengths give them break it like the strengths.
#[test]
fn criteria_as_given_are_those_of_the_strengths() {
    let text = DISK.replace(
        "fracture = { steps = 50 }",
        "fracture = { control = \"event\", stop = { bonds = 300 } }",
    );
    let by = |criterion: &str| {
        let criterion = format!("fracture.criterion=[{criterion}]");
        let settings = [
            "mesh.file=reference/disk.msh",
            "material.compressive_strength=20e6",
            &criterion,
        ];
        let bench = Bench::new(&text, &settings);
        let breaks = bench.break_up().breaks;
        let of = |it: &BreakRecord| (it.bond, it.load_factor);
        let breaks: Vec<(u32, f64)> = breaks.iter().map(of).collect();
        (bench.model.criteria.list[0].clone(), breaks)
    };
    let (_, axis) = by("{ kind = \"tension\" }");
    let (_, fibre) = by("{ kind = \"fibre\", fibre_distance = 0.0 }");
    assert!(axis.len() > 50);
    assert_eq!(axis, fibre);

    let (limits, of_strengths) = by("{ kind = \"frictional\" }");
    let (cohesion, slope) = (limits.limit[0], limits.coefficient[0]);
    let angle = slope.atan();
    let given =
        format!("{{ kind = \"frictional\", limit = {cohesion:e}, friction_angle = {angle:e} }}");
    let by_angle = format!("{{ kind = \"frictional\", friction_angle = {angle:e} }}");
    for criterion in [given, by_angle] {
        let (_, found) = by(&criterion);
        assert_eq!(found.len(), of_strengths.len());
        for (one, other) in found.iter().zip(&of_strengths) {
            assert_eq!(one.0, other.0, "{criterion}");
            // The tangent of an arc tangent is off by a bit.
            assert!(relative_error(one.1, other.1) < 1e-12, "{criterion}");
        }
    }
}
