//! Sets of the program Neper: sections that it adds to the formats, as text also in binary files.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::RangeFrom;

use super::cursor::{Cursor, shortened_text};
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{Element, Records, reserve};

/// Sets of nodes, faces and cells, which become groups once all sections are read.
#[derive(Debug, Default)]
pub(super) struct NeperSets {
    nodes: Vec<NodeSet>,
    faces: Vec<FaceSet>,
    /// Offset of the section of the sets of faces, bytes.
    faces_offset: usize,
    /// Numbers of sets of cells, each with the number of its group.
    groups: Vec<(i32, i32)>,
}

#[derive(Debug)]
struct NodeSet {
    name: String,
    /// Tags of nodes with their offsets in the file, bytes.
    nodes: Vec<(u64, usize)>,
}

#[derive(Debug)]
struct FaceSet {
    name: String,
    faces: Vec<FaceRow>,
}

#[derive(Debug)]
struct FaceRow {
    /// Offset in the file, bytes.
    offset: usize,
    /// Tag of the solid cell.
    cell: u64,
    /// Tags of the nodes; of a cell of second order also of the nodes on its sides.
    nodes: Vec<u64>,
}

/// Name and size of a set, with the offset of the size.
fn set_head(cursor: &mut Cursor<'_>) -> Result<(String, usize, u64), GmshError> {
    let (_, name) = cursor.text_line()?;
    let name = String::from_utf8_lossy(name).into_owned();
    let (begin, count) = cursor.count_line("the number of members of a set")?;
    Ok((name, begin, count))
}

/// Numbers of the next line, and its offset.
fn numbers(
    cursor: &mut Cursor<'_>,
    expected: &'static str,
) -> Result<(usize, Vec<u64>), GmshError> {
    let (begin, line) = cursor.text_line()?;
    let text = std::str::from_utf8(line).ok();
    let numbers = text.and_then(|text| {
        let words = text.split_ascii_whitespace();
        words.map(|word| word.parse().ok()).collect()
    });
    let unexpected = || cursor.unexpected_text_error(begin, expected, shortened_text(line));
    Ok((begin, numbers.ok_or_else(unexpected)?))
}

impl NeperSets {
    /// Reads `$NSets` after its first line: the number of sets, then of each its name, its number of nodes, and a node a line.
    pub(super) fn read_nodes(&mut self, cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
        let (begin, count) = cursor.count_line("the number of sets of nodes")?;
        cursor.check_count(begin, count, "x\n0\n".len(), "sets of nodes")?;
        let mut sets = Vec::new();
        for _ in 0..count {
            let (name, begin, count) = set_head(cursor)?;
            let count = cursor.check_count(begin, count, "1\n".len(), "nodes of a set")?;
            let mut nodes = Vec::new();
            reserve(&mut nodes, count)?;
            for _ in 0..count {
                let (offset, node) = cursor.count_line("a node number")?;
                nodes.push((node, offset));
            }
            sets.push(NodeSet { name, nodes });
        }
        cursor.end_section()?;
        self.nodes.extend(sets);
        Ok(())
    }

    /// Reads `$Fasets` after its first line: the number of sets, then of each its name, its number of faces, and a line for each face with the
    /// solid cell and the nodes.
    pub(super) fn read_faces(&mut self, cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
        let (_, faces_offset) = cursor.section();
        let (begin, count) = cursor.count_line("the number of sets of faces")?;
        cursor.check_count(begin, count, "x\n0\n".len(), "sets of faces")?;
        let mut sets = Vec::new();
        for _ in 0..count {
            let (name, begin, count) = set_head(cursor)?;
            let count = cursor.check_count(begin, count, "1 1 2 3\n".len(), "faces of a set")?;
            let mut faces = Vec::new();
            reserve(&mut faces, count)?;
            for _ in 0..count {
                let (offset, row) = numbers(cursor, "a cell and the nodes of its face")?;
                let (cell, nodes) = (row.first().copied(), row.get(1..));
                faces.push(FaceRow {
                    offset,
                    cell: cell.unwrap_or_default(),
                    nodes: nodes.unwrap_or_default().to_vec(),
                });
            }
            sets.push(FaceSet { name, faces });
        }
        cursor.end_section()?;
        self.faces.extend(sets);
        self.faces_offset = faces_offset;
        Ok(())
    }

