//! Parts, instances and the assembly.

use super::{group, labels, plane, read, refusal, remarks, solid};
use ligament_mesh::inp::Scope;
use ligament_mesh::{DeckRemark, Remark};

/// A square part, and two instances side by side, of which the second is moved and turned.
const PAIR: &str = "\
*Part, name=Square
*Node
1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.
*Element, type=CPS4R
1, 1, 2, 3, 4
*Nset, nset=Low
1, 2
*Elset, elset=All
1
*Solid Section, elset=All, material=Rock
1.,
*End Part
*Assembly, name=Assembly
*Instance, name=Square-1, part=Square
*End Instance
*Instance, name=Square-2, part=square
3., 0., 0.
3., 0., 0., 3., 0., 1., 90.
*End Instance
*Node
1, 9., 9.
*Nset, nset=Point
1,
*Nset, nset=Corner, instance=square-2
3
*Nset, nset=Mixed
Square-1.4, Assembly.Square-2.Low, Corner
*Elset, elset=_Side_S2, internal, instance=Square-1
1,
*Surface, type=ELEMENT, name=Side
_Side_S2, S2
Square-2.1, S1
*End Assembly
*Material, name=Rock
";

#[test]
fn instances_are_moved_and_turned() {
    let deck = read(PAIR);
    let mesh = plane(&deck);
    assert_eq!(mesh.cells.len(), 2);
    assert_eq!(
        mesh.positions[4..],
        [[3.0, 0.0], [3.0, 1.0], [2.0, 1.0], [2.0, 0.0]]
    );
    assert_eq!(mesh.node_tags[..], [1, 2, 3, 4, 11, 12, 13, 14]);
    let instances = deck.instances.iter();
    let instances: Vec<_> = instances
        .map(|it| (&*it.name, &*it.part, it.shift))
        .collect();
    let [first, second] = [("Square-1", 0), ("Square-2", 10)];
    let of_part = |(name, shift)| (name, "Square", shift);
    assert_eq!(instances, [of_part(first), of_part(second)]);
    assert_eq!(labels(&deck, "Square-1.Low"), [1, 2]);
    assert_eq!(labels(&deck, "square-2.low"), [11, 12]);
    assert_eq!(labels(&deck, "Corner"), [13]);
    assert_eq!(labels(&deck, "Mixed"), [4, 11, 12, 13]);
    assert_eq!(labels(&deck, "Side"), [2, 3, 11, 12]);
    assert_eq!(group(&deck, "Side").edges.len(), 2);
    let names: Vec<&str> = mesh.groups.iter().map(|it| it.name.as_str()).collect();
    let expected = [
        "Square-1.Low",
        "Square-2.Low",
        "Corner",
        "Mixed",
        "Side",
        "Square-1.All",
        "Square-2.All",
        "_Side_S2",
    ];
    assert_eq!(names, expected);
    let shifted = DeckRemark::ShiftedNumbers {
        instance: "Square-2".to_owned(),
        shift: 10,
    };
    let left_out = DeckRemark::LeftOutMembers {
        set: "Point".to_owned(),
        undefined: 0,
        beside: 1,
        is_group: false,
    };
    assert_eq!(mesh.remarks[0], Remark::UnusedNodes { nodes: 1 });
    assert_eq!(remarks(&deck), [(19, shifted), (25, left_out)]);
    let scopes: Vec<&Scope> = deck.keywords.iter().map(|it| &it.scope).collect();
    assert_eq!(scopes, [&Scope::Part("Square".to_owned()), &Scope::Model]);
}

#[test]
fn an_instance_may_define_the_mesh_itself() {
    let deck = read(
        "*PART, NAME=P\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n0, 0, 2
*NODE, NSET=All\n1, 0, 0\n2, 1, 0\n3, 0, 1\n4, 0, 0, 1
*ELEMENT, TYPE=C3D4, ELSET=E\n1, 1, 2, 3, 4
*DENSITY\n1.
*END INSTANCE
*ELSET, ELSET=Same\n1
*END ASSEMBLY
",
    );
    assert_eq!(solid(&deck).positions[3], [0.0, 0.0, 3.0]);
    assert_eq!(group(&deck, "I.E").cells, [0]);
    assert_eq!(labels(&deck, "I.All"), [1, 2, 3, 4]);
    // A number in an assembly of one instance.
    assert_eq!(group(&deck, "Same").cells, [0]);
    assert_eq!(deck.keywords[0].scope, Scope::Instance("I".to_owned()));
    assert_eq!(deck.mesh.remarks(), []);
}

#[test]
fn a_single_part_needs_no_instance() {
    let text = PAIR.split("*Assembly").next().unwrap();
    let deck = read(text);
    assert_eq!((deck.mesh.n_cells(), labels(&deck, "Low")), (1, vec![1, 2]));
    let other = text.replace("name=Square", "name=Other");
    let error = refusal(&format!("{text}{other}"));
    assert!(
        error.starts_with("line 1: no part has an instance"),
        "{error}"
    );
    let deck = read(&format!("{other}{PAIR}"));
    let remark = DeckRemark::PartWithoutInstance {
        part: "Other".to_owned(),
        elements: 1,
    };
    assert_eq!(remarks(&deck)[0], (1, remark));
}

#[test]
fn faults_of_assemblies_are_named_with_their_lines() {
    for (old, new, expected) in [
        (
            "part=square",
            "part=Round",
            "line 19: there is no part Round",
        ),
        (
            "name=Square-2",
            "name=square-1",
            "line 19: the instance square-1 was already defined at line 17",
        ),
        (
            "instance=square-2",
            "instance=Square-3",
            "line 27: there is no instance Square-3",
        ),
        (
            "Square-1.4",
            "Square-3.4",
            "line 30: there is no node set Square-3.4",
        ),
        ("*End Part\n", "", "line 15: *ASSEMBLY cannot be here"),
        (
            "*End Assembly\n",
            "",
            "line 16: *ASSEMBLY cannot be here: it has no end",
        ),
        (
            "*Assembly, name=Assembly\n",
            "",
            "line 16: *INSTANCE cannot be here",
        ),
        (
            "*Material",
            "*End Part\n*Material",
            "line 37: *END PART cannot be here",
        ),
        (
            "*Material",
            "*Part, name=square\n*Material",
            "line 37: the part square was already defined at line 1",
        ),
        (
            "3., 0., 1., 90.",
            "3., 0., 0., 90.",
            "line 21: expected two different points",
        ),
        (
            "3., 0., 0.\n3.",
            "1.\n3., 0., 0.\n3.",
            "line 22: expected a translation and a rotation",
        ),
        (
            "part=square",
            "instance=Old",
            "line 19: *INSTANCE from the results of another analysis",
        ),
        (
            "1, 1, 2, 3, 4",
            "1, 1, 2, 3, 5",
            "line 8: element Square-1.1 names node 5",
        ),
        (
            "3., 0., 0.\n3., 0., 0., 3., 0., 1., 90.",
            "0.25, 0.25",
            "line 8: element Square-2.1 lies over element Square-1.1",
        ),
    ] {
        assert_eq!(PAIR.matches(old).count(), 1, "{old}");
        let error = refusal(&PAIR.replace(old, new));
        assert!(error.starts_with(expected), "{error}");
    }
    // Instances that touch do not share nodes.
    let error = refusal(&PAIR.replace("3., 0., 0.\n3., 0., 0., 3., 0., 1., 90.", "1., 0., 0."));
    let expected = "line 3: nodes Square-1.2 (line 4) and Square-2.1 are at one place, as 1 pairs of outer sides";
    assert!(error.starts_with(expected), "{error}");
}
