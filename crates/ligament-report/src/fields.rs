//! Fields of a run over the steps of the page.

use std::collections::BTreeMap;
use std::path::PathBuf;

use ligament_model::parallel;
use ligament_output::Error;
use ligament_output::results::StoredState;
use ligament_output::results::fields::{Components, Interest, ResultField, unit_of};
use ligament_output::vtu::read::{TAG_NOUNS, VtuFile};

use crate::body::{Body, ordered};
use crate::columns::{Column, Digits, Encoder};

/// Share of the points whose value is at most the usual one.
const USUAL: f64 = 0.98;

/// A field of all steps.
#[derive(Debug)]
pub(crate) struct Field {
    /// Name in the files.
    pub(crate) name: String,
    /// SI unit, or `-`.
    pub(crate) unit: &'static str,
    /// Names of the components; empty for a scalar.
    pub(crate) components: Vec<String>,
    /// One column per component.
    pub(crate) columns: Vec<Column>,
    /// Smallest and largest value of each component over the steps.
    pub(crate) ranges: Vec<[f64; 2]>,
    /// Largest size over the steps: for a vector its length, otherwise the largest component.
    pub(crate) magnitude: f64,
    /// Largest size over the steps exceeded by few points only, so that a detached part does not count.
    pub(crate) usual: f64,
}

impl Field {
    /// Whether the field is of main interest.
    pub(crate) fn is_main(&self) -> bool {
        self.interest() != Interest::Low
    }

    fn interest(&self) -> Interest {
        ResultField::named(&self.name).map_or(Interest::Low, |it| it.interest)
    }

    /// Number of characters in a page.
    pub(crate) fn n_characters(&self) -> usize {
        self.columns.iter().map(Column::n_characters).sum()
    }
}

/// A field of which not all steps are read yet.
struct IncompleteField {
    name: String,
    /// Number of values per point in the files.
    stride: usize,
    /// Whether the values are vectors along the axes.
    is_vector: bool,
    components: Vec<String>,
    encoders: Vec<Encoder>,
    ranges: Vec<[f64; 2]>,
    magnitude: f64,
    usual: f64,
}

/// Reads the fields of the outputs, the most important ones first; `digits` is the number of digits of the largest value of each step.
///
/// # Errors
///
/// If a file cannot be used, or has other points than the first one.
pub(crate) fn read(
    files: &BTreeMap<StoredState, PathBuf>,
    body: &Body,
    digits: u32,
) -> Result<Vec<Field>, Error> {
    let mut growing: Vec<IncompleteField> = Vec::new();
    for path in files.values() {
        let file = VtuFile::open(path)?;
        if growing.is_empty() {
            growing = begin(&file, body, digits);
        }
        let appended = parallel::map(&mut growing, |it| it.append(&file, body));
        appended.into_iter().collect::<Result<(), _>>()?;
    }
    let mut fields: Vec<Field> = growing.into_iter().map(IncompleteField::finish).collect();
    fields.sort_by_key(|it| it.interest().rank());
    Ok(fields)
}

fn begin(file: &VtuFile, body: &Body, digits: u32) -> Vec<IncompleteField> {
    let location = body.location;
    let names = file.fields(location).filter(|it| !TAG_NOUNS.contains(it));
    let field = |name: &str| {
        let (stride, names) = file.components(location, name).unwrap_or((1, &[]));
        let components: Vec<String> = match (stride, names) {
            (1, _) => Vec::new(),
            // The third component of a vector in the plane is zero.
            (3, []) => ["x", "y", "z"][..body.dimension]
                .iter()
                .map(|it| (*it).to_owned())
                .collect(),
            (_, []) => (0..stride).map(|it| it.to_string()).collect(),
            // So are the last two of a symmetric tensor.
            (6, names) if body.dimension == 2 => names[..4].to_vec(),
            _ => names.to_vec(),
        };
        let known = ResultField::named(name);
        let in_space = body.dimension == 3;
        let digits = match known.map(|it| it.components(in_space)) {
            Some(Components::Integer) => Digits::Whole,
            _ => Digits::OfLargest(digits),
        };
        let count = components.len().max(1);
        IncompleteField {
            name: name.to_owned(),
            stride,
            is_vector: stride == 3 && names.is_empty(),
            encoders: (0..count).map(|_| Encoder::new(digits)).collect(),
            ranges: vec![[f64::INFINITY, f64::NEG_INFINITY]; count],
            components,
            magnitude: 0.0,
            usual: 0.0,
        }
    };
    names.map(field).collect()
}

impl IncompleteField {
    fn append(&mut self, file: &VtuFile, body: &Body) -> Result<(), Error> {
        let all = file.required_numbers(body.location, &self.name)?;
        if all.len() != self.stride * body.order.len() {
            return Err(Error::Unreadable {
                path: file.path().to_path_buf(),
                reason: format!("{} is not of the points of the first output", self.name),
            });
        }
        let mut sizes = self.sizes(&all);
        if let Some(last) = sizes.len().checked_sub(1) {
            let place = (USUAL * last as f64) as usize;
            let usual = *sizes.select_nth_unstable_by(place, f64::total_cmp).1;
            self.usual = self.usual.max(usual);
            self.magnitude = sizes.into_iter().fold(self.magnitude, f64::max);
        }
        for (place, encoder) in self.encoders.iter_mut().enumerate() {
            let component: Vec<f64> = all
                .iter()
                .skip(place)
                .step_by(self.stride)
                .copied()
                .collect();
            let finite = component.iter().filter(|it| it.is_finite());
            let range = &mut self.ranges[place];
            *range = finite.fold(*range, |[low, high], &it| [low.min(it), high.max(it)]);
            encoder.append(&ordered(&component, &body.order));
        }
        Ok(())
    }

    /// Finite sizes of the values of the points.
    fn sizes(&self, all: &[f64]) -> Vec<f64> {
        let size = |point: &[f64]| match self.is_vector {
            true => point[0].hypot(point[1]).hypot(point[2]),
            false => point.iter().fold(0.0_f64, |size, it| size.max(it.abs())),
        };
        let sizes = all.chunks_exact(self.stride).map(size);
        sizes.filter(|it| it.is_finite()).collect()
    }

    fn finish(self) -> Field {
        Field {
            unit: unit_of(&self.name),
            columns: self.encoders.into_iter().map(Encoder::finish).collect(),
            name: self.name,
            components: self.components,
            ranges: self.ranges,
            magnitude: self.magnitude,
            usual: self.usual,
        }
    }
}