    /// Reads `$Groups` after its first line: what the groups consist of, their number, and a line for each set of cells with its group.
    pub(super) fn read_groups(&mut self, cursor: &mut Cursor<'_>) -> Result<(), GmshError> {
        let (begin, kind) = cursor.text_line()?;
        if kind != b"elset" {
            return Err(cursor.unexpected_text_error(
                begin,
                "the word elset",
                shortened_text(kind),
            ));
        }
        const EXPECTED: &str = "a set of cells and its group";
        let (begin, count) = cursor.count_line("the number of sets of cells")?;
        cursor.check_count(begin, count, "1 1\n".len(), "sets of cells")?;
        let mut groups = Vec::new();
        for _ in 0..count {
            let (begin, row) = numbers(cursor, EXPECTED)?;
            let row: Vec<i32> = row.iter().filter_map(|it| (*it).try_into().ok()).collect();
            let &[set, group] = row.as_slice() else {
                return Err(cursor.unexpected_text_error(begin, EXPECTED, "another row"));
            };
            groups.push((set, group));
        }
        cursor.end_section()?;
        self.groups.extend(groups);
        Ok(())
    }
}

/// Adds the sets to the records as elements in groups: points, faces, and the cells that the file has.
pub(super) fn add_groups(
    cursor: &Cursor<'_>,
    records: &mut Records,
    sets: NeperSets,
) -> Result<(), GmshError> {
    if sets.nodes.is_empty() && sets.faces.is_empty() && sets.groups.is_empty() {
        return Ok(());
    }
    let mut groups = GroupNumbers::new(records);
    for NodeSet { name, nodes } in sets.nodes {
        let owner = groups.owner(records, 0, name);
        for (node, offset) in nodes {
            push(records, (0, offset), Shape::Point, owner, &[node])?;
        }
    }
    if records.first_solid.is_some() {
        add_faces(cursor, records, &mut groups, sets.faces)?;
    } else if !sets.faces.is_empty() {
        records.ignored.push(("Fasets", sets.faces_offset));
    }
    add_groups_of_cells(records, &mut groups, &sets.groups);
    Ok(())
}

fn add_faces(
    cursor: &Cursor<'_>,
    records: &mut Records,
    groups: &mut GroupNumbers,
    sets: Vec<FaceSet>,
) -> Result<(), GmshError> {
    let rows = || sets.iter().flat_map(|it| &it.faces);
    let mut corners_of_cells = HashMap::new();
    if rows().any(|row| !matches!(row.nodes.len(), 3 | 4)) {
        let cells = records
            .elements
            .iter()
            .filter(|it| it.shape.dimension() == 3);
        corners_of_cells.extend(cells.map(|it| (it.tag, it.corners())));
    }
    for FaceSet { name, faces } in sets {
        let owner = groups.owner(records, 2, name);
        for FaceRow {
            offset,
            cell,
            nodes,
        } in faces
        {
            let mut corners = nodes;
            if !matches!(corners.len(), 3 | 4) {
                // The order of Neper is reversed: corners may come last.
                let of_cell = corners_of_cells.get(&cell).cloned().unwrap_or_default();
                corners.retain(|node| records.corners[of_cell.clone()].contains(node));
            }
            let shape = match corners.len() {
                3 => Shape::Triangle,
                4 => Shape::Quadrangle,
                _ => {
                    let expected = "a solid cell and the nodes of one of its faces";
                    let found = format!("a face of cell {cell} with other nodes");
                    return Err(cursor.unexpected_text_error(offset, expected, found));
                }
            };
            push(records, (cell, offset), shape, owner, &corners)?;
        }
    }
    Ok(())
}

/// Stores an element of a set, given by its tag and its offset in the file.
fn push(
    records: &mut Records,
    (tag, offset): (u64, usize),
    shape: Shape,
    owner: i32,
    corners: &[u64],
) -> Result<(), GmshError> {
    let first_corner = records.corners.len();
    reserve(&mut records.corners, corners.len())?;
    records.corners.extend_from_slice(corners);
    reserve(&mut records.elements, 1)?;
    records.elements.push(Element {
        tag,
        shape,
        higher_order: false,
        owner,
        first_corner,
        offset,
    });
    Ok(())
}

