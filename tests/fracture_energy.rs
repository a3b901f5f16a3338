//! The fracture energy: what separates a body in two halves, bond by bond, against G_c.
//!
//! The halves are rigid and move apart, so that every bond that crosses the plane of the crack reaches its limit by
//! itself.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::f64::consts::{FRAC_PI_2, PI};

use ligament_model::element::StiffnessFactors;
use ligament_model::failure::crack_opening::CrackEnergy;
use ligament_model::failure::fracture_energy::{critical_stretch, opening_modulus};
use ligament_model::thermal::ThermalStrain;
use ligament_model::{Isotropic, Plane};
use verification::bench::Bench;
use verification::numbers::{of_all, relative_error};

const FRACTURE_ENERGY: f64 = 40.0;
const THICKNESS: f64 = 0.002;
const SPACING: f64 = 0.001;

/// 37 x 37 points; a case needs a load, which is not used here.
const LATTICE: &str = r#"
lattice = { cells = [37, 37], spacing = 0.001, corner = [-0.0185, -0.0185], thickness = 0.002 }
material = { young = 20e9, poisson = 0.21, fracture_energy = 40.0 }
model = { law = "mppd", horizon_factor = 3.0 }
load = [{ box = [[-1.0, -1.0], [1.0, 1.0]], displacement = { x = 1e-6 } }]
fracture = { control = "event" }
"#;

const UNCORRECTED: [&str; 2] = ["correction.surface=none", "correction.alpha=none"];

/// Directions of cracks on a lattice: along rows, along diagonals, and in between.
const CRACKS: [[f64; 2]; 3] = [[1.0, 0.0], [1.0, 1.0], [2.0, 1.0]];

/// A lattice with a law, a criterion and m = H/dx.
fn lattice(law: &str, kind: &str, m: f64, settings: &[&str]) -> Bench {
    let own = [
        format!("model.law={law}"),
        format!("fracture.criterion.0.kind={kind}"),
        format!("model.horizon_factor={m:?}"),
    ];
    let own = own.each_ref().map(String::as_str);
    Bench::new(LATTICE, &[&own[..], settings].concat())
}

/// A piece of the plane of a crack.
struct Segment {
    start: [f64; 2],
    along: [f64; 2],
}

fn cross(p: [f64; 2], q: [f64; 2]) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}

impl Segment {
    /// A period of a crack through a lattice, half way between rows of points.
    fn period(crack: [f64; 2]) -> Self {
        // x of no point; y so that the cross product with the period is half of the smallest between points.
        let start = [0.137, (0.5 + 0.137 * crack[1]) / crack[0]];
        Self {
            start: start.map(|it| SPACING * it),
            along: crack.map(|it| SPACING * it),
        }
    }

    fn length(&self) -> f64 {
        self.along[0].hypot(self.along[1])
    }

    /// From the start, twice the area between it and the segment: positive on the left.
    fn side(&self, [x, y]: [f64; 2]) -> f64 {
        cross(self.along, [x - self.start[0], y - self.start[1]])
    }

    /// Bonds whose ends lie on its two sides, and that meet its line between its start and its end.
    fn crossing(&self, bench: &Bench) -> Vec<usize> {
        let positions = bench.positions();
        let crosses = |bond: &usize| {
            let [a, b] = bench.model.plane().bonds.ends[*bond].map(|end| positions[end as usize]);
            let sides = [self.side(a), self.side(b)];
            if sides[0] * sides[1] >= 0.0 {
                return false;
            }
            let share = sides[0] / (sides[0] - sides[1]);
            let at = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]) - self.start[axis]);
            let place = at[0] * self.along[0] + at[1] * self.along[1];
            (0.0..self.length().powi(2)).contains(&place)
        };
        let bonds = 0..bench.model.plane().bonds.len();
        bonds.filter(crosses).collect()
    }
}

/// Sum of 1/2 R s_0^2 over the bonds that cross a segment, per area, over G_c.
fn work(bench: &Bench, segment: &Segment) -> f64 {
    let rigidity = &bench.model.plane().rigidities.axial;
    let crossing = segment.crossing(bench);
    assert!(!crossing.is_empty());
    let of_bond = |bond: usize| 0.5 * rigidity[bond] * bench.limits()[bond].powi(2);
    let energy: f64 = crossing.into_iter().map(of_bond).sum();
    energy / (segment.length() * bench.model.plane().cloud.thickness) / FRACTURE_ENERGY
}

