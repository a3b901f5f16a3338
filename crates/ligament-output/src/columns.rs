//! Text in aligned columns.

/// Largest width of a column, in characters; longer words exceed it.
pub const MAX_COLUMN_WIDTH: usize = 120;

/// Rows of words as lines of columns, two spaces apart: the first `n_left` columns are left-aligned, the others right-aligned. A row of two
/// words in a wider table is a name with a remark, which widens no column.
pub fn aligned(rows: &[Vec<String>], n_left: usize) -> Vec<String> {
    let n_columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let rows = rows.iter().filter(|row| row.len() > 2 || n_columns == 2);
        let widths = rows.filter_map(|row| Some(row.get(column)?.chars().count()));
        widths.max().unwrap_or(0).min(MAX_COLUMN_WIDTH)
    };
    let widths: Vec<usize> = (0..n_columns).map(width).collect();
    let line = |row: &Vec<String>| {
        let words = row.iter().zip(&widths).enumerate();
        let words = words.map(|(column, (word, &width))| match column < n_left {
            true => format!("{word:<width$}"),
            false => format!("{word:>width$}"),
        });
        words.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_as_wide_as_their_widest_word() {
        let rows = [["run", "step", "s"], ["fine", "1", "-0.25"]];
        let mut rows: Vec<Vec<String>> = rows.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        assert_eq!(
            aligned(&rows, 0),
            [" run  step      s", "fine     1  -0.25"]
        );
        assert_eq!(
            aligned(&rows, 1),
            ["run   step      s", "fine     1  -0.25"]
        );
        assert_eq!(aligned(&rows, 3), ["run   step  s", "fine  1     -0.25"]);
        rows.push(["coarse", "has no results"].map(str::to_owned).to_vec());
        assert_eq!(
            aligned(&rows, 1)[1..],
            ["fine     1  -0.25", "coarse  has no results"]
        );
    }
}
