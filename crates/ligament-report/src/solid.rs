//! A solid in a page: pictures of its outside, of sections and of its crack over the steps, drawn as by `ligament plot`.

use std::collections::BTreeSet;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use ligament_output::results::fields::{Interest, OPENING, ResultField, SLIDING};
use ligament_output::results::outputs::OutputKind;
use ligament_output::results::solid_body::SolidBody;
use ligament_output::results::steps::{StepChoice, StepName};
use ligament_output::vtu::read::VtuFile;
use ligament_output::{Error, FieldLocation};
use ligament_plot::picture::select::Choice as Outputs;
use ligament_plot::picture::{
    CrackDrawing, FieldRequest, Magnification, PictureError, Section, SolidRequest, Target, View,
    pictures_of_each,
};
use miniz_oxide::deflate::compress_to_vec;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::error::ReportError;
use crate::parts::{Budget, Choice, Drawn, Stored, Texts};

/// Compression level: higher ones take several times as long and save a hundredth.
const LEVEL: u8 = 6;

/// Number of series that are drawn between checks of the budget.
const AT_ONCE: usize = 8;

/// Width of a picture, mm, with letters of nine pixels on a screen.
const WIDTH: f64 = 100.0;

/// Number of the most important fields, which are also shown from behind and in sections.
const EVERYWHERE: usize = 2;

/// A view of a solid.
#[derive(Debug, Clone)]
struct SolidView {
    /// Identifier of the view.
    id: &'static str,
    /// Label of the view.
    label: String,
    drawn: SolidRequest,
    crack: Option<CrackDrawing>,
}

/// Pictures of a field in one view over the steps.
#[derive(Debug)]
struct Series<'a> {
    sight: &'a SolidView,
    field: String,
}

/// Contents for a solid: pictures in the order of importance, as far as the budget allows.
///
/// # Errors
///
/// If a file cannot be used.
pub(crate) fn drawn(
    of: &Stored<'_>,
    first: &VtuFile,
    choice: Choice,
    texts: &mut Texts,
) -> Result<Drawn, ReportError> {
    let body = SolidBody::read(first)?;
    let sights = sights(of, &body)?;
    let series = series(&sights, &fields(of, body.location)?);
    let mut budget = Budget::new(choice.letters);
    let mut described = Vec::new();
    for some in series.chunks(AT_ONCE) {
        let pictures: Result<Vec<Vec<String>>, PictureError> =
            some.par_iter().map(|series| series.pictures(of)).collect();
        let mut is_full = true;
        for (series, pictures) in some.iter().zip(pictures?) {
            let letters = pictures.iter().map(String::len).sum();
            let name = format!("{} ({})", series.field, series.sight.label);
            if pictures.is_empty() {
                is_full = false;
            } else if budget.takes(&name, letters) {
                is_full = false;
                let numbers = pictures.into_iter().map(|it| texts.push(it));
                described.push(json!({
                    "view": series.sight.id,
                    "field": series.field,
                    "texts": numbers.collect::<Vec<usize>>(),
                }));
            }
        }
        if is_full {
            break;
        }
    }
    let views = sights
        .iter()
        .map(|it| json!({"id": it.id, "label": it.label}));
    Ok(Drawn {
        parts: json!({
            "body": Value::Null,
            "fields": [],
            "bonds": Value::Null,
            "cracks": Value::Null,
            "precracks": [],
            "pictures": { "views": views.collect::<Vec<Value>>(), "series": described },
        }),
        points: body.grid.positions.len(),
        left_out: budget.left_out,
    })
}

/// The views: the outside from two sides, sections through the middle across the axes, and the crack where bonds broke.
fn sights(of: &Stored<'_>, body: &SolidBody) -> Result<Vec<SolidView>, Error> {
    let may_crack = of.kind == OutputKind::Steps && of.folder.join("breaks.csv").is_file();
    let outside = |id, label: &str, view| SolidView {
        id,
        label: label.to_owned(),
        drawn: SolidRequest {
            view: Some(view),
            ..SolidRequest::default()
        },
        crack: may_crack.then_some(CrackDrawing::Bonds),
    };
    let behind = View {
        azimuth: View::OBLIQUE.azimuth + 180.0,
        ..View::OBLIQUE
    };
    let mut sights = vec![
        outside(
            "outside",
            "outside, from the front and the right",
            View::OBLIQUE,
        ),
        outside("behind", "outside, from behind and the left", behind),
    ];
    for (axis, id) in ["section-x", "section-y", "section-z"]
        .into_iter()
        .enumerate()
    {
        let along = || body.grid.positions.iter().map(|it| it[axis]);
        let (low, high) = (
            along().fold(f64::INFINITY, f64::min),
            along().fold(f64::NEG_INFINITY, f64::max),
        );
        let middle = 0.5 * (low + high);
        let mut section = Section {
            point: [0.0; 3],
            normal: [0.0; 3],
        };
        (section.point[axis], section.normal[axis]) = (middle, 1.0);
        let name = ["x", "y", "z"][axis];
        sights.push(SolidView {
            id,
            label: format!("section {name} = {} mm", rounded(1e3 * middle)),
            drawn: SolidRequest {
                section: Some(section),
                ..SolidRequest::default()
            },
            crack: None,
        });
    }
    if may_crack {
        sights.push(SolidView {
            id: "crack",
            label: "crack surface".to_owned(),
            drawn: SolidRequest::default(),
            crack: Some(CrackDrawing::Lines),
        });
    }
    Ok(sights)
}