/// What a crack through the middle of a lattice is told to spend, over G_c.
fn told(bench: &Bench, crack: [f64; 2]) -> f64 {
    let (system, criteria) = (bench.model.plane(), &bench.model.criteria);
    let middle = system.cloud.nearest_point([0.0, 0.0]) as usize;
    let mut among = vec![false; bench.points()];
    among[middle] = true;
    let length = crack[0].hypot(crack[1]);
    let normal = [-crack[1] / length, crack[0] / length];
    let energy = CrackEnergy::for_normal(system, criteria, &among, normal).unwrap();
    assert_eq!(energy.unbroken, 0.0);
    energy.per_area / FRACTURE_ENERGY
}

/// A sum over one of each two opposite offsets xi of an infinite lattice, of f(l, tan phi) |xi.n|/m^4, with the angle
/// phi of a bond to the crack: a pair of points crosses a plane with the normal n |xi.n|/h^2 times per length. Lengths
/// are in spacings.
fn over_offsets(m: f64, [p, q]: [f64; 2], f: impl Fn(f64, f64) -> f64) -> f64 {
    let reach = m as i64;
    let mut sum = 0.0;
    for i in -reach..=reach {
        for j in -reach..=reach {
            let (x, y) = (i as f64, j as f64);
            let (length, across, along) = (x.hypot(y), (x * q - y * p).abs(), x * p + y * q);
            if length <= m && across > 0.0 {
                sum += 0.5 * across / p.hypot(q) * f(length, across / along);
            }
        }
    }
    sum / m.powi(4)
}

/// What G/G_c is for k_n constant, or falling with the length as the conical one does: a sum over crossing bonds with the
/// limits of a continuous family, in which bonds have the mean length 3 H/4 or 3 H/5.
fn of_lattice(m: f64, crack: [f64; 2], conical: bool) -> f64 {
    let crossing = over_offsets(m, crack, |length, _| {
        if conical {
            10.0 * length * (1.0 - length / m)
        } else {
            2.0 * length
        }
    });
    crossing * mean_length_ratio(m, conical)
}

/// Mean length of the bonds of a continuous family over that of a lattice.
fn mean_length_ratio(m: f64, conical: bool) -> f64 {
    let axial = |length: f64| if conical { 1.0 - length / m } else { 1.0 };
    let (mut sum, mut weights) = (0.0, 0.0);
    let reach = m as i64;
    for i in -reach..=reach {
        for j in -reach..=reach {
            let length = (i as f64).hypot(j as f64);
            if length <= m {
                sum += axial(length) * length * length;
                weights += axial(length) * length;
            }
        }
    }
    let of_circle = if conical { 0.6 * m } else { 0.75 * m };
    of_circle / (sum / weights)
}