/// Adds the cells of each set, which is a physical group of the highest dimension, to a group named by its number.
fn add_groups_of_cells(
    records: &mut Records,
    groups: &mut GroupNumbers,
    groups_of_sets: &[(i32, i32)],
) {
    let highest = if records.first_solid.is_some() { 3 } else { 2 };
    let mut of_sets: BTreeMap<i32, BTreeSet<i32>> = BTreeMap::new();
    for &(set, group) in groups_of_sets {
        let number = groups.number(records, highest, format!("group-{group}"));
        of_sets.entry(set).or_default().insert(number);
    }
    for ((dimension, _), numbers) in &mut records.physicals {
        if *dimension == highest {
            let added = numbers.iter().filter_map(|set| of_sets.get(set)).flatten();
            let added: BTreeSet<i32> = added.copied().filter(|it| !numbers.contains(it)).collect();
            numbers.extend(added);
        }
    }
}

/// Numbers of physical groups, to which those of sets are added.
struct GroupNumbers {
    /// Numbers of the groups of each dimension and name.
    by_name: BTreeMap<(u8, String), i32>,
    /// Dimensions and numbers of all groups.
    used: BTreeSet<(u8, i32)>,
    /// Numbers of each dimension that may be free.
    numbers: [RangeFrom<i32>; 4],
    /// Numbers of owners of elements that may be free: numbers of entities are larger.
    owners: RangeFrom<i32>,
}

impl GroupNumbers {
    fn new(records: &Records) -> Self {
        let mut by_name = BTreeMap::new();
        // Number 0 means no group.
        let named = records.names.iter().filter(|((_, number), _)| *number != 0);
        for ((dimension, number), name) in named {
            let lowest = by_name.entry((*dimension, name.clone())).or_insert(*number);
            *lowest = (*lowest).min(*number);
        }
        let of_elements = records.physicals.iter();
        let of_elements = of_elements.flat_map(|((of, _), it)| it.iter().map(|it| (*of, *it)));
        Self {
            by_name,
            used: records.names.keys().copied().chain(of_elements).collect(),
            numbers: [1.., 1.., 1.., 1..],
            owners: i32::MIN..,
        }
    }

    /// Number of the physical group of a name; a new group has the lowest free number.
    fn number(&mut self, records: &mut Records, dimension: u8, name: String) -> i32 {
        let Self {
            by_name,
            used,
            numbers,
            ..
        } = self;
        let numbered = by_name.entry((dimension, name));
        *numbered.or_insert_with_key(|(_, name)| {
            let numbers = numbers[usize::from(dimension)].by_ref();
            let free = numbers.find(|it| !used.contains(&(dimension, *it)));
            let number = free.unwrap_or_default();
            records.names.insert((dimension, number), name.clone());
            number
        })
    }

    /// An owner that no element has yet, whose elements are in the group of a name.
    fn owner(&mut self, records: &mut Records, dimension: u8, name: String) -> i32 {
        let number = self.number(records, dimension, name);
        let is_free = |it: &i32| !records.physicals.contains_key(&(dimension, *it));
        let owner = self.owners.by_ref().find(is_free).unwrap_or_default();
        records.physicals.insert((dimension, owner), vec![number]);
        owner
    }
}

#[cfg(test)]
mod tests {
    use crate::gmsh::{parse, parse_any};
    use crate::{AnyMesh, Cell, Mesh, SolidMesh};

    /// Two tetrahedra on a common face, each a set of cells, as Neper writes them: unquoted names in old versions, the names behind the
    /// elements, and a name for the faces at z = 0 without elements.
    const POLYCRYSTAL: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$MeshVersion\n2.2.3\n$EndMeshVersion\n$Domain\ncube\n$EndDomain\n\
        $Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n\
        $Elements\n3\n1 15 3 1 1 0 1\n2 4 3 1 1 0 1 2 3 4\n3 4 3 2 2 0 2 3 4 5\n$EndElements\n";

    const SETS: &str = "$NSets\n2\nx0\n3\n1\n3\n4\ntop, left\n1\n4\n$EndNSets\n\
        $Fasets\n1\nz0\n1\n2 3 2 1\n$EndFasets\n\
        $PhysicalNames\n4\n0 1 ver1\n2 17 z0\n3 1 poly1\n3 2 poly2\n$EndPhysicalNames\n\
        $ElsetCrySym\ntriclinic\n$EndElsetCrySym\n\
        $Groups\nelset\n2\n1 1\n2 1\n$EndGroups\n";

