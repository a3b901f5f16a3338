//! The text of a starter case.

use std::fmt::Write;

use ligament_mesh::Group;
use toml_edit::{Key, Value};

use super::groups::{Ends, Spot};
use ligament::setup::Law;

/// What the case is about.
pub(super) struct Body {
    /// Name of the body, for the title.
    pub(super) name: String,
    /// Where it comes from.
    pub(super) section: Section,
    /// Groups with a material each; none where one material fills the body.
    pub(super) parts: Vec<String>,
    /// Lower left and upper right corner, m.
    pub(super) extent: [[f64; 2]; 2],
    /// Where it is in the middle, m.
    pub(super) middle: [f64; 2],
    /// Two places on it whose distance along the load is an opening, m.
    pub(super) opening: [[f64; 2]; 2],
    /// Distance of the points, m.
    pub(super) spacing: f64,
}

/// Where a body comes from.
pub(super) enum Section {
    /// From a mesh file.
    Mesh { file: String, groups: Vec<Group> },
    /// From a lattice; so many rows are held, and so many are moved.
    Lattice { cells: [u32; 2], rows: u32 },
}

/// The example material: a concrete-like one.
const YOUNG: f64 = 30e9;
const TENSILE_STRENGTH: f64 = 3e6;
/// Critical stretch of the examples that do not take the strength.
const STRETCH: f64 = TENSILE_STRENGTH / YOUNG;
/// The displacement of a load over what would bring a bar to its tensile strength: bars pulled at their ends fail well before, a
/// disk between platens needs several times as much.
const PULLED: f64 = 4.0;
const PRESSED: f64 = 16.0;

