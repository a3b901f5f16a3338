//! A field of an output by its name, with one number per point or cell.

use ligament_output::FieldLocation;
use ligament_output::results::fields::{ResultField, unit_of};
use ligament_output::vtu::read::VtuFile;

use super::PictureError;
use ligament::suggestion::nearest;

/// Name of a field for a picture without a field.
pub(super) const NONE: &str = "none";

/// Name of the norm of a vector among its components.
const NORM: &str = "magnitude";

/// Quantile of a mode's field that is drawn as its largest value, because values at the corners of a clamp are far above the rest.
const MODE_QUANTILE: f64 = 0.995;

/// A field to be drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Field {
    /// Name of the field with its component.
    pub(super) name: String,
    /// SI unit, `-` without one.
    pub(super) unit: &'static str,
    /// Whether the values belong to points or cells.
    pub(super) location: FieldLocation,
    /// The values, shape (n_points) or (n_cells).
    pub(super) values: Vec<f64>,
}

impl Field {
    /// Reads a field: `damage`, `displacement` (its norm), `displacement.x`, `stress_virial.xx`. On a lattice, where fields belong
    /// to the cells, fields of the cells take precedence.
    pub(super) fn read(file: &VtuFile, name: &str) -> Result<Self, PictureError> {
        let whole = |name: &str| {
            let has = |location: &FieldLocation| file.components(*location, name).is_some();
            [FieldLocation::Cell, FieldLocation::Point]
                .into_iter()
                .find(has)
        };
        let (base, part) = match (whole(name), name.rsplit_once('.')) {
            (None, Some((base, part))) => (base, Some(part)),
            _ => (name, None),
        };
        let location = whole(base).ok_or_else(|| unknown(file, name))?;
        let (count, names) = file.components(location, base).unwrap_or((1, &[]));
        let all = file.required_numbers(location, base)?;
        let values = match (part, count) {
            (None, 1) => all,
            (None | Some(NORM), 3) if names.is_empty() => all
                .chunks_exact(3)
                .map(|v| v[0].hypot(v[1]).hypot(v[2]))
                .collect(),
            (part, _) => {
                let known = component_names(file, location, base);
                let place = part.and_then(|part| known.iter().position(|it| it == part));
                let place = place.ok_or_else(|| PictureError::NoComponent {
                    field: base.to_owned(),
                    choices: known.iter().map(|it| format!("{base}.{it}")).collect(),
                })?;
                all.chunks_exact(count).map(|v| v[place]).collect()
            }
        };
        Ok(Self {
            name: name.to_owned(),
            unit: unit_of(base),
            location,
            values,
        })
    }

    /// Least and largest finite value; None where there is none.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        let finite = self.values.iter().copied().filter(|it| it.is_finite());
        finite.fold(None, |range, value| {
            let [low, high] = range.unwrap_or([value, value]);
            Some([low.min(value), high.max(value)])
        })
    }
}

/// Names of the components of a field that can be drawn: also the norm of a vector.
fn component_names(file: &VtuFile, location: FieldLocation, field: &str) -> Vec<String> {
    let mut names = file.component_names(location, field);
    if matches!(file.components(location, field), Some((3, []))) {
        names.push(NORM.to_owned());
    }
    names
}

fn unknown(file: &VtuFile, name: &str) -> PictureError {
    let mut known: Vec<String> = Vec::new();
    for location in [FieldLocation::Point, FieldLocation::Cell] {
        for field in file.fields(location) {
            let mut drawable = component_names(file, location, field)
                .iter()
                .map(|part| format!("{field}.{part}"))
                .collect::<Vec<_>>();
            if drawable.is_empty() {
                drawable.push(field.to_owned());
            }
            drawable.retain(|name| !known.contains(name));
            known.extend(drawable);
        }
    }
    let base = name.split('.').next().and_then(ResultField::named);
    let requested_by = base.and_then(ResultField::requested_by);
    let suggestion = nearest(name, &known).filter(|_| requested_by.is_none());
    PictureError::UnknownField {
        suggestion: suggestion.map(str::to_owned),
        requested_by,
        name: name.to_owned(),
        known,
    }
}

/// Scales the values so that the quantile of their absolute values becomes 1: the amplitude of a mode is arbitrary.
pub(super) fn normalise_by_quantile(field: &mut Field) {
    let mut sizes: Vec<f64> = field
        .values
        .iter()
        .map(|it| it.abs())
        .filter(|it| it.is_finite())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let place = (MODE_QUANTILE * sizes.len().saturating_sub(1) as f64).round() as usize;
    let largest = sizes
        .get(place)
        .copied()
        .filter(|it| *it > 0.0)
        .unwrap_or(1.0);
    for value in &mut field.values {
        *value /= largest;
    }
    field.unit = "-";
}

#[cfg(test)]
mod tests {
    use ligament_output::vtu::{self, Cell, Cells, UnstructuredGrid, write_vtu};

    use super::*;

    fn sample(folder: &std::path::Path) -> VtuFile {
        let path = folder.join("a.vtu");
        let grid = UnstructuredGrid {
            points: &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            cells: Cells::Mixed(&[Cell::Triangle([0, 1, 2])]),
            point_fields: &[
                vtu::Field::scalar("damage", &[0.0, 0.5, f64::NAN]),
                vtu::Field::integer("fragment", &[1, 2, -3]),
                vtu::Field::vector(
                    "displacement",
                    &[[3.0, 4.0, 0.0], [0.0, -1.0, 0.0], [0.0; 3]],
                ),
                vtu::Field::components(
                    "stress_virial",
                    &["xx", "yy"],
                    &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
                ),
            ],
            cell_fields: &[vtu::Field::scalar("damage", &[0.25])],
            field_data: &[],
        };
        write_vtu(&path, &grid).unwrap();
        VtuFile::open(path).unwrap()
    }

    #[test]
    fn fields_are_scalars_norms_or_components() {
        let folder = tempfile::tempdir().unwrap();
        let file = sample(folder.path());
        let values = |name: &str| Field::read(&file, name).unwrap().values;
        assert_eq!(values("displacement"), [5.0, 1.0, 0.0]);
        assert_eq!(values("displacement.magnitude"), [5.0, 1.0, 0.0]);
        assert_eq!(values("displacement.y"), [4.0, -1.0, 0.0]);
        assert_eq!(values("stress_virial.yy"), [2.0, 4.0, 6.0]);
        assert_eq!(values("fragment"), [1.0, 2.0, -3.0]);
        let damage = Field::read(&file, "damage").unwrap();
        assert_eq!(
            (damage.location, damage.values),
            (FieldLocation::Cell, vec![0.25])
        );
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is() {
        let folder = tempfile::tempdir().unwrap();
        let file = sample(folder.path());
        let error = |name: &str| Field::read(&file, name).unwrap_err().to_string();
        assert!(error("damge").contains("did you mean `damage`?"));
        assert!(error("quux").contains("stress_virial.xx, stress_virial.yy"));
        assert!(error("stress_virial").contains("stress_virial.xx"));
        let request =
            "; write stress = [\"material\"] under [output] in the case and run it anew; there are";
        assert!(
            error("stress.xx").contains(request) && error("stress_von_mises").contains(request)
        );
        assert!(error("displacement.q").contains("displacement.magnitude"));
    }
}
