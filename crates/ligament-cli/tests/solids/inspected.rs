//! `ligament inspect` of solids.

use std::fs;

use super::block::Block;
use super::{folder_with, meshes};
use crate::support::{assert_success, ligament, ligament_in, stdout};

fn inspected(block: &Block) -> String {
    let folder = folder_with(block);
    let output = ligament_in(folder.path(), &["inspect", "block.msh"]);
    assert_success(&output);
    stdout(&output)
}

/// Sizes match the block 2 x 1 x 1; the radius ratio of a sixth of a box 1/3 along all axes by hand: with edges a, a, a,
/// sqrt(2) a, sqrt(2) a and sqrt(3) a it is sqrt(2) - 1 over sqrt(3)/3 ... = 3 r/R with r = a/(2 + 2 sqrt(2)), R = sqrt(3) a/2.
#[test]
fn sizes_groups_and_quality_are_told() {
    let said = inspected(&Block::new(1.0));
    let r = 1.0 / (2.0 + 2.0 * 2.0_f64.sqrt());
    let ratio = 3.0 * r / (0.5 * 3.0_f64.sqrt());
    let quality =
        format!("radius ratio of the tetrahedra {ratio:.2} at worst, {ratio:.2} in the mean");
    for line in [
        "  nodes         112\n",
        "  cells         324 (324 tetrahedra)\n",
        "  volume        2.000 m^3\n",
        "  outline       10.00 m^2\n",
        "  bounding box  x 0 to 2.000 m, y 0 to 1.000 m, z 0 to 1.000 m\n",
        "  edges         shortest 0.3333 m, longest 0.5774 m, ratio 1.73\n",
        "  spacing       0.3333 m from a node to the next, mean 0.3333 m\n",
        &quality,
        "    left   surface       1        16  1.000 m^2  (0, 0.5000, 0.5000) m\n",
        "    right  surface       2        16  1.000 m^2  (2.000, 0.5000, 0.5000) m\n",
        "    body   volume        3       112  2.000 m^3  (1.000, 0.5000, 0.5000) m\n",
    ] {
        assert!(said.contains(line), "{line} in\n{said}");
    }
    assert!(!said.contains("note"), "{said}");
}

/// A body of 2000 m was meant in mm, and a mesh without volume groups needs none.
#[test]
fn units_and_missing_volume_groups_are_told() {
    let large = inspected(&Block::new(1000.0));
    assert!(
        large.contains("note: the body is 2000.0 m across")
            && large.contains("`ligament mesh --scale 1e-3`"),
        "{large}"
    );
    let mut block = Block::new(1.0);
    block.group = 0;
    let said = inspected(&block);
    assert!(
        said.contains("there is no volume group, and none is necessary"),
        "{said}"
    );
}

/// Slivers are counted, with the place of the worst; surfaces with cells on both sides are distinguished from the outline.
#[test]
fn slivers_and_inner_surfaces_are_told() {
    let mut block = Block::new(1.0);
    // A node moved nearly onto the plane of its neighbours along x flattens cells, and leaves all volumes positive.
    let middle = (block.nodes.iter())
        .position(|it| *it == [1.0, 1.0 / 3.0, 1.0 / 3.0])
        .unwrap();
    block.nodes[middle][0] = 4.0 / 3.0 - 1e-3;
    let inner = block.tetrahedra[100];
    block.triangles.push((7, [inner[0], inner[1], inner[2]]));
    let said = inspected(&block);
    assert!(
        said.contains("tetrahedra are slivers (radius ratio below 0.1; the worst"),
        "{said}"
    );
    assert!(said.contains("-optimize_netgen"), "{said}");
    assert!(said.contains(" m, inside of the body"), "{said}");
}

/// Tetrahedra and prisms, of which the latter have no radius ratio.
#[test]
fn meshes_of_the_repository_are_inspected() {
    let mut count = 0;
    for entry in fs::read_dir(meshes()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|it| it == "msh") {
            let output = ligament(["inspect".as_ref(), path.as_os_str()]);
            assert_success(&output);
            let said = stdout(&output);
            assert!(
                said.contains("  volume  ") && said.contains("  outline "),
                "{said}"
            );
            count += 1;
        }
    }
    assert!(count > 4, "{count} meshes");
}
