//! Cases that together have every table of a case file, and the tables of documents and of the schema.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

use super::{SCHEMA, document};

const SOLID: &str = r#"
title = "On a box of cells"
material = { young = 1e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3 }
[solid_lattice]
cells = [4, 4, 4]
spacing = [0.1, 0.1, 0.1]
remove = [
    { name = "void", sphere = { centre = [0.2, 0.2, 0.2], radius = 0.05 } },
    { cylinder = { ends = [[0, 0, 0], [0, 0, 0.1]], radius = 0.01 } },
    { outside_sphere = { centre = [0.2, 0.2, 0.2], radius = 1 } },
    { outside_cylinder = { ends = [[0.2, 0.2, 0], [0.2, 0.2, 1]], radius = 1 } },
]
[solid_lattice.set]
left = { left = 1 }
right = { right = 1 }
ball = { sphere = { centre = [0.2, 0.2, 0.2], radius = 0.2 } }
axis = { cylinder = { ends = [[0.2, 0.2, 0], [0.2, 0.2, 0.4]], radius = 0.2 } }
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0, z = 0.0 }
[[load]]
group = "right"
force_per_area = { z = 1 }
[[load]]
name = "turned"
group = "right"
moment = { z = 1 }
[[precrack]]
centre = [0.2, 0.2, 0.2]
normal = [0, 0, 1]
radius = 0.1
[[probe]]
name = "front"
tip = [0.3, 0.2, 0.2]
quantity = "K_III"
front_length = 0.1
[[load]]
name = "twisted"
body_couple = { z = 1 }
[[rigid]]
name = "floor"
shape = "box"
centre = [0.2, 0.2, -0.2]
size = [1, 1, 0.2]
displacement = { z = 0.001 }
"#;

const MESH: &str = r#"
title = "On a mesh"
mesh = { file = "disk.msh" }
material = { young = 1e9, poisson = 0.2, tensile_strength = 1e6 }
model = { law = "nhpd", horizon_factor = 3 }
solver = "auto"
correction = {}
precrack = [{ points = [[0, 0], [1, 0]] }, { centre = [0, 0], length = 0.1, angle = 0.5 }]
support = [{ group = "bottom", displacement = { x = 0.0 } }, { at = [0, 0], normal = [1, 1], stiffness = { normal = 1e9 } }]
no_fail = [{ box = [[0, 0], [1, 1]] }]
[[load]]
group = "top"
displacement = { y = 0.1 }
profile = { along = "x", zero = 0, one = 1 }
[[load]]
group = "left"
force = { x = 1 }
profile = { file = "factors.csv" }
[[load]]
group = "right"
force_per_length = { x = 1 }
[[load]]
body_force = { x = 1 }
[[load]]
name = "pressed"
group = "hole"
pressure = 1e5
[[temperature]]
mesh_field = "T"
[[probe]]
name = "opening"
between = [[0, 0], [1, 0]]
component = "x"
[[probe]]
name = "damage"
at = [0, 0]
field = "damage"
[[probe]]
name = "mean"
group = "top"
field = "strain.xx"
[[probe]]
name = "force"
section = [[0, 0], [1, 0]]
component = "y"
[[stage]]
loads = { top = 1 }
steps = 10
control = { probes = { opening = 1.0 }, to = 1e-4 }
[fracture]
stop = { load_fraction = 0.5 }
scatter = { of = "strength", modulus = 12 }
criterion = [{ kind = "frictional" }, { kind = "tension", limit = 1e-4, after = { kink = [0.2, 0.3] }, end = 9 }]
[output]
stress = ["material", "virial"]
"#;

const LATTICE: &str = r#"
title = "On a lattice"
[lattice]
cells = [10, 20]
spacing = 0.1
remove = [{ circle = { centre = [0.5, 0.5], radius = 0.1 } }, { name = "rim", outside = { centre = [0.5, 1], radius = 1 } }]
set = { bottom = { bottom = 1 }, top = { circle = { centre = [0.5, 1], radius = 0.2 } } }
[material.fibre]
group = "bottom"
young_1 = 1e9
young_2 = 1e9
poisson_12 = 0.2
shear_modulus = 1e8
[material.matrix]
group = "top"
young = 1e9
poisson = 0.2
[model]
law = "orthotropic"
horizon = 0.3
[solver]
[[load]]
group = "top"
moment = 1
[[temperature]]
change = 10
[[stage]]
name = "heat"
loads = { temperature = [[0.5, 2], [1, 1.5]] }
[[stage]]
loads = { top = [1, -1, 0.5], temperature = 0 }
[fracture]
control = "event"
stop = { wall_time = 10 }
scatter = [{ of = "strength", modulus = 12, seed = 3 }]
criterion = [{ kind = "tension", limit = 1e-4 }]
"#;

