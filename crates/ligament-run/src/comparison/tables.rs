//! Comparison of tables, cell by cell.

use ligament_output::csv::read::records;

use super::values::apart;

/// Description of the first difference of two tables; `None` if it is not in a cell.
pub(super) fn difference(then: &[u8], now: &[u8]) -> Option<String> {
    let [then, now] = [then, now].map(|bytes| records(&String::from_utf8_lossy(bytes)));
    let (header, others) = (then.first()?, now.first()?);
    if header != others {
        return Some("its columns differ".to_owned());
    }
    let mut pairs = then.iter().zip(&now).enumerate();
    let Some((line, (one, other))) = pairs.find(|(_, (one, other))| one != other) else {
        let [then, now] = [then, now].map(|table| table.len() - 1);
        return (then != now).then(|| format!("{then} rows then, {now} now"));
    };
    let mut columns = header.iter().zip(one.iter().zip(other));
    let (column, (value, another)) = columns.find(|(_, (value, another))| value != another)?;
    Some(format!(
        "line {} ({} {}), column {column}: {}",
        line + 1,
        &header[0],
        &one[0],
        apart(value, another)
    ))
}
