//! The text of a starter case.

mod body;
mod section;

use std::fmt::Write;

use toml_edit::{Key, Value};

use super::groups::{LoadPlace, SupportAndLoad};
pub(super) use body::{Body, Section};
use body::{coordinates, size};
pub(super) use body::{digits, exact, quoted};
use ligament::setup::Law;
use ligament::setup::is_unseen;
use ligament_model::law::{BondLaw, LAWS, Materials, PaperCorrection};
use ligament_model::material::Space;
use section::{precrack, section};

/// Young's modulus and tensile strength of the example material, similar to concrete, Pa.
const YOUNG: f64 = 30e9;
const TENSILE_STRENGTH: f64 = 3e6;
/// Critical stretch of the examples without a strength.
const STRETCH: f64 = TENSILE_STRENGTH / YOUNG;
/// Suggested displacement of a load over the displacement at which a bar reaches its tensile strength: bars pulled at their ends fail well before, a
/// disk between platens needs several times as much.
const PULLED: f64 = 4.0;
const PRESSED: f64 = 16.0;
/// Suggested displacement in the middle of a beam over the displacement at which it reaches its tensile strength.
const BENT: f64 = 2.0;

const AXES: [&str; 3] = ["x", "y", "z"];

/// Text of the case. Comments begin with `# `; settings that are activated by removing the sign begin with `#` without a space.
pub(super) fn case_text<const D: usize>(
    body: &Body<D>,
    ends: &SupportAndLoad<D>,
    law: Law,
    warnings: &[String],
) -> String {
    let mut text = String::new();
    let sections = [
        head(body, law, warnings),
        section(body),
        materials(body, law),
        model::<D>(is_lattice(body), law),
        precrack(body, ends),
        conditions(body, ends),
        fracture(body, law),
        records(body, ends),
    ];
    for section in sections {
        text.push_str(&section);
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn head<const D: usize>(body: &Body<D>, law: Law, warnings: &[String]) -> String {
    let mut text = "\
# A case to start from: it runs as it is, with an example material and loading.
#   EXAMPLE   a value to replace by your own
#   #key      a setting that you may want: remove the # before it
# All values are in SI units: m, N, Pa, kg, s, rad. `ligament check` tells whether the case is consistent.
"
    .to_owned();
    for warning in warnings {
        let _ = writeln!(text, "# WARNING: {warning}");
    }
    let title = Value::from(format!("{} by {}", body.name, law.name()));
    let _ = write!(text, "\ntitle = {} # EXAMPLE\n", title.to_string().trim());
    text
}

fn materials<const D: usize>(body: &Body<D>, law: Law) -> String {
    if body.parts.is_empty() {
        return format!("[material]\n{}", constants(body, law));
    }
    let part = ["surface", "volume"][usize::from(D > 2)];
    let mut text = format!(
        "# A material for each physical {part}; bonds between two take the smaller limit.\n"
    );
    for part in &body.parts {
        let key = match part.contains(is_unseen) {
            true => quoted(part),
            false => Key::new(part.as_str()).display_repr().into_owned(),
        };
        let _ = write!(
            text,
            "[material.{key}]\ngroup = {}\n{}",
            quoted(part),
            constants(body, law)
        );
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn constants<const D: usize>(body: &Body<D>, law: Law) -> String {
    let density = "#density = 2400.0 # kg/m^3, for analysis = \"modal\"\n";
    let strength = format!(
        "tensile_strength = {} # Pa, EXAMPLE\n",
        exact(TENSILE_STRENGTH)
    );
    let isotropic = |poisson: &str, failure: &str| {
        format!(
            "young = {} # Pa, EXAMPLE\npoisson = {poisson} EXAMPLE\n{failure}{density}",
            exact(YOUNG)
        )
    };
    let row = law.row;
    match row.materials {
        Materials::Orthotropic => format!(
            "\
young_1 = {} # Pa along the axis 1, EXAMPLE
young_2 = {} # Pa along the axis 2, EXAMPLE
poisson_12 = 0.2 # contraction along 2 under stress along 1, EXAMPLE
shear_modulus = {} # Pa, EXAMPLE
angle = 0.0 # rad, from the x axis to the axis 1, counter-clockwise, EXAMPLE
{density}",
            exact(YOUNG),
            exact(0.5 * YOUNG),
            exact(0.25 * YOUNG)
        ),
        Materials::Isotropic | Materials::Anisotropic if row.has_own_strains() => {
            // Energy of bonds with a horizon of three spacings at the example's stretch.
            let energy =
                STRETCH.powi(2) * 2.0 * YOUNG / std::f64::consts::PI / 0.8 * 2.25 * body.spacing;
            let failure = format!(
                "fracture_energy = {} # J/m^2, EXAMPLE\n",
                exact(digits(energy, 2))
            );
            isotropic("0.2 #", &failure)
        }
        Materials::Isotropic | Materials::Anisotropic => match (row.fixes_poisson, D) {
            (false, _) => isotropic("0.2 #", &strength),
            (true, 2) if row.options.poisson.is_some() => isotropic(
                "0.3333 # the law has 1/3 (plane strain: 1/4), and larger ratios by cells;",
                &strength,
            ),
            (true, _) if row.options.poisson.is_some() => isotropic(
                "0.25 # the law has 1/4, and larger ratios by cells;",
                &strength,
            ),
            (true, 2) => isotropic(
                "0.3333 # the law has 1/3 (plane strain: 1/4) whatever stands here;",
                &strength,
            ),
            (true, _) => isotropic("0.25 # the law has 1/4 whatever stands here;", &strength),
        },
    }
}

/// Text of the law and its correction for the mesh of a deck.
pub(super) fn deck_model(dimensions: u8, law: Law) -> String {
    match dimensions {
        2 => model::<2>(false, law),
        _ => model::<3>(false, law),
    }
}

/// Text of commented settings with which bonds of a deck's body break.
pub(super) fn deck_examples(has_stages: bool) -> String {
    let steps = match has_stages {
        true => "#    each [[stage]] has `steps = 20` then\n",
        false => "#steps = 100 # equal load steps up to load factor 1\n",
    };
    format!(
        "\
# The deck has no fracture: the case is one linear elastic solution. For fracture give the material a strength, and remove the # of
#[fracture]
{steps}#stop = {{ load_fraction = 0.5 }} # when the load has fallen to this share of its largest
#[[fracture.criterion]]
#kind = \"bond-rankine\" # EXAMPLE, with the `tensile_strength`
"
    )
}

fn model<const D: usize>(is_lattice: bool, law: Law) -> String {
    let others = LAWS.into_iter().filter(|it| {
        let exists = D == 2 || it.exists_in(Space::Solid);
        *it != law.row && exists && (is_lattice || !it.needs_lattice)
    });
    let words = |laws: Vec<&BondLaw>| laws.iter().map(|it| it.word).collect::<Vec<_>>();
    let constants = match D {
        2 => {
            let with_axes = LAWS
                .into_iter()
                .filter(|it| it.materials > Materials::Isotropic);
            let with_axes = words(with_axes.collect()).join("` and `");
            format!("; `{with_axes}` take other constants of the material.")
        }
        _ => ".".to_owned(),
    };
    let correction = match law.row.correction {
        PaperCorrection::None => "",
        _ if !has_patch::<D>(is_lattice, law) => {
            "
# Makes the energies of stretches along the axes those of the material. Others: volume, none; for meshes patch.
[correction]
surface = \"domain\"
"
        }
        PaperCorrection::Volumes | PaperCorrection::LengthAndDomain => {
            "
# Makes the body as stiff as its material, with every uniform strain in equilibrium. Others: domain (NHPD), volume, none.
[correction]
surface = \"patch\"
regularisation = 3e-7 # the finer, the nearer to its strength a body fails
"
        }
    };
    format!(
        "\
# Other laws: {}{constants}
[model]
law = \"{}\"
# Horizon of a point over the distance to its nearest neighbour. The strength depends on it, so compare runs with the same.
horizon_factor = 3.0
{correction}",
        words(others.collect()).join(", "),
        law.name()
    )
}

fn is_lattice<const D: usize>(body: &Body<D>) -> bool {
    matches!(body.section, Section::Lattice { .. })
}

/// Whether the case has the patch correction: for laws whose paper corrects surfaces, except on lattices in space.
fn has_patch<const D: usize>(is_lattice: bool, law: Law) -> bool {
    law.row.correction != PaperCorrection::None && !(D > 2 && is_lattice)
}

/// The displacement of the load, m.
fn displacement<const D: usize>(body: &Body<D>, ends: &SupportAndLoad<D>) -> f64 {
    let length = size(body, ends.axis);
    // A beam of span L and depth h under a load in its middle has stresses 6 E h u/L^2.
    let bent = BENT * ends.span.powi(2) / (6.0 * length);
    let stretched = match ends.presses {
        true => -(PRESSED * length).max(bent),
        false => PULLED * length,
    };
    digits(ends.away * stretched * STRETCH, 2)
}

fn conditions<const D: usize>(body: &Body<D>, ends: &SupportAndLoad<D>) -> String {
    let displacement = exact(displacement(body, ends));
    let (axis, how) = (
        AXES[ends.axis],
        if ends.presses {
            "towards the support"
        } else {
            "away from the support"
        },
    );
    let held: Vec<String> = AXES[..D].iter().map(|it| format!("{it} = 0.0")).collect();
    let roller = |place: &LoadPlace<D>| {
        let place = spot(place, body);
        format!("\n[[support]]\n{place}displacement = {{ {axis} = 0.0 }} # m, free to slide\n")
    };
    let rollers: String = ends.rollers.iter().map(roller).collect();
    let actions = match D {
        2 => "force, force_per_length, moment, pressure",
        _ => "force, force_per_area, moment, pressure",
    };
    let mut text = format!(
        "\
# What holds the body. It and the load were chosen {}. A component that is not given is free.
[[support]]
{}displacement = {{ {} }} # m
{rollers}
# What loads it, as it is at load factor 1. Its displacement and the force for it are the curve in history.csv. In the place of
# `displacement`: {actions} and others.
[[load]]
{}displacement = {{ {axis} = {displacement} }} # m, {how}; EXAMPLE
",
        ends.found,
        spot(&ends.support, body),
        held.join(", "),
        spot(&ends.load, body)
    );
    match &body.section {
        Section::Lattice { .. } => {
            text += "\n# Bonds that never break, so that the crack does not run along the cells that are held and moved.\n";
            for set in [&ends.support, &ends.load] {
                let _ = write!(text, "[[no_fail]]\n{}", spot(set, body));
            }
        }
        Section::Mesh { .. } => {
            text += "\n# Parts where bonds never break, where something breaks at the load or the support that should not.\n";
            let _ = writeln!(text, "#[[no_fail]]\n#{}", spot(&ends.load, body).trim_end());
        }
    }
    text
}

fn fracture<const D: usize>(body: &Body<D>, law: Law) -> String {
    let row = law.row;
    let criterion = match (row.materials, D) {
        (Materials::Isotropic | Materials::Anisotropic, _) if row.has_own_strains() => format!(
            "# Without a [[fracture.criterion]] bonds fail by the fracture energy (\"{}\").\n",
            row.criterion.word
        ),
        (Materials::Orthotropic, _) => format!(
            "\
# When a bond fails.
[[fracture.criterion]]
kind = \"tension\"
limit = {} # stretch, EXAMPLE
",
            exact(STRETCH)
        ),
        (Materials::Isotropic | Materials::Anisotropic, _) if has_patch::<D>(is_lattice(body), law) => "\
# When a bond fails: where the stress on the plane across it is F_t. With a crack or notch, and for concrete: rankine with after =
# \"linear\", with `tensile_strength` and `fracture_energy`. Under pressure: mohr-coulomb, with `compressive_strength`. Others: tension,
# strength (NHPD), sliding, frictional, critical-stretch, bond-energy, ...
[[fracture.criterion]]
kind = \"bond-rankine\"
"
        .to_owned(),
        (Materials::Isotropic | Materials::Anisotropic, 2) => "\
# When a bond fails: at the stretch F_t/E, whatever its length. Others: strength (NHPD), sliding, frictional, critical-stretch, ...
# With a crack or notch in glass, ceramics or rock: critical-stretch or bond-energy, with the `fracture_energy` of the material. Concrete:
# bond-energy with after = \"two-branch\", with `tensile_strength` and `fracture_energy`.
[[fracture.criterion]]
kind = \"tension\"
"
        .to_owned(),
        (Materials::Isotropic | Materials::Anisotropic, _) => "\
# When a bond fails: at the stretch F_t/E, whatever its length. Others: strength (NHPD), sliding, compression, critical-stretch,
# bond-energy. With a crack or notch in glass, ceramics or rock: critical-stretch or bond-energy, with `fracture_energy` of the material.
[[fracture.criterion]]
kind = \"tension\"
"
        .to_owned(),
    };
    let along = (0..D).map(|axis| size(body, axis) / body.spacing);
    let points: f64 = along.product();
    let many = if D == 2 { 20_000.0 } else { 5_000.0 };
    let large = if points > many {
        "# The body has many points: try `steps = 20` first.\n"
    } else {
        ""
    };
    format!(
        "\
# How bonds break while the load rises. Without this section: one linear elastic solution.
[fracture]
steps = 100 # equal load steps up to load factor 1; or a list of load factors
stop = {{ load_fraction = 0.5 }} # when the load has fallen to this share of its largest
#bonds_per_iteration = 5 # broken at most between two solutions
{large}{criterion}"
    )
}

fn records<const D: usize>(body: &Body<D>, ends: &SupportAndLoad<D>) -> String {
    let point = |position| coordinates(body, position);
    format!(
        "\
# Extra columns of history.csv: here an opening, and the damage of a point.
#[[probe]]
#name = \"opening\"
#between = [{}, {}] # m, the displacement of the second less that of the first
#component = \"{}\"
#[[probe]]
#name = \"damage-middle\"
#at = {} # m
#field = \"damage\"

#[output]
#fields_every = 5 # load steps between two field files for ParaView (default 10)
#bonds = true # the bonds as lines, too
#stress = [\"material\"] # stresses of the points
",
        point(body.opening[0]),
        point(body.opening[1]),
        AXES[ends.axis],
        point(body.middle)
    )
}

fn spot<const D: usize>(spot: &LoadPlace<D>, body: &Body<D>) -> String {
    match spot {
        LoadPlace::Group(name) => format!("group = {}\n", quoted(name)),
        LoadPlace::Box(corners) => {
            let [low, high] = corners.map(|corner| coordinates(body, corner));
            let shape = ["rectangle", "box"][usize::from(D > 2)];
            format!("box = [{low}, {high}] # two corners, m: the points in this {shape}\n")
        }
    }
}
