//! Supports, loads, probes and materials that make no sense.

use super::*;

#[test]
fn supports_and_loads_that_make_no_sense_are_refused() {
    let load = "group = \"platen-top\"\ndisplacement = { y = -4.0e-4 }";
    assert_eq!(
        error_with("{ x = 0 }", "{ x = 1e-3 }"),
        "28:22: support.1.displacement.x: a support holds at 0, found 0.001: put prescribed \
         displacements in a [[load]]"
    );
    assert_eq!(
        error_with("{ x = 0 }", "{}"),
        "28:16: support.1.displacement: holds nothing: give a `displacement`, a `normal` or a `stiffness`"
    );
    assert_eq!(
        error_with(load, "at = [0, 0]\nforce_per_length = { y = 1 }"),
        "33:20: load.0.force_per_length: acts along the curve of a `group`, so the load needs one"
    );
    assert_eq!(
        error_with(load, "at = [0, 0]\nbody_force = { y = 1 }"),
        "32:6: load.0.at: a body force or couple acts on a volume: give `group`, `box`, or neither for the \
         whole body"
    );
    assert_eq!(
        error_with(load, "at = [0, 0]\nforce = {}"),
        "33:9: load.0.force: this load does nothing: give `x` or `y` a value"
    );
}

#[test]
fn names_are_unique_and_fit_for_columns() {
    assert_eq!(
        error_with("\"cmod\"", "\"damage-centre\""),
        "44:8: probe.1.name: `damage-centre` is already used by probe.0.name"
    );
    assert_eq!(
        error_with("\"cmod\"", "\"a, b\""),
        "39:8: probe.0.name: must be a name without commas, quotes or surrounding blanks, found \"a, b\""
    );
    for name in ["=cmd|' /C calc'!A0", "+1", "-x", "@SUM(1+1)"] {
        assert_eq!(
            error_with("\"cmod\"", &format!("{name:?}")),
            format!(
                "39:8: probe.0.name: must be a name that does not begin with =, +, - or @, by which a spreadsheet knows a \
                 formula, found {name:?}"
            )
        );
    }
    for unseen in ["a\\u0007", "a\\u2028b", "\\u202Egnp", "\\uFEFFa"] {
        let error = error_with("\"cmod\"", &format!("\"{unseen}\""));
        assert!(error.contains("invisible characters"), "{error}");
    }
    let again = "[[load]]\ngroup = \"top\"\nforce = { x = 1 }\n\n[[no_fail]]";
    assert_eq!(
        error_with("[[no_fail]]", again),
        "35:1: load.1: `top` is already used by load.0: give one of the loads another `name` (the \
         name of a load without one is its group)"
    );
}

#[test]
fn probes_take_the_keys_of_their_kind() {
    assert_eq!(
        error_with("component = \"y\"", "component = \"rotation\""),
        "51:13: probe.2.component: the force through a section has the components \"x\", \"y\" and, in a solid, \"z\" only"
    );
    assert_eq!(
        error_with("field = \"damage\"", "component = \"x\""),
        "46:13: probe.1.component: a probe `at` a point takes `field`, not `component`; one of a `group` takes one of both"
    );
}

#[test]
fn materials_are_one_or_named() {
    assert_eq!(
        error_with("[material]", "[material.rock]"),
        "7:1: material.rock.group: missing key `group` in [material.rock]"
    );
    assert_eq!(
        error_with("[material]\n", "[material]\nrock = { group = \"rock\" }\n"),
        "9:9: material.young: `young` belongs to no material: next to [material.rock] every key of \
         [material] must be in a table [material.NAME]"
    );
    let second =
        "[material.rock]\ngroup = \"a\"\nyoung = 1\npoisson = 0\n[material.steel]\ngroup = \"a\"\n";
    assert_eq!(
        error_with("[material]\n", second),
        "12:9: material.steel.group: `a` is already used by material.rock.group: a group has one material"
    );
}