/// The case. Lines of prose begin with `# `; lines that are settings to be taken by removing the sign, with `#` alone.
pub(super) fn case_text(body: &Body, ends: &Ends, law: Law, warnings: &[String]) -> String {
    let mut text = String::new();
    let sections = [
        head(body, law, warnings),
        section(body),
        materials(body, law),
        model(body, law),
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

fn head(body: &Body, law: Law, warnings: &[String]) -> String {
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

fn section(body: &Body) -> String {
    let [width, height] = [0, 1].map(|axis| size(body, axis));
    let shared = "\
thickness = 1.0 # m, EXAMPLE
plane = \"stress\" # thin bodies; \"strain\" for long ones
";
    match &body.section {
        Section::Mesh { file, groups } => {
            let mut text = format!(
                "[mesh]\nfile = {} # from the folder of this file\n{shared}",
                quoted(file)
            );
            let _ = writeln!(text, "# {} m wide, {} m high.", short(width), short(height));
            if groups.is_empty() {
                text += "# It has no physical groups, so that supports and loads are placed by `box` or `at`.\n";
            } else {
                text += "# Its physical groups, each of which can stand as `group` below:\n";
            }
            for group in groups {
                let kind = ["points", "curve", "surface"][usize::from(group.dimension.min(2))];
                let _ = writeln!(
                    text,
                    "#   {} {kind}, {} nodes",
                    quoted(&group.name),
                    group.nodes.len()
                );
            }
            text
        }
        Section::Lattice {
            cells: [columns, rows],
            rows: held,
        } => {
            let (spacing, columns, rows) = (exact(body.spacing), columns, rows);
            format!(
                "\
[lattice]
cells = [{columns}, {rows}] # along x and y, with a point at the centre of each
spacing = {spacing} # m
{shared}\
#corner = [0.0, 0.0] # lower left corner, m

# Sets of cells, which stand as `group` below.
[lattice.set]
bottom = {{ bottom = {held} }} # rows from below
top = {{ top = {held} }}

# Cells of a hole are removed, and bonds across it.
#[[lattice.remove]]
#circle = {{ centre = [{}, {}], radius = {} }} # m
",
                exact(quantum(body).round(0.5 * width)),
                exact(quantum(body).round(0.5 * height)),
                exact(quantum(body).round(0.1 * width).max(body.spacing)),
            )
        }
    }
}

fn materials(body: &Body, law: Law) -> String {
    if body.parts.is_empty() {
        return format!("[material]\n{}", constants(body, law));
    }
    let mut text =
        "# A material for each physical surface; bonds between two take the smaller limit.\n"
            .to_owned();
    for part in &body.parts {
        let key = Key::new(part.as_str());
        let _ = write!(
            text,
            "[material.{}]\ngroup = {}\n{}",
            key.display_repr(),
            quoted(part),
            constants(body, law)
        );
        text.push('\n');
    }
    text.truncate(text.trim_end().len());
    text + "\n"
}

fn constants(body: &Body, law: Law) -> String {
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
    match law {
        Law::Orthotropic { .. } => format!(
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
        Law::MbbPd { .. } => {
            // What bonds of three spacings at the stretch of the example store.
            let energy =
                STRETCH.powi(2) * 2.0 * YOUNG / std::f64::consts::PI / 0.8 * 2.25 * body.spacing;
            let failure = format!(
                "fracture_energy = {} # J/m^2, EXAMPLE\n",
                exact(digits(energy, 2))
            );
            isotropic("0.2 #", &failure)
        }
        law if law.fixes_poisson() => isotropic(
            "0.3333 # the law has 1/3 (plane strain: 1/4) whatever stands here;",
            &strength,
        ),
        _ => isotropic("0.2 #", &strength),
    }
}

fn model(body: &Body, law: Law) -> String {
    let fits = |other: &Law| {
        *other != law
            && (!matches!(other, Law::MbbPd { .. })
                || matches!(body.section, Section::Lattice { .. }))
    };
    let others = Law::ALL.into_iter().filter(fits).map(|it| it.name());
    let correction = match law {
        Law::MbbPd { .. } => "",
        _ => {
            "
# Makes the body as stiff as its material, with every uniform strain in equilibrium. Others: domain (NHPD), volume, none.
[correction]
surface = \"patch\"
"
        }
    };
    format!(
        "\
# Other laws: {}; `orthotropic` and `mbb-pd` take other constants of the material.
[model]
law = \"{}\"
# Horizon of a point over the distance to its nearest neighbour. The strength depends on it, so compare runs with the same.
horizon_factor = 3.0
{correction}",
        others.collect::<Vec<_>>().join(", "),
        law.name()
    )
}

fn precrack(body: &Body, ends: &Ends) -> String {
    let quantum = quantum(body);
    let [x, y] = body.middle.map(|it| exact(quantum.round(it)));
    let length = quantum.round(0.2 * size(body, 1 - ends.axis));
    let length = exact(length.max(quantum.step));
    // Across the load.
    let angle = ["1.5707963268", "0.0"][ends.axis];
    format!(
        "\
# A crack or slot that is there from the start: bonds across it are cut. In the place of the three keys of a straight one,
# `points = [[x, y], [x, y]]` with two corners or more.
#[[precrack]]
#centre = [{x}, {y}] # m
#length = {length} # m
#angle = {angle} # rad, from the x axis, counter-clockwise; 30 degrees are 0.5235987756
"
    )
}

fn conditions(body: &Body, ends: &Ends) -> String {
    let length = size(body, ends.axis);
    let factor = if ends.presses { -PRESSED } else { PULLED };
    let displacement = exact(digits(ends.away * factor * STRETCH * length, 2));
    let (axis, how) = (
        ["x", "y"][ends.axis],
        if ends.presses {
            "towards the support"
        } else {
            "away from the support"
        },
    );
    let name = match &ends.load {
        Spot::Group(group) if group.contains([',', '"']) || group.trim() != group => {
            "name = \"load\"\n"
        }
        _ => "",
    };
    let roller = |place: &Spot| {
        let place = spot(place, body);
        format!("\n[[support]]\n{place}displacement = {{ {axis} = 0.0 }} # m, free to slide\n")
    };
    let rollers: String = ends.rollers.iter().map(roller).collect();
    let mut text = format!(
        "\
# What holds the body. It and the load were chosen {}. A component that is not given is free.
[[support]]
{}displacement = {{ x = 0.0, y = 0.0 }} # m
{rollers}
# What loads it, as it is at load factor 1. Its displacement and the force for it are the curve in history.csv. In the place of
# `displacement`: force, force_per_length, moment, pressure and others.
[[load]]
{name}{}displacement = {{ {axis} = {displacement} }} # m, {how}; EXAMPLE
",
        ends.found,
        spot(&ends.support, body),
        spot(&ends.load, body)
    );
    match &body.section {
        Section::Lattice { .. } => {
            text += "\n# Bonds that never break, so that the crack does not run along the rows that are held and moved.\n";
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

fn fracture(body: &Body, law: Law) -> String {
    let criterion = match law {
        Law::Orthotropic { .. } => format!(
            "\
# When a bond fails.
[[fracture.criterion]]
kind = \"tension\"
limit = {} # stretch, EXAMPLE
",
            exact(STRETCH)
        ),
        Law::MbbPd { .. } => "# Without a [[fracture.criterion]] bonds fail by the fracture energy (\"mixed-mode\").\n".to_owned(),
        _ => "\
# When a bond fails: at the stretch F_t/E, whatever its length. Others: strength (NHPD), sliding, frictional, critical-stretch, ...
# With a crack or notch in glass, ceramics or rock: critical-stretch or bond-energy, with the `fracture_energy` of the material. Concrete:
# bond-energy with after = \"two-branch\", with `tensile_strength` and `fracture_energy`.
[[fracture.criterion]]
kind = \"tension\"
"
        .to_owned(),
    };
    let points = (size(body, 0) / body.spacing) * (size(body, 1) / body.spacing);
    let large = if points > 20_000.0 {
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

fn records(body: &Body, ends: &Ends) -> String {
    let quantum = quantum(body);
    let point =
        |[x, y]: [f64; 2]| format!("[{}, {}]", exact(quantum.round(x)), exact(quantum.round(y)));
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
#stress = [\"virial\"] # stresses at the points
",
        point(body.opening[0]),
        point(body.opening[1]),
        ["x", "y"][ends.axis],
        point(body.middle)
    )
}

fn spot(spot: &Spot, body: &Body) -> String {
    match spot {
        Spot::Group(name) => format!("group = {}\n", quoted(name)),
        Spot::Box(corners) => {
            let quantum = quantum(body);
            let [[a, b], [c, d]] = corners.map(|corner| corner.map(|it| exact(quantum.round(it))));
            format!(
                "box = [[{a}, {b}], [{c}, {d}]] # two corners, m: the points in this rectangle\n"
            )
        }
    }
}

fn size(body: &Body, axis: usize) -> f64 {
    body.extent[1][axis] - body.extent[0][axis]
}

/// A TOML string.
fn quoted(text: &str) -> String {
    Value::from(text).to_string().trim().to_owned()
}

/// What coordinates are rounded to: a power of ten at most a tenth of the distance of points.
#[derive(Clone, Copy)]
struct Quantum {
    step: f64,
    exponent: i32,
}

fn quantum(body: &Body) -> Quantum {
    let exponent = body.spacing.log10().floor() as i32 - 1;
    Quantum {
        step: 10_f64.powi(exponent),
        exponent,
    }
}

impl Quantum {
    fn round(self, value: f64) -> f64 {
        let rounded = (value / self.step).round();
        // Division by a power of ten gives the nearest decimal, multiplication by a rounded 0.0001 does not.
        let rounded = if self.exponent < 0 {
            rounded / 10_f64.powi(-self.exponent)
        } else {
            rounded * self.step
        };
        rounded + 0.0
    }
}

/// A number rounded to so many significant digits.
fn digits(value: f64, count: usize) -> f64 {
    format!("{value:.*e}", count - 1).parse().unwrap_or(value)
}

/// A number for a sentence.
pub(super) fn short(value: f64) -> String {
    exact(digits(value, 4))
}

/// A number as TOML has it: with a point or an exponent.
fn exact(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value:?}")
    }
}
