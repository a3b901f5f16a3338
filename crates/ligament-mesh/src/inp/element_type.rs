//! Element types of Abaqus and CalculiX.

use std::ops::RangeInclusive;

/// State of the plane in which a planar mesh deforms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// No stress out of the plane: thin bodies.
    Stress,
    /// No strain out of the plane: long bodies.
    Strain,
}

/// Shape of an element, by its corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Edge,
    Triangle,
    Quadrangle,
    Tetrahedron,
    Pyramid,
    Prism,
    Hexahedron,
}

impl Shape {
    pub(super) fn corners(self) -> usize {
        match self {
            Shape::Edge => 2,
            Shape::Triangle => 3,
            Shape::Quadrangle | Shape::Tetrahedron => 4,
            Shape::Pyramid => 5,
            Shape::Prism => 6,
            Shape::Hexahedron => 8,
        }
    }
}

/// Use of the elements of a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    /// Cells of a solid body.
    Solid,
    /// Cells of a planar body, with the state of the plane if it is known.
    Plane(Option<Plane>),
    /// Shells and membranes, which are cells where the deck has no others.
    Shell,
    /// Surfaces and lines without a body of their own: rigid ones, beams, trusses.
    Lower,
    /// Springs, masses and others without a shape.
    Other,
}

/// An element type that a deck uses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct ElementType {
    pub(super) name: String,
    pub(super) usage: Use,
    /// Shape of the corners; `None` for types without a shape.
    pub(super) shape: Option<Shape>,
    /// Numbers of nodes that an element may have.
    pub(super) nodes: RangeInclusive<usize>,
}

/// Reason why a type is not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Refusal {
    Unknown,
    Axisymmetric,
    GeneralisedPlaneStrain,
}

/// Beginnings of the names of types without a shape that serves a mesh: masses, springs, connectors, cohesive and infinite elements, ...
const WITHOUT_SHAPE: [&str; 36] = [
    "AC1D", "AC2D", "AC3D", "ACIN", "CIN", "COD", "COH", "CONN", "DASHPOT", "DC1D", "DCC", "DCOUP",
    "DGAP", "DRAG", "F2D", "F3D", "FLINK", "GAP", "GK", "HEATCAP", "IRS", "ISL", "ISP", "ITS",
    "ITT", "JOINT", "LS", "MASS", "PC3D", "PD3D", "PSI", "ROTARYI", "SPRING", "TSHEAR", "USER",
    "WARP",
];

/// Beginnings of the names of types, before their number of nodes, with the use of such elements.
const FAMILIES: [(&str, Use); 15] = [
    ("CPE", Use::Plane(Some(Plane::Strain))),
    ("CPS", Use::Plane(Some(Plane::Stress))),
    ("DC2D", Use::Plane(None)),
    ("C3D", Use::Solid),
    ("DC3D", Use::Solid),
    ("Q3D", Use::Solid),
    ("SC", Use::Solid),
    ("CSS", Use::Solid),
    ("S", Use::Shell),
    ("DS", Use::Shell),
    ("STRI", Use::Shell),
    ("M3D", Use::Shell),
    ("SFM3D", Use::Lower),
    ("R3D", Use::Lower),
    ("DCSS", Use::Solid),
];

/// Beginnings of the names of types of lines, before the number of their nodes.
const LINES_BY_NODES: [&str; 5] = ["T2D", "T3D", "R2D", "RB2D", "RB3D"];

/// Beginnings of the names of beams, before the number of their dimensions and the degree of their shape functions.
const BEAMS: [&str; 4] = ["B", "PIPE", "ELBOW", "FRAME"];

impl ElementType {
    /// The type of a given name.
    pub(super) fn new(name: &str) -> Result<Self, Refusal> {
        let name = name.to_uppercase();
        let digits = name.find(|it: char| it.is_ascii_digit());
        let letters = &name[..digits.unwrap_or(name.len())];
        if letters.contains("AX") {
            return Err(Refusal::Axisymmetric);
        }
        if letters == "CPEG" {
            return Err(Refusal::GeneralisedPlaneStrain);
        }
        let found = of_family(&name).or_else(|| of_line(&name, letters));
        let found =
            found.or_else(|| is_without_shape(&name, letters).then_some((Use::Other, None, 0..=0)));
        let (usage, shape, nodes) = found.ok_or(Refusal::Unknown)?;
        Ok(Self {
            name,
            usage,
            shape,
            nodes,
        })
    }

    /// Indices of the corners among the nodes of an element.
    pub(super) fn corners(&self) -> impl Iterator<Item = usize> + use<> {
        // The middle node of a line is the second one.
        let step = match self.shape {
            Some(Shape::Edge) if *self.nodes.start() == 3 => 2,
            _ => 1,
        };
        let n = self.shape.map_or(0, Shape::corners);
        (0..n).map(move |place| step * place)
    }
}

type Found = (Use, Option<Shape>, RangeInclusive<usize>);

fn of_family(name: &str) -> Option<Found> {
    FAMILIES.iter().find_map(|(beginning, usage)| {
        let rest = name.strip_prefix(beginning)?;
        let end = rest.find(|it: char| !it.is_ascii_digit());
        let (digits, suffix) = rest.split_at(end.unwrap_or(rest.len()));
        let nodes = match (*beginning, digits.parse().ok()?) {
            ("STRI", 65) => 6,
            (_, nodes) => nodes,
        };
        let shape = match usage {
            Use::Solid => solid_shape(nodes),
            _ => planar_shape(nodes),
        }?;
        let range = match (nodes, suffix.starts_with('V')) {
            (27, _) => 21..=27,
            (15, true) => 15..=18,
            _ => nodes..=nodes,
        };
        Some((*usage, Some(shape), range))
    })
}

