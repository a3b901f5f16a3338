//! Wrong inputs of solids: each gives an error at its place with advice, or a warning where the command can continue.

use super::block::{Block, SOLID, case};
use super::{folder_with, with_case};

/// Refusal by `check` of a case on a mesh, without a panic.
fn refused(block: &Block, case: &str) -> String {
    let folder = folder_with(block);
    let (is_good, said) = with_case(folder.path(), case, &["check", "--model-only", "case.toml"]);
    assert!(!is_good, "{case}\n{said}");
    assert!(
        said.contains("error: ") && !said.contains("panicked"),
        "{said}"
    );
    said
}

fn assert_contains(said: &str, words: &[&str]) {
    for word in words {
        assert!(said.contains(word), "`{word}` in\n{said}");
    }
}

/// The surface of the block alone: in space, so no plane mesh either.
#[test]
fn a_surface_is_no_solid() {
    let mut block = Block::new(1.0);
    block.tetrahedra.clear();
    let said = refused(&block, &case(SOLID));
    assert_contains(
        &said,
        &[
            "mesh.file",
            "has no solid cells and is not planar",
            "mesh the volume (`gmsh -3`)",
        ],
    );
    // A flat surface is a mesh of the plane: the keys of a solid do not fit it.
    for node in &mut block.nodes {
        node[2] = 0.0;
    }
    block.triangles = vec![(1, [0, 16, 4]), (2, [4, 16, 20])];
    let said = refused(&block, &case(SOLID));
    assert_contains(
        &said,
        &[
            "support.0.displacement",
            "a body in the plane",
            "block.msh has no solid cells",
            "`gmsh -3`",
        ],
    );
}

/// A plate beside the block: dropped with a note where it is in no group and no face of it is in one, else refused.
#[test]
fn plane_cells_beside_solid_ones_are_refused() {
    let mut block = Block::new(1.0);
    let n = block.nodes.len();
    block
        .nodes
        .extend([[3.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 0.0, 1.0]]);
    block.triangles.push((5, [n, n + 1, n + 2]));
    let said = refused(&block, &case(SOLID));
    assert_contains(
        &said,
        &[
            "of the surface \"5\"",
            "is a face of no solid cell",
            "mesh surface and volume together",
        ],
    );
}

/// Inverted cells are reoriented; a cell that is inverted by a node moved through its face overlaps others.
#[test]
fn inverted_tetrahedra_are_turned_or_refused() {
    let mut block = Block::new(1.0);
    for cell in &mut block.tetrahedra {
        cell.swap(0, 1);
    }
    let folder = folder_with(&block);
    let (is_good, said) = with_case(
        folder.path(),
        &case(SOLID),
        &["check", "--model-only", "case.toml"],
    );
    assert!(is_good, "{said}");
    assert_contains(&said, &["volume                2.000 m^3"]);
    let mut block = Block::new(1.0);
    let middle = block
        .nodes
        .iter()
        .position(|it| *it == [1.0, 1.0 / 3.0, 1.0 / 3.0]);
    block.nodes[middle.unwrap()][0] += 0.7;
    assert_contains(
        &refused(&block, &case(SOLID)),
        &["overlaps", "mesh the geometry again"],
    );
}

#[test]
fn flat_tetrahedra_are_refused() {
    let mut block = Block::new(1.0);
    for node in &mut block.nodes {
        node[2] *= 1e-9;
    }
    assert_contains(
        &refused(&block, &case(SOLID)),
        &["is flat", "gmsh -3 -optimize"],
    );
}

/// Without volume groups one material fills the body; one for each of several groups is asked for.
#[test]
fn solids_without_volume_groups_have_one_material() {
    let mut block = Block::new(1.0);
    block.group = 0;
    let folder = folder_with(&block);
    let (is_good, said) = with_case(
        folder.path(),
        &case(SOLID),
        &["check", "--model-only", "case.toml"],
    );
    assert!(is_good, "{said}");
    let parts = case(SOLID).replace("[material]", "[material.rock]\ngroup = \"body\"");
    assert_contains(&refused(&block, &parts), &["material.rock.group", "`body`"]);
    let surface = case(SOLID).replace("[material]", "[material.rock]\ngroup = \"left\"");
    assert_contains(&refused(&block, &surface), &["material.rock.group", "left"]);
}

#[test]
fn millimetres_are_warned_of() {
    let folder = folder_with(&Block::new(1000.0));
    let (is_good, said) = with_case(
        folder.path(),
        &case(SOLID),
        &["check", "--model-only", "case.toml"],
    );
    assert!(is_good, "{said}");
    assert_contains(
        &said,
        &[
            "warning: the body is 2000.0 m across",
            "`mesh.scale = 1e-3`",
        ],
    );
}

