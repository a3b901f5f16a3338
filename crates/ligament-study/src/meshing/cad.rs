//! CAD files, which gmsh reads by OpenCASCADE: the script that reads them, and the names of their groups.

use std::path::Path;

use ligament_mesh::{AnyMesh, Group};

use super::ends_in;

/// Endings of the names of CAD files, with the option by which Gmsh reads lengths in metres: OpenCASCADE reads IGES in mm whatever the file's unit,
/// and BREP has no unit.
const UNITS: [(&str, &str); 5] = [
    ("step", "Geometry.OCCTargetUnit = \"M\";\n"),
    ("stp", "Geometry.OCCTargetUnit = \"M\";\n"),
    ("iges", "Geometry.OCCScaling = 0.001;\n"),
    ("igs", "Geometry.OCCScaling = 0.001;\n"),
    ("brep", ""),
];

/// Kinds of unnamed shapes by their dimension.
const KINDS: [&str; 4] = ["point", "edge", "face", "solid"];

/// Beginning of the names that OpenCASCADE gives to shapes without one.
const UNNAMED: &str = "Open CASCADE";

/// Keyword in the output of the script before the dimension and the total volume or area of the shapes.
const SIZE: &str = "size-of-body";

/// Number of cells of a body for which a size is proposed.
const CELLS: f64 = 5000.0;

/// Whether a file is a CAD file, by its name.
pub fn is_cad(path: &Path) -> bool {
    UNITS.iter().any(|(ending, _)| ends_in(path, ending))
}

/// A script that reads a CAD file in metres, joins its parts where they touch, and makes a group of each shape with its number and its name.
pub(super) fn script(file: &Path) -> String {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let unit = UNITS.iter().find(|(ending, _)| ends_in(&file, ending));
    let unit = unit.map_or("", |(_, unit)| unit);
    let mut text = format!(
        "SetFactory(\"OpenCASCADE\");\n{unit}Geometry.OCCImportLabels = 1;\nMerge {};\n\
         v[] = Volume{{:}}; s[] = Surface{{:}};\n\
         If (#v[] > 1 || (#v[] == 0 && #s[] > 1))\n  Coherence;\nEndIf\n\
         v[] = Volume{{:}}; s[] = Surface{{:}}; c[] = Curve{{:}};\nd = 2;\nm = 0;\n",
        quoted_in_gmsh(&file)
    );
    let groups = |list: &str, kind: &str, more: &str| {
        format!(
            "For i In {{0:#{list}[]-1}}\n  \
             Physical {kind}(StrCat(Sprintf(\"%g \", {list}[i]), {kind}{{{list}[i]}}), {list}[i]) = {{{list}[i]}};\n{more}EndFor\n"
        )
    };
    let sum = |list: &str, kind: &str| format!("  k[] = Mass {kind}{{{list}[i]}};\n  m += k[0];\n");
    text += &groups("v", "Volume", &(sum("v", "Volume") + "  d = 3;\n"));
    text += "If (d == 3)\n";
    text += &groups("s", "Surface", "");
    text += "Else\n";
    text += &groups("s", "Surface", &sum("s", "Surface"));
    text += &groups("c", "Curve", "");
    text + &format!("EndIf\nPrintf(\"{SIZE} %g %g\", d, m);\n")
}

/// A path as a text in a script of Gmsh.
pub(crate) fn quoted_in_gmsh(path: &Path) -> String {
    format!("\"{}\"", path.to_string_lossy().replace('"', "\\\""))
}

/// Size of cells for about 5000 cells in a body, m, with one digit, from the output of gmsh; `None` without a body.
pub(super) fn proposed_size(lines: &[String], scale: f64) -> Option<f64> {
    let mut words = lines
        .iter()
        .find_map(|line| line.strip_prefix(SIZE))?
        .split(' ')
        .skip(1);
    let mut number = || words.next()?.parse::<f64>().ok();
    let [dimension, size] = [number()?, number()?];
    let length = scale * (size / CELLS).powf(1.0 / dimension);
    format!("{length:.0e}").parse().ok().filter(|it| *it > 0.0)
}

/// Names the groups of a mesh after their shapes, or by the kind and number of an unnamed shape.
pub(super) fn name_groups(mesh: &mut AnyMesh) {
    let groups = match mesh {
        AnyMesh::Plane(mesh) => &mut mesh.groups,
        AnyMesh::Solid(mesh) => &mut mesh.groups,
    };
    for group in groups {
        let path = group.name.split_once(' ').map_or("", |(_, path)| path);
        let name = path.rsplit('/').next().unwrap_or_default().trim();
        group.name = match name.is_empty() || name.starts_with(UNNAMED) {
            true => format!("{}-{}", KINDS[usize::from(group.dimension)], group.number),
            false => name.to_owned(),
        };
    }
}

/// Name of a group in a picture: the number of an unnamed shape of the outline, otherwise the full name.
pub fn label(group: &Group) -> String {
    let kind = KINDS[usize::from(group.dimension)];
    let number = group
        .name
        .strip_prefix(kind)
        .and_then(|it| it.strip_prefix('-'));
    match number {
        Some(number) if group.dimension < 3 => number.to_owned(),
        _ => group.name.clone(),
    }
}

#[cfg(test)]
mod tests {
    use ligament_mesh::Mesh;

    use super::*;

    #[test]
    fn groups_have_the_names_of_their_shapes_or_numbers() {
        let group = |dimension: u8, number: i32, name: &str| Group {
            name: name.to_owned(),
            dimension,
            number,
            ..Group::default()
        };
        let mut mesh = AnyMesh::Plane(Mesh {
            groups: vec![
                group(1, 4, "4 "),
                group(1, 5, "5"),
                group(2, 1, "1 Shapes/frame/left half"),
                group(2, 2, "2 Shapes/frame/Open CASCADE STEP translator 7.8 1.2"),
            ],
            ..Mesh::default()
        });
        name_groups(&mut mesh);
        let names: Vec<&str> = mesh.groups().iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["edge-4", "edge-5", "left half", "face-2"]);
        let labels: Vec<String> = mesh.groups().iter().map(label).collect();
        assert_eq!(labels, ["4", "5", "left half", "2"]);
    }

    /// A block of 10 x 20 x 25 mm has 5000 cubes of 1 mm, a sheet of 50 x 100 mm 5000 squares.
    #[test]
    fn a_size_is_proposed_for_5000_cells() {
        let proposed = |text: &str, scale| proposed_size(&[text.to_owned()], scale);
        assert_eq!(proposed("size-of-body 3 5e-06", 1.0), Some(1e-3));
        assert_eq!(proposed("size-of-body 2 5000", 1e-3), Some(1e-3));
        assert_eq!(proposed("size-of-body 2 0", 1.0), None);
        assert_eq!(proposed("Info: reading", 1.0), None);
    }
}