const MODAL: &str = r#"
analysis = "modal"
[lattice]
cells = [10, 20]
spacing = 0.1
[material]
c11 = 1e9
c12 = 1e8
c16 = 0
c22 = 1e9
c26 = 0
c66 = 1e8
density = 1000
[model]
law = "mbb-pd"
horizon_factor = 3
[modal]
"#;

const MOTION: &str = r#"
[lattice]
cells = [10, 20]
spacing = 0.1
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 1e9
poisson = 0.2
density = 1000
[model]
law = "nhpd"
horizon_factor = 3
[[load]]
name = "pulled"
group = "right"
velocity = { x = 1 }
amplitude = { points = [[0, 0], [1e-3, 1]] }
[[load]]
name = "shaken"
at = [0, 0]
base_acceleration = { y = 1 }
amplitude = { shape = "sine", duration = 1e-3 }
[[load]]
name = "read"
body_force = { y = 1 }
amplitude = { file = "pulse.csv" }
[[initial_velocity]]
velocity = { x = 1 }
[[initial_velocity]]
at = [0, 0]
velocity = { y = 1 }
[[quiet]]
group = "right"
[[contact]]
between = ["left", "right"]
[[rigid]]
name = "ball"
shape = "circle"
centre = [0, 3]
radius = 1
velocity = { x = -1 }
amplitude = { shape = "sine", duration = 1 }
[[rigid]]
name = "floor"
shape = "wall"
centre = [0, 0]
normal = [0, 1]
against = ["right"]
[[rigid]]
name = "block"
shape = "box"
centre = [0, 9]
size = [1, 1]
velocity = { y = -1 }
mass = 2
inertia = 1
acceleration = { y = -1 }
[[rigid]]
name = "shot"
shape = "circle"
centre = [0, 99]
radius = 1
mass = 2
acceleration = { x = 1 }
[motion]
duration = 1e-2
damping = {}
stop = { bonds = 3 }
"#;

const ORTHOTROPIC: &str = r#"
[lattice]
cells = [10, 20]
spacing = 0.1
[material]
young_1 = 1e9
young_2 = 1e9
poisson_12 = 0.2
shear_modulus = 1e8
[model]
law = "orthotropic"
horizon = 0.3
[correction]
surface = "domain"
[[precrack]]
points = [[0, 0], [1, 0]]
[[probe]]
name = "J"
tip = [0, 0]
quantity = "J"
radii = [0.1, 0.2]
growing = true
[[load]]
body_couple = 1.0
[[load]]
name = "upward"
body_force = { y = 1 }
[[load]]
name = "weight"
acceleration = { y = -9.81 }
[[load]]
name = "thrown"
acceleration = { x = 1 }
[[load]]
at = [0, 0]
force = { y = 1 }
[[load]]
group = "top"
force_per_length = { y = 1 }
[fracture]
control = "event"
criterion = [{ kind = "tension", limit = 1e-4 }]
[output]
"#;

const FAR_FIELD: &str = r#"
mesh = { file = "disk.msh" }
material = { young = 1e9, poisson = 0.2 }
model = { law = "nhpd", horizon_factor = 3 }
correction = { surface = "patch" }
far_field = { near = [{ group = "middle" }, { box = [[0, 0], [1, 1]] }] }
load = [{ group = "top", force = { y = 1 } }]
"#;

const REFINED: &str = r#"
mesh = { file = "disk.msh" }
material = { young = 1e9, poisson = 0.2, tensile_strength = 1e6 }
model = { law = "nhpd", horizon_factor = 3 }
refine = { levels = 2 }
load = [{ group = "top", force = { y = 1 } }]
fracture = { steps = 4, criterion = [{ kind = "bond-rankine" }] }
"#;

const JOINT: &str = r#"
mesh = { file = "disk.msh" }
interface = [{ between = ["brick", "mortar"], tensile_strength = 1e5 }]
model = { law = "nhpd", horizon_factor = 3 }
load = [{ group = "top", force = { y = 1 } }]
fracture = { steps = 4, criterion = [{ kind = "bond-rankine" }] }
[material.brick]
group = "brick"
young = 1e9
poisson = 0.2
tensile_strength = 1e6
[material.mortar]
group = "mortar"
young = 1e9
poisson = 0.2
tensile_strength = 1e6
"#;