/// The critical stretch makes the integral over half planes G_c (the two-dimensional form of Silling and Askari 2005,
/// eq. 26), with the stiffness of each law as the papers print it and the mean length of its bonds. Points at distances z = l cos(a) from the plane
/// have bonds of length l across it within the angles -a to a; Simpson's rule, exact to 1e-10 for the polynomials and
/// sines here.
#[test]
fn the_critical_stretch_is_that_of_the_integral() {
    let simpson = |end: f64, f: &dyn Fn(f64) -> f64| {
        const PARTS: usize = 400;
        let step = end / PARTS as f64;
        let at = |part: usize| {
            let start = part as f64 * step;
            f(start) + 4.0 * f(start + 0.5 * step) + f(start + step)
        };
        step / 6.0 * (0..PARTS).map(at).sum::<f64>()
    };
    let (young, horizon) = (20e9, 0.003_f64);
    for (plane, poisson) in [
        (Plane::Stress, -0.3),
        (Plane::Stress, 0.21),
        (Plane::Strain, 0.21),
    ] {
        let material = Isotropic { young, poisson };
        let volume = PI * THICKNESS * horizon.powi(3);
        let [beam_axial, central, conical] = match plane {
            Plane::Stress => [6.0 * young / (1.0 - poisson), 9.0 * young, 36.0 * young],
            Plane::Strain => [
                6.0 * young / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
                48.0 / 5.0 * young,
                192.0 / 5.0 * young,
            ],
        }
        .map(|it| it / volume);
        type Axial<'a> = &'a dyn Fn(f64) -> f64;
        let with_central_forces = material.with_central_forces(plane);
        let laws: [(&Isotropic, Axial<'_>); 3] = [
            (&material, &|_| beam_axial),
            (&with_central_forces, &|_| central),
            (&with_central_forces, &|l| conical * (1.0 - l / horizon)),
        ];
        for (material, axial) in laws {
            let modulus = opening_modulus(material, plane);
            let moment = |power: i32| simpson(horizon, &|l| axial(l) * l.powi(power));
            let limit = critical_stretch(FRACTURE_ENERGY, modulus, moment(3) / moment(2), plane);
            let of_length = |l: f64| {
                let bond = 0.5 * axial(l) * l * limit * limit;
                let angles = simpson(FRAC_PI_2, &|a| 2.0 * a * l * a.sin());
                THICKNESS * l * bond * angles
            };
            let energy = simpson(horizon, &of_length);
            assert!(relative_error(energy, FRACTURE_ENERGY) < 1e-10, "{energy}");
        }
    }
}

/// On a lattice without corrections the integral is a sum over whole numbers, whatever the law's stiffness and
/// Poisson's ratio. 1e-12: rounding of 400 terms. The sum goes to one with m: within 0.5 % at m = 60 for all three
/// directions.
#[test]
fn lattices_take_the_sum_over_their_offsets() {
    for (law, plane) in [
        ("bbpd", "stress"),
        ("bbpd-conical", "strain"),
        ("pds", "stress"),
        ("mppd", "strain"),
        ("nhpd", "stress"),
    ] {
        let conical = law == "bbpd-conical";
        let plane = format!("lattice.plane={plane}");
        for m in [3.0, 4.0, 6.0, 8.0] {
            let settings = [&UNCORRECTED[..], &[&plane]].concat();
            let bench = lattice(law, "critical-stretch", m, &settings);
            for crack in CRACKS {
                let expected = of_lattice(m, crack, conical);
                // Bonds of central forces store nothing beside their stretch.
                let mut founds = vec![work(&bench, &Segment::period(crack))];
                if law.starts_with("bbpd") {
                    founds.push(told(&bench, crack));
                }
                for found in founds {
                    let error = relative_error(found, expected);
                    assert!(error < 1e-12, "{law} {m} {crack:?}");
                }
            }
        }
    }
    for conical in [false, true] {
        for m in [3.0, 4.0, 6.0, 8.0, 20.0, 60.0] {
            let sums = CRACKS.map(|crack| of_lattice(m, crack, conical));
            println!("conical {conical}, m = {m}: {sums:.4?}");
            let off = sums.map(|it| (it - 1.0).abs());
            assert!(m < 60.0 || off.iter().all(|&it| it < 5e-3));
        }
    }
}

/// With the corrections that each law has by default. Measured for m = 3, 4, 6, 8 and three directions: 0.967 to 0.991
/// for a constant k_n with partial volumes (0.975 to 0.999 with sums over families), 1.042 to 1.082 for the conical one, 0.971 to
/// 1.036 for NHPD, whose factors Omega still feel the sides of this lattice; directions differ by 2 % at m = 3 (4 % for NHPD)
/// and by 0.5 % at m = 8.
#[test]
fn corrected_lattices_take_nearly_the_fracture_energy() {
    for (law, range) in [
        ("bbpd", 0.96..1.0),
        ("bbpd-conical", 1.03..1.09),
        ("pds", 0.96..1.0),
        ("mppd", 0.96..1.0),
        ("mppd-beam", 0.97..1.005),
        ("nhpd", 0.965..1.04),
    ] {
        for m in [3.0, 4.0, 6.0, 8.0] {
            let bench = lattice(law, "critical-stretch", m, &[]);
            let works = CRACKS.map(|crack| work(&bench, &Segment::period(crack)));
            println!("{law} m = {m}: {works:.3?}");
            assert!(
                works.iter().all(|it| range.contains(it)),
                "{law} {m}: {works:?}"
            );
            let spread =
                works.into_iter().fold(0.0, f64::max) - works.into_iter().fold(2.0, f64::min);
            assert!(
                spread < if m < 6.0 { 0.04 } else { 0.01 },
                "{law} {m}: {spread}"
            );
        }
    }
}

/// The same on an irregular mesh, along 12 segments of 60 mm through the middle of a disk of 100 mm: measured 0.962 to
/// 1.047, mean 1.004, 0.986 and 0.990 for the three horizons; orientation does not count, what is left is chance.
#[test]
fn an_irregular_mesh_takes_nearly_the_fracture_energy() {
    const DISK: &str = r#"
mesh = { file = "../meshes/disk-2mm.msh", thickness = 0.02 }
material = { young = 20e9, poisson = 0.21, fracture_energy = 40.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
load = [{ group = "platen-top", displacement = { y = -1e-4 } }]
fracture = { steps = 1, criterion = [{ kind = "critical-stretch" }] }
"#;
    for factor in ["2.0", "3.0", "4.0"] {
        let bench = Bench::new(DISK, &[&format!("model.horizon_factor={factor}")]);
        let works: [f64; 12] = std::array::from_fn(|turn| {
            let angle = (15.0 * turn as f64).to_radians();
            let along = [0.06 * angle.cos(), 0.06 * angle.sin()];
            let start = along.map(|it| -0.5 * it + 1e-7);
            work(&bench, &Segment { start, along })
        });
        let mean = works.iter().sum::<f64>() / 12.0;
        println!("lambda {factor}: mean {mean:.3}, {works:.3?}");
        assert!(works.iter().all(|it| (0.96..1.05).contains(it)));
        assert!((mean - 1.0).abs() < 0.02);
    }
}

/// What bonds take when the halves move apart until each is at its limit, per area over G_c.
struct Separation {
    /// 1/2 R_n max(s, 0)^2 + 1/2 R_t gamma^2, which is what the energy criterion looks at.
    counted: f64,
    /// All energy stored then.
    stored: f64,
    /// Bonds that no motion of this kind brings to a limit.
    unbroken: usize,
}

impl Separation {
    fn from_bench(bench: &Bench, segment: &Segment, [x, y]: [f64; 2]) -> Self {
        let system = &**bench.model.plane();
        let area = segment.length() * THICKNESS;
        let mut sum = Self {
            counted: 0.0,
            stored: 0.0,
            unbroken: 0,
        };
        let positions = bench.positions().iter();
        let is_left = positions.map(|&position| segment.side(position) > 0.0);
        let motions = is_left.map(|is_left| if is_left { [x, y, 0.0] } else { [0.0; 3] });
        let u = of_all(system.topology().layout, motions);
        let intact = vec![true; system.bonds.len()];
        let deformations = system.deformations(&intact, &u, ThermalStrain::NONE);
        for bond in segment.crossing(bench) {
            let deformation = deformations[bond];
            let criteria = bench.model.criteria.without_state();
            let ratio = criteria.utilisation(bond, &deformation);
            if ratio == 0.0 {
                sum.unbroken += 1;
                continue;
            }
            let per_energy = 1.0 / (ratio * ratio * area * FRACTURE_ENERGY);
            let opening =
                0.5 * system.rigidities.axial[bond] * deformation.stretch().max(0.0).powi(2);
            let sliding = 0.5 * system.rigidities.shear[bond] * deformation.shear().powi(2);
            sum.counted += (opening + sliding) * per_energy;
            let energy =
                system.stored_energy(&intact, bond, &StiffnessFactors::WHOLE, &deformation);
            sum.stored += energy * per_energy;
        }
        sum
    }
}

const OPENING: [f64; 2] = [0.0, 1e-6];
const SLIDING: [f64; 2] = [1e-6, 0.0];

/// The energy criterion counts the same in opening and in sliding, the sum of 1/2 R s_0^2, for every Poisson's ratio
/// below that of central forces. In sliding, bonds that are shortened have stored that energy in addition, which
/// breaking them releases: measured 1.2 (nu = -0.3), 1.5 (0), 2.5 (0.21) and 3.3 (0.25) times what is counted at m = 3
/// for `mppd`. At nu = 1/3 they resist nothing but stretch and never break. 1e-12: rounding.
#[test]
fn the_energy_criterion_counts_the_same_in_both_modes() {
    let segment = Segment::period([1.0, 0.0]);
    for law in ["pds", "mppd", "mppd-beam", "nhpd"] {
        for poisson in ["-0.3", "0.0", "0.21", "0.25"] {
            let setting = format!("material.poisson={poisson}");
            for m in [3.0, 6.0] {
                let bench = lattice(law, "bond-energy", m, &[&setting]);
                let expected = work(&bench, &segment);
                let opening = Separation::from_bench(&bench, &segment, OPENING);
                let sliding = Separation::from_bench(&bench, &segment, SLIDING);
                println!(
                    "{law} nu {poisson} m {m}: {expected:.3} G_c, stored in sliding {:.3} times that",
                    sliding.stored / expected
                );
                assert_eq!((opening.unbroken, sliding.unbroken), (0, 0));
                for found in [opening.counted, opening.stored, sliding.counted] {
                    assert!(relative_error(found, expected) < 1e-12, "{law} {poisson}");
                }
                assert!(sliding.stored > 1.1 * expected);
            }
        }
    }
    let bench = lattice("bbpd", "bond-energy", 3.0, &[]);
    let sliding = Separation::from_bench(&bench, &segment, SLIDING);
    assert_eq!((sliding.unbroken, segment.crossing(&bench).len()), (12, 18));
}

/// Above the Poisson's ratio of central forces shear gives energy back, and bonds nearly along the crack never reach
/// the limit of the energy criterion; the plain stretch breaks them. The case is told.
#[test]
fn the_energy_criterion_leaves_bonds_where_shear_gives_energy() {
    let segment = Segment::period([1.0, 0.0]);
    let setting = ["material.poisson=0.38", "model.poisson=bonds"];
    let energy = lattice("nhpd", "bond-energy", 6.0, &setting);
    let stretch = lattice("nhpd", "critical-stretch", 6.0, &setting);
    assert!(Separation::from_bench(&energy, &segment, OPENING).unbroken > 0);
    assert_eq!(
        Separation::from_bench(&stretch, &segment, OPENING).unbroken,
        0
    );
    let told = |bench: &Bench| {
        let told = bench.model.warnings.iter();
        told.filter(|it| it.kind == "energy-given-back").count()
    };
    assert_eq!((told(&energy), told(&stretch)), (1, 0));
    assert_eq!(told(&lattice("nhpd", "bond-energy", 6.0, &[])), 0);
}

/// With the plain critical stretch, what shear stores until a bond is at its limit comes on top: q cot^2(phi) of its
/// share, q = k_t/k_n = (1 - 3 nu)/(1 + nu) for a constant k_t, as a sum over whole numbers (1e-12: rounding). It grows
/// with log m, because the bonds along the crack slide most: 1.25 (m = 3), 1.35, 1.48 and 1.58 (m = 8) times the rest
/// at nu = 0.21.
#[test]
fn shear_comes_on_top_of_the_critical_stretch() {
    let crack = [1.0, 0.0];
    let segment = Segment::period(crack);
    for (poisson, word) in [
        (-0.3, "-0.3"),
        (0.0, "0.0"),
        (0.21, "0.21"),
        (0.25, "0.25"),
        (0.38, "0.38"),
    ] {
        let mut shares = Vec::new();
        for m in [3.0, 4.0, 6.0, 8.0] {
            let setting = format!("material.poisson={word}");
            let settings = [&UNCORRECTED[..], &[&setting, "model.poisson=bonds"]].concat();
            let bench = lattice("mppd", "critical-stretch", m, &settings);
            let opening = Separation::from_bench(&bench, &segment, OPENING);
            let ratio = (1.0 - 3.0 * poisson) / (1.0 + poisson);
            let crossing = over_offsets(m, crack, |length, tangent| {
                2.0 * length * (1.0 + ratio / tangent.powi(2))
            });
            let expected = crossing * mean_length_ratio(m, false);
            for found in [opening.stored, told(&bench, crack)] {
                assert!(relative_error(found, expected) < 1e-12, "{poisson} {m}");
            }
            shares.push(opening.stored / work(&bench, &segment));
        }
        println!("nu {poisson}: {shares:.3?} times 1/2 R s_0^2 for m = 3, 4, 6, 8");
        assert!(shares.is_sorted() == (poisson < 1.0 / 3.0));
    }
}
