//! Problems that several tests share, as case files relative to the folder of the tests.

/// Disk of 846 points between platens that come 4e-4 m closer (E = 15 GPa, nu = 0.21, F_t = 3.81 MPa, lambda = 3).
pub const DISK: &str = r#"
mesh = { file = "../meshes/disk-4mm.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [
    { group = "platen-bottom", displacement = { y = 0.0 } },
    { group = "pole-top", displacement = { x = 0.0 } },
    { group = "pole-bottom", displacement = { x = 0.0 } },
]
load = [{ group = "platen-top", displacement = { y = -4e-4 } }]
fracture = { steps = 50 }
"#;

/// Square of side 0.1 m and 137 points, pulled upwards by 5e-5 m, which tears it.
pub const SQUARE: &str = r#"
mesh = { file = "reference/square.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { y = 0.0 } }, { group = "corner", displacement = { x = 0.0 } }]
load = [{ group = "top", displacement = { y = 5e-5 } }]
fracture = { steps = 50, stop = { load_fraction = 0.5 } }
"#;

/// Plate 0.2 x 0.1 m of 80 points, held at its left side; each test brings its load along.
pub const PLATE: &str = r#"
mesh = { file = "../meshes/plate-coarse.msh", thickness = 0.02 }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0 } }, { group = "corner", displacement = { y = 0.0 } }]
"#;

/// Bar 0.1 x 0.05 m of 277 points, one material or two.
pub const BAR: &str = r#"
mesh = { file = "../meshes/bimaterial.msh", thickness = 0.02 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 1e-5 } }]
"#;

/// Materials of the two halves of [`BAR`].
pub const TWO: &str = r#"
[material.left]
group = "left-half"
young = 15e9
poisson = 0.21
tensile_strength = 3e6
[material.right]
group = "right-half"
young = 60e9
poisson = 0.3
tensile_strength = 8e6
"#;