/// The mesh has strengths for all of its criteria.
pub(super) fn documents() -> Vec<Value> {
    let mesh = MESH.replace(
        "tensile_strength",
        "compressive_strength = 1e7, tensile_strength",
    );
    // Keys of one correction stand in another document than those of the other.
    let patch = ORTHOTROPIC.replace("\"domain\"", "\"patch\"");
    // The scheme that takes all keys of implicit steps.
    let scheme = "duration = 1e-2\nscheme = \"auto\"\nstep = 1e-4";
    let implicit = MOTION.replace("duration = 1e-2", scheme);
    // A rigid body with a mass takes explicit steps.
    let implicit = implicit
        .replace("mass = 2\ninertia = 1\nacceleration = { y = -1 }\n", "")
        .replace("mass = 2\nacceleration = { x = 1 }\n", "");
    [
        mesh.as_str(),
        FAR_FIELD,
        REFINED,
        JOINT,
        LATTICE,
        SOLID,
        MODAL,
        MOTION,
        &implicit,
        ORTHOTROPIC,
        &patch,
    ]
    .map(document)
    .to_vec()
}

/// The path of a table: its keys and indices, and the same with a star for indices and for names that the user chooses.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct TablePath {
    pub(super) pointer: String,
    pub(super) pattern: String,
}

impl TablePath {
    fn child(&self, segment: &str, pattern: &str) -> Self {
        Self {
            pointer: format!("{}/{segment}", self.pointer),
            pattern: format!("{}/{pattern}", self.pattern),
        }
    }
}

/// All tables of a document with the schema of each.
pub(super) fn tables(document: &Value) -> Vec<(TablePath, Value)> {
    let mut found = Vec::new();
    collect(document, &SCHEMA, &TablePath::default(), &mut found);
    found
}

fn collect(value: &Value, schema: &Value, path: &TablePath, found: &mut Vec<(TablePath, Value)>) {
    match value {
        Value::Object(entries) => {
            let schema = of_tables(schema);
            found.push((path.clone(), schema.clone()));
            for (key, value) in entries {
                match schema["properties"].get(key) {
                    Some(below) => collect(value, below, &path.child(key, key), found),
                    None => {
                        let below = &schema["additionalProperties"];
                        assert!(below.is_object(), "{key} at {}", path.pointer);
                        collect(value, below, &path.child(key, "*"), found);
                    }
                }
            }
        }
        Value::Array(values) => {
            for (index, value) in values.iter().enumerate() {
                collect(
                    value,
                    of_lists(schema),
                    &path.child(&index.to_string(), "*"),
                    found,
                );
            }
        }
        _ => {}
    }
}

/// Of a key that takes a table among others, what the table is.
fn of_tables(schema: &Value) -> &Value {
    let alternatives = schema["anyOf"]
        .as_array()
        .filter(|_| schema["type"].is_null());
    let table = alternatives.and_then(|all| all.iter().find(|it| it["type"] == "object"));
    table.unwrap_or(schema)
}

/// The elements of a list; of a key that takes a table or a list of tables, those tables.
fn of_lists(schema: &Value) -> &Value {
    let alternatives = schema["anyOf"].as_array().into_iter().flatten();
    let tables = alternatives.map(|it| &it["items"]);
    let mut tables = tables.filter(|it| it["type"] == "object");
    tables.next().unwrap_or(&schema["items"])
}

/// Patterns of all tables of the schema, and all keys: pattern of the table, key, schema.
pub(super) fn all_of_schema() -> (BTreeSet<String>, Vec<(String, String, Value)>) {
    let (mut tables, mut keys) = (BTreeSet::new(), Vec::new());
    walk(&SCHEMA, "", &mut tables, &mut keys);
    (tables, keys)
}

fn walk(
    schema: &Value,
    pattern: &str,
    tables: &mut BTreeSet<String>,
    keys: &mut Vec<(String, String, Value)>,
) {
    let elements = of_lists(schema);
    if elements.is_object() {
        walk(elements, &format!("{pattern}/*"), tables, keys);
    }
    let schema = of_tables(schema);
    if schema["type"] != "object" {
        return;
    }
    tables.insert(pattern.to_owned());
    for (key, value) in schema["properties"].as_object().unwrap_or(&Map::new()) {
        keys.push((pattern.to_owned(), key.clone(), value.clone()));
        walk(value, &format!("{pattern}/{key}"), tables, keys);
    }
    if schema["additionalProperties"].is_object() {
        walk(
            &schema["additionalProperties"],
            &format!("{pattern}/*"),
            tables,
            keys,
        );
    }
}
