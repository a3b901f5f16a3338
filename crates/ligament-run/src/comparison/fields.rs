//! Comparison of field files, value by value.

use std::path::Path;

use ligament_output::FieldLocation;
use ligament_output::vtu::read::VtuFile;

use super::values::apart;

/// Names of the components of a vector.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Description of the first difference of two field files; `None` if it is not in a field.
pub(super) fn difference(then: &Path, now: &Path) -> Option<String> {
    let (then, now) = (VtuFile::open(then).ok()?, VtuFile::open(now).ok()?);
    let locations = [FieldLocation::Point, FieldLocation::Cell];
    locations
        .into_iter()
        .find_map(|location| difference_at(&then, &now, location))
}

/// Description of the first difference in the fields on points or cells.
fn difference_at(then: &VtuFile, now: &VtuFile, location: FieldLocation) -> Option<String> {
    let [fields, others] = [then, now].map(|file| file.fields(location).collect::<Vec<_>>());
    if fields != others {
        return Some(format!("its fields on {location}s differ"));
    }
    fields.into_iter().find_map(|field| {
        let numbers = |file: &VtuFile| file.numbers(location, field).ok().flatten();
        let (then_numbers, now_numbers) = (numbers(then)?, numbers(now)?);
        if then_numbers.len() != now_numbers.len() {
            return Some(format!("field {field} has another length"));
        }
        let mut pairs = then_numbers.iter().zip(&now_numbers);
        let index = pairs.position(|(a, b)| a.to_bits() != b.to_bits())?;
        let (n_components, names) = then.components(location, field)?;
        let (place, component) = (index / n_components, index % n_components);
        let owner = match then.tags(location) {
            Ok((tagged, tags)) => format!("{tagged} {}", tags.get(place)?),
            Err(_) => format!("{location} {place}, counted from 0"),
        };
        let component = match names.get(component).map(String::as_str) {
            Some(name) => format!(" {name}"),
            None if n_components > 1 => format!(" {}", AXES.get(component).unwrap_or(&"beyond z")),
            None => String::new(),
        };
        let values = [then_numbers[index], now_numbers[index]].map(|value| format!("{value:?}"));
        let apart = apart(&values[0], &values[1]);
        Some(format!("field {field}{component} at {owner}: {apart}"))
    })
}
