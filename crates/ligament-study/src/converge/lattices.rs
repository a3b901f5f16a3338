//! Lattices of a case at the sizes h and 2h, and a little finer at each size.

use ligament_case::case::{CaseError, CaseFile};

use super::bodies::{SizedBodies, SizedBody};
use super::interval::FLOOR;

/// Share of its spacing to which the second lattice of a size is best refined.
const FINER: f64 = 0.94;

/// Smallest such share: finer lattices would be another size.
const FINEST: f64 = 0.85;

/// The lattice of a case with half of its cells and with all of them, each also with a few cells more, as many as keep the shape of the cells
/// and the size of the body.
pub(super) fn lattices(case: &CaseFile) -> Result<SizedBodies, CaseError> {
    let (section, cells, spacing) = match (&case.case.lattice, &case.case.solid_lattice) {
        (Some(it), _) => ("lattice", it.cells.to_vec(), it.spacing.0.to_vec()),
        (None, Some(it)) => ("solid_lattice", it.cells.to_vec(), it.spacing.to_vec()),
        (None, None) => return Err(case.error("mesh", "the case has no body")),
    };
    let key = format!("{section}.cells");
    if let Some(odd) = cells.iter().find(|it| *it % 2 == 1) {
        let reason = format!(
            "the lattice of twice the spacing has half of the cells: give even numbers, not {odd}"
        );
        return Err(case.error(&key, reason));
    }
    let sides: Vec<f64> = cells
        .iter()
        .zip(&spacing)
        .map(|(&n, dx)| f64::from(n) * dx)
        .collect();
    let sized = |cells: &[u32], label: String, mesher, is_fine| {
        let spacing = cells
            .iter()
            .zip(&sides)
            .map(|(&n, side)| side / f64::from(n));
        let values = [
            toml_list(cells.iter().map(|n| n.to_string())),
            toml_list(spacing.map(|dx| format!("{dx:?}"))),
        ];
        let keys = ["cells", "spacing"].map(|name| format!("{section}.{name}"));
        SizedBody {
            label,
            mesher,
            is_fine,
            settings: keys.into_iter().zip(values).collect(),
        }
    };
    let coarse: Vec<u32> = cells.iter().map(|n| n / 2).collect();
    let mut bodies = Vec::new();
    let mut notes = Vec::new();
    for (size, cells, is_fine) in [("h", &cells, true), ("2h", &coarse, false)] {
        bodies.push(sized(cells, format!("{size} lattice"), "lattice", is_fine));
        match finer_cells(cells) {
            Some(more) => bodies.push(sized(&more, format!("{size} finer"), "finer", is_fine)),
            None => notes.push(format!(
                "no second lattice at {size}: numbers of cells with a larger common divisor have one, and then the scatter is known"
            )),
        }
    }
    Ok(SizedBodies {
        bodies,
        floor: FLOOR,
        origin: "the lattice of the case is h, half of its cells are 2h; a second lattice of each size is a little finer".to_owned(),
        notes,
    })
}

/// Numbers of cells in the same ratio and with the same parity, so that a crack between two rows stays there: so many more that the spacing is
/// nearest to [`FINER`] of its own. None if none is between [`FINEST`] and 1.
fn finer_cells(cells: &[u32]) -> Option<Vec<u32>> {
    let divisor = cells.iter().fold(0, |a, &b| greatest_common_divisor(a, b));
    let of_multiple =
        |multiple: u32| -> Vec<u32> { cells.iter().map(|n| n / divisor * multiple).collect() };
    let keeps_parity = |multiple: &u32| {
        of_multiple(*multiple)
            .iter()
            .zip(cells)
            .all(|(more, n)| more % 2 == n % 2)
    };
    let off = |multiple: &u32| (f64::from(divisor) / f64::from(*multiple) - FINER).abs();
    let most = (f64::from(divisor) / FINEST) as u32;
    let multiples = (divisor + 1..=most).filter(keeps_parity);
    let best = multiples.min_by(|a, b| off(a).total_cmp(&off(b)))?;
    Some(of_multiple(best))
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}

/// A list in TOML.
fn toml_list(items: impl Iterator<Item = String>) -> String {
    format!("[{}]", items.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_finer_lattice_keeps_the_shape_of_the_cells() {
        assert_eq!(finer_cells(&[80, 40]), Some(vec![84, 42]));
        assert_eq!(finer_cells(&[41, 41]), Some(vec![43, 43]));
        // 15 to 4: the next lattice with such cells has twice as many.
        assert_eq!(finer_cells(&[15, 4]), None);
    }
}