    fn solid(text: &str) -> SolidMesh {
        match parse_any(text.as_bytes()).unwrap() {
            AnyMesh::Solid(mesh) => mesh,
            AnyMesh::Plane(_) => panic!("a plane mesh"),
        }
    }

    fn names<const D: usize, C>(mesh: &Mesh<D, C>) -> Vec<(u8, i32, &str)> {
        let groups = mesh.groups.iter();
        groups
            .map(|it| (it.dimension, it.number, it.name.as_str()))
            .collect()
    }

    #[test]
    fn sets_become_groups() {
        let mesh = solid(&format!("{POLYCRYSTAL}{SETS}"));
        let expected = [
            (0, 1, "ver1"),
            (0, 2, "x0"),
            (0, 3, "top, left"),
            (2, 17, "z0"),
            (3, 1, "poly1"),
            (3, 2, "poly2"),
            (3, 3, "group-1"),
        ];
        assert_eq!(names(&mesh), expected);
        assert_eq!(mesh.group("x0").unwrap().nodes, [0, 2, 3]);
        let faces = &mesh.group("z0").unwrap().faces;
        assert_eq!(*faces, [Cell::Triangle([2, 1, 0])]);
        assert_eq!(mesh.group("group-1").unwrap().cells, [0, 1]);
        let remarks: Vec<String> = mesh.remarks.iter().map(ToString::to_string).collect();
        let remark = "the section $ElsetCrySym (line 48) was ignored: nothing in it is used";
        assert_eq!(remarks, [remark]);
    }

    /// Of the six nodes of a face of second order, in the reversed order of Neper, three are corners of the cell.
    #[test]
    fn faces_of_second_order_have_the_corners_of_their_cell() {
        let text = format!("{POLYCRYSTAL}{SETS}");
        let text = text.replace("2 3 2 1\n$EndFasets", "2 31 23 12 3 2 1\n$EndFasets");
        let mesh = solid(&text);
        let faces = &mesh.group("z0").unwrap().faces;
        assert_eq!(*faces, [Cell::Triangle([2, 1, 0])]);
        let text = text.replace("2 31 23 12 3 2 1", "7 31 23 12 3 2 1");
        let error = parse_any(text.as_bytes()).unwrap_err().to_string();
        assert!(
            error.starts_with("line 39: expected a solid cell and"),
            "{error}"
        );
    }

    #[test]
    fn sets_of_another_form_are_ignored_with_a_remark() {
        let text = format!("{POLYCRYSTAL}{SETS}").replace("x0\n3\n", "x0\n3.5\n");
        let text = text.replace("elset\n2\n", "0\n");
        let mesh = solid(&text);
        assert!(mesh.group("x0").is_none() && mesh.group("group-1").is_none());
        let remark = mesh.remarks[0].to_string();
        let expected = "the sections $NSets (line 24), $ElsetCrySym (line 48), $Groups (line 51) \
            were ignored: nothing in them is used";
        assert_eq!(remark, expected);
    }

    #[test]
    fn a_set_with_a_node_that_is_missing_is_refused() {
        let text = format!("{POLYCRYSTAL}{SETS}").replace("left\n1\n4\n", "left\n1\n9\n");
        let error = parse_any(text.as_bytes()).unwrap_err().to_string();
        let expected =
            "line 33: a set names node 9, which the file does not have; save the mesh again";
        assert_eq!(error, expected);
    }

    /// In the plane, sets of faces would be cells: they are ignored.
    #[test]
    fn sets_of_a_plane_mesh_are_points_and_cells() {
        let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n\
            $Elements\n1\n1 2 2 4 4 1 2 3\n$EndElements\n$NSets\n1\ny0\n2\n1\n2\n$EndNSets\n\
            $Fasets\n1\nz0\n1\n1 1 2 3\n$EndFasets\n$Groups\nelset\n1\n4 2\n$EndGroups\n";
        let mesh = parse(text.as_bytes()).unwrap();
        assert_eq!(names(&mesh), [(0, 1, "y0"), (2, 1, "group-2"), (2, 4, "4")]);
        assert_eq!(mesh.group("y0").unwrap().nodes, [0, 1]);
        assert_eq!(mesh.group("group-2").unwrap().cells, [0]);
        assert!(mesh.remarks[0].to_string().contains("$Fasets (line 21)"));
    }
}