/// Rank of a field among those with pictures.
fn rank(name: &str) -> Option<u8> {
    match ResultField::named(name)?.interest {
        Interest::Pictured(rank) => Some(rank),
        Interest::Main(_) | Interest::Low => None,
    }
}

/// A coordinate in mm, rounded to three decimals.
fn rounded(mm: f64) -> f64 {
    let rounded = (1e3 * mm).round() / 1e3;
    // Adding zero removes the sign of -0.
    rounded + 0.0
}

/// Names of the fields for pictures, and separately of vectors' components, without fields that are zero everywhere.
fn fields(of: &Stored<'_>, location: FieldLocation) -> Result<[Vec<String>; 2], Error> {
    let mut found = BTreeSet::new();
    let mut names: [Vec<String>; 2] = Default::default();
    for path in of.files.values() {
        let file = VtuFile::open(path)?;
        for (place, name) in file.fields(location).enumerate() {
            let Some(rank) = rank(name) else {
                continue;
            };
            let is_zero = |it: &f64| rank > 0 && (*it == 0.0 || !it.is_finite());
            if !file.required_numbers(location, name)?.iter().all(is_zero) {
                found.insert((rank, place, name.to_owned()));
            }
        }
    }
    let Some(file) = of.files.values().next() else {
        return Ok(names);
    };
    let file = VtuFile::open(file)?;
    for (.., name) in found {
        match file.components(location, &name) {
            Some((3, [])) => {
                names[1].extend(["x", "y", "z"].map(|it| format!("{name}.{it}")));
                names[0].push(name);
            }
            Some((_, parts)) if !parts.is_empty() => {
                names[0].extend(parts.iter().map(|it| format!("{name}.{it}")));
            }
            _ => names[0].push(name),
        }
    }
    Ok(names)
}

/// The series of a page in the order of importance.
fn series<'a>(sights: &'a [SolidView], [fields, components]: &[Vec<String>; 2]) -> Vec<Series<'a>> {
    let of = |id: &str, fields: &[String]| {
        let sights = sights.iter().filter(|it| it.id.starts_with(id));
        let series = sights.flat_map(|sight| fields.iter().map(move |field| (sight, field)));
        let series = series.map(|(sight, field)| Series {
            sight,
            field: field.clone(),
        });
        series.collect::<Vec<Series<'a>>>()
    };
    let mut all = of("outside", fields);
    all.extend(of(
        "crack",
        &[&OPENING, &SLIDING].map(|it| it.name.to_owned()),
    ));
    let few = &fields[..fields.len().min(EVERYWHERE)];
    all.extend(of("section", few));
    all.extend(of("behind", few));
    all.extend(of("outside", components));
    all
}

impl Series<'_> {
    /// The pictures of the steps as texts of a page; empty without values.
    fn pictures(&self, of: &Stored<'_>) -> Result<Vec<String>, PictureError> {
        let number = |it: &usize| StepChoice::One(StepName::Number(*it));
        let drawn = pictures_of_each(&FieldRequest {
            folders: vec![of.folder.to_path_buf()],
            labels: Vec::new(),
            field: Some(self.field.clone()),
            choice: Outputs::Steps(of.files.keys().map(number).collect()),
            magnification: Magnification::Auto,
            crack: self.sight.crack,
            lines: Vec::new(),
            window: None,
            bands: None,
            range: None,
            map: None,
            columns: None,
            solid: self.sight.drawn,
            target: Target {
                out: None,
                force: false,
                format: None,
                width: Some(WIDTH),
                dpi: None,
            },
        });
        let packed = |(_, svg): (usize, String)| {
            BASE64_STANDARD.encode(compress_to_vec(svg.as_bytes(), LEVEL))
        };
        match drawn {
            // No crack opened in any of the steps.
            Err(PictureError::NoValues(_)) => Ok(Vec::new()),
            drawn => Ok(drawn?.into_iter().map(packed).collect()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_readers_want_first_is_drawn_first() {
        let sight = |id| SolidView {
            id,
            label: id.to_owned(),
            drawn: SolidRequest::default(),
            crack: None,
        };
        let sights = ["outside", "behind", "section-x", "section-y", "crack"].map(sight);
        let fields = ["displacement", "damage", "stress.xx"].map(str::to_owned);
        let all = series(
            &sights,
            &[fields.to_vec(), vec!["displacement.x".to_owned()]],
        );
        let names: Vec<(&str, &str)> = all.iter().map(|it| (it.sight.id, &*it.field)).collect();
        assert_eq!(
            names[..4],
            [
                ("outside", "displacement"),
                ("outside", "damage"),
                ("outside", "stress.xx"),
                ("crack", "opening")
            ]
        );
        assert_eq!(
            names[5..7],
            [("section-x", "displacement"), ("section-x", "damage")]
        );
        assert_eq!((names[9], names.len()), (("behind", "displacement"), 12));
        assert_eq!(
            (rounded(-1e-9).to_string(), rounded(12.5).to_string()),
            ("0".to_owned(), "12.5".to_owned())
        );
    }
}