fn planar_shape(nodes: usize) -> Option<Shape> {
    match nodes {
        3 | 6 => Some(Shape::Triangle),
        4 | 8 | 9 => Some(Shape::Quadrangle),
        _ => None,
    }
}

fn solid_shape(nodes: usize) -> Option<Shape> {
    match nodes {
        4 | 10 => Some(Shape::Tetrahedron),
        5 | 13 => Some(Shape::Pyramid),
        6 | 15 => Some(Shape::Prism),
        8 | 20 | 27 => Some(Shape::Hexahedron),
        _ => None,
    }
}

/// A beam or truss; a beam may have a further node for its orientation.
fn of_line(name: &str, letters: &str) -> Option<Found> {
    let digit = |place: usize| {
        let digit = name.as_bytes().get(place)?.checked_sub(b'0')?;
        Some(usize::from(digit))
    };
    let by_nodes = LINES_BY_NODES.iter().find_map(|it| {
        let nodes = name.starts_with(it).then(|| digit(it.len())).flatten()?;
        Some(nodes..=nodes)
    });
    let nodes = match by_nodes {
        Some(nodes) => nodes,
        None if letters == "FRAME" => 2..=2,
        None if BEAMS.contains(&letters) => match digit(letters.len() + 1)? {
            2 => 3..=4,
            _ => 2..=3,
        },
        None => return None,
    };
    (2..=3)
        .contains(nodes.start())
        .then_some((Use::Lower, Some(Shape::Edge), nodes))
}

/// Whether a type has no shape; user elements (`U1`), substructures (`Z1`) and network elements of CalculiX (`D`) are among these.
fn is_without_shape(name: &str, letters: &str) -> bool {
    let has_number = name.len() > letters.len();
    let is_numbered = has_number && ["U", "VU", "Z"].contains(&letters);
    is_numbered || name == "D" || WITHOUT_SHAPE.iter().any(|it| name.starts_with(it))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_have_their_use_and_shape() {
        let plane = |plane| Use::Plane(Some(plane));
        for (name, usage, shape, nodes) in [
            ("cps4r", plane(Plane::Stress), Shape::Quadrangle, 4..=4),
            ("CPE6MHT", plane(Plane::Strain), Shape::Triangle, 6..=6),
            ("CPS8R", plane(Plane::Stress), Shape::Quadrangle, 8..=8),
            ("DC2D4", Use::Plane(None), Shape::Quadrangle, 4..=4),
            ("C3D8I", Use::Solid, Shape::Hexahedron, 8..=8),
            ("C3D20RI", Use::Solid, Shape::Hexahedron, 20..=20),
            ("C3D27", Use::Solid, Shape::Hexahedron, 21..=27),
            ("C3D15V", Use::Solid, Shape::Prism, 15..=18),
            ("C3D10HS", Use::Solid, Shape::Tetrahedron, 10..=10),
            ("C3D5", Use::Solid, Shape::Pyramid, 5..=5),
            ("SC8R", Use::Solid, Shape::Hexahedron, 8..=8),
            ("S4R5", Use::Shell, Shape::Quadrangle, 4..=4),
            ("STRI65", Use::Shell, Shape::Triangle, 6..=6),
            ("M3D9R", Use::Shell, Shape::Quadrangle, 9..=9),
            ("R3D4", Use::Lower, Shape::Quadrangle, 4..=4),
            ("T3D2", Use::Lower, Shape::Edge, 2..=2),
            ("T2D3", Use::Lower, Shape::Edge, 3..=3),
            ("B31OS", Use::Lower, Shape::Edge, 2..=3),
            ("B32R", Use::Lower, Shape::Edge, 3..=4),
        ] {
            let found = ElementType::new(name).unwrap();
            assert_eq!(
                (found.usage, found.shape, found.nodes),
                (usage, Some(shape), nodes),
                "{name}"
            );
        }
    }

    #[test]
    fn other_types_are_left_out_or_refused() {
        for name in [
            "MASS", "SPRINGA", "CONN3D2", "COH2D4", "GAPUNI", "U1", "DCOUP3D", "D", "Z12", "CINPE4",
        ] {
            let found = ElementType::new(name).unwrap();
            assert_eq!((found.usage, found.shape), (Use::Other, None), "{name}");
        }
        for name in ["CAX4R", "CGAX8", "SAX1", "RAX2", "COHAX4", "DCAX4"] {
            assert_eq!(ElementType::new(name), Err(Refusal::Axisymmetric), "{name}");
        }
        let refusal = Err(Refusal::GeneralisedPlaneStrain);
        assert_eq!(ElementType::new("CPEG4R"), refusal);
        for name in ["", "C3D7", "XYZ", "CPS", "EC3D8R", "U", "B"] {
            assert_eq!(ElementType::new(name), Err(Refusal::Unknown), "{name}");
        }
    }

    #[test]
    fn the_ends_of_a_line_are_its_corners() {
        let corners = |name: &str| {
            ElementType::new(name)
                .unwrap()
                .corners()
                .collect::<Vec<_>>()
        };
        assert_eq!(corners("B31"), [0, 1]);
        assert_eq!(corners("B32"), [0, 2]);
        assert_eq!(corners("T3D3"), [0, 2]);
        assert_eq!(corners("C3D10"), [0, 1, 2, 3]);
    }
}