/// A path that leads nowhere, or to no mesh, is reported before any setting that is right for a solid.
#[test]
fn a_mesh_that_cannot_be_read_is_named_first() {
    let block = Block::new(1.0);
    let nowhere = case(SOLID).replace("block.msh", "nowhere.msh");
    assert_contains(
        &refused(&block, &nowhere),
        &[
            "case.toml:2:8: mesh.file: cannot read the mesh",
            "nowhere.msh",
            "relative to the folder of the case file",
        ],
    );
    let itself = case(SOLID).replace("block.msh", "case.toml");
    assert_contains(
        &refused(&block, &itself),
        &["mesh.file: cannot use the mesh", "not a Gmsh mesh file"],
    );
    // Errors that do not depend on the mesh come first.
    let misspelt = nowhere.replace("young", "yong");
    assert_contains(&refused(&block, &misspelt), &["did you mean `young`"]);
}

/// Keys of the plane in a case of a solid, each at its place.
#[test]
fn keys_of_the_plane_are_refused() {
    let [head, support, load, _] = SOLID;
    let box_in_plane = "box = [[1.9, -1.0], [2.1, 2.0]]\ndisplacement = { x = 1e-4 }";
    let turned = "group = \"right\"\ndisplacement = { rotation = 1e-4 }";
    let per_length = "group = \"right\"\nforce_per_length = { x = 1.0 }";
    let probe = |reading: &str| format!("[[probe]]\nname = \"a\"\n{reading}");
    let thick = format!("{head}\nthickness = 0.1");
    let plane = format!("{head}\nplane = \"strain\"");
    let line = "[[precrack]]\ncentre = [1.0, 0.5, 0.5]\nlength = 0.2\nangle = 0.0";
    let corners = "[[precrack]]\npoints = [[1.0, 0.0], [1.0, 1.0]]";
    let turn = probe("between = [[0, 0, 0], [2, 0, 0]]\ncomponent = \"rotation\"");
    let turn_at = probe("at = [0, 0, 0]\nfield = \"rotation\"");
    let section = probe("section = [[1, 0], [1, 1]]\ncomponent = \"x\"");
    for (parts, words) in [
        (
            [&*thick, support, load, ""],
            ["mesh.thickness", "solid cells"],
        ),
        ([&*plane, support, load, ""], ["mesh.plane", "solid cells"]),
        (
            [head, support, box_in_plane, ""],
            ["load.0.box.0", "three coordinates"],
        ),
        (
            [head, support, turned, ""],
            ["load.0.displacement", "rotation_x"],
        ),
        (
            [head, support, per_length, ""],
            ["load.0.group", "force per area"],
        ),
        ([head, support, load, line], ["precrack.0.length", "lines"]),
        (
            [head, support, load, corners],
            ["precrack.0.points.0", "three coordinates"],
        ),
        (
            [head, support, load, &*turn],
            ["probe.0.component", "rotation_x"],
        ),
        (
            [head, support, load, &*turn_at],
            ["probe.0.field", "rotation.x"],
        ),
        (
            [head, support, load, &*section],
            ["probe.0.section.0", "three coordinates"],
        ),
    ] {
        assert_contains(&refused(&Block::new(1.0), &case(parts)), &words);
    }
    let law = case(SOLID).replace("\"nhpd\"", "\"mbb-pd\"");
    assert_contains(
        &refused(&Block::new(1.0), &law),
        &["model.law", "is a law of the plane"],
    );
    let springs = case(SOLID).replace("\"nhpd\"", "\"pds\"");
    let closing = springs.replace("[model]", "[model]\nclosing = true");
    assert_contains(
        &refused(&Block::new(1.0), &closing),
        &["model.closing", "only where points turn"],
    );
}

/// Keys of solids in a case of the plane.
#[test]
fn keys_of_solids_are_refused_in_the_plane() {
    let plate = "[lattice]\ncells = [8, 4]\nspacing = 0.01\nset = { left = { left = 1 }, right = { right = 1 } }";
    let held = "group = \"left\"\ndisplacement = { x = 0.0, y = 0.0 }";
    let pulled = "group = \"right\"\ndisplacement = { x = 1e-6 }";
    let held_along_z = "group = \"left\"\ndisplacement = { x = 0.0, y = 0.0, z = 0.0 }";
    let per_area = "group = \"right\"\nforce_per_area = { x = 1.0 }";
    let box_in_space = "box = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]\ndisplacement = { x = 1e-6 }";
    let disk = "[[precrack]]\ncentre = [0.04, 0.02]\nnormal = [1.0, 0.0]\nradius = 0.01";
    let probe = "[[probe]]\nname = \"a\"\nbetween = [[0, 0], [1, 0]]\ncomponent = \"z\"";
    let turn = "[[probe]]\nname = \"a\"\nat = [0, 0]\nfield = \"rotation.x\"";
    for (parts, words) in [
        (
            [plate, held_along_z, pulled, ""],
            ["support.0.displacement", "body in the plane"],
        ),
        (
            [plate, held, per_area, ""],
            ["load.0.force_per_area", "force per length"],
        ),
        (
            [plate, held, box_in_space, ""],
            ["load.0.box.0", "two coordinates"],
        ),
        (
            [plate, held, pulled, disk],
            ["precrack.0.normal", "surfaces"],
        ),
        ([plate, held, pulled, probe], ["probe.0.component", "plane"]),
        ([plate, held, pulled, turn], ["probe.0.field", "`rotation`"]),
    ] {
        assert_contains(&refused(&Block::new(1.0), &case(parts)), &words);
    }
}
