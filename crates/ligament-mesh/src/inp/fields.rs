//! Fields of a line: text, integers and numbers between commas.

/// Largest number of a node or an element.
const LARGEST_LABEL: i64 = 999_999_999;

/// The fields of a line, without blanks around them. A comma between quotation marks does not end a field.
#[derive(Debug, Clone)]
pub(super) struct Fields<'a> {
    rest: Option<&'a [u8]>,
}

impl<'a> Fields<'a> {
    pub(super) fn new(line: &'a [u8]) -> Self {
        Self { rest: Some(line) }
    }
}

impl<'a> Iterator for Fields<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest?;
        let mut is_quoted = false;
        let comma = rest.iter().position(|byte| {
            is_quoted ^= *byte == b'"';
            *byte == b',' && !is_quoted
        });
        let field = match comma {
            Some(comma) => {
                self.rest = Some(&rest[comma + 1..]);
                &rest[..comma]
            }
            None => {
                self.rest = None;
                rest
            }
        };
        Some(field.trim_ascii())
    }
}

/// Value of a field with an integer, which may be written as `3.`.
pub(super) fn integer(field: &[u8]) -> Option<i64> {
    let digits = field.strip_prefix(b"-").unwrap_or(field);
    if !digits.is_empty() && digits.len() <= 18 && digits.iter().all(u8::is_ascii_digit) {
        let value = digits
            .iter()
            .fold(0, |sum, digit| 10 * sum + i64::from(digit - b'0'));
        return Some(if digits.len() < field.len() {
            -value
        } else {
            value
        });
    }
    let value = real(field)?;
    (value.fract() == 0.0 && value.abs() < 1e15).then_some(value as i64)
}

/// Number of a node or an element.
pub(super) fn label(field: &[u8]) -> Option<u32> {
    as_label(integer(field)?)
}

/// An integer as the number of a node or an element.
pub(super) fn as_label(value: i64) -> Option<u32> {
    let is_label = (1..=LARGEST_LABEL).contains(&value);
    is_label.then_some(value as u32)
}

/// Value of a field with a finite number, also with an exponent as Fortran writes it: `1.5D-3`, `1.5-103`.
pub(super) fn real(field: &[u8]) -> Option<f64> {
    let is_part = |byte: &u8| byte.is_ascii_digit() || b"+-.eEdD".contains(byte);
    if !field.iter().all(is_part) {
        return None;
    }
    let text = std::str::from_utf8(field).ok()?;
    let value: f64 = match text.parse() {
        Ok(value) => value,
        Err(_) => with_exponent(text).parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// A number with the letter E before its exponent.
fn with_exponent(text: &str) -> String {
    let text = text.replace(['d', 'D'], "E");
    match text.get(1..).and_then(|rest| rest.rfind(['+', '-'])) {
        Some(sign) if !text.contains(['e', 'E']) => {
            format!("{}E{}", &text[..=sign], &text[sign + 1..])
        }
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_fortran_writes_them() {
        for (text, expected) in [
            ("1", Some(1.0)),
            ("-.5", Some(-0.5)),
            ("+2.", Some(2.0)),
            ("2.5D-1", Some(0.25)),
            ("1d3", Some(1e3)),
            ("0.25-101", Some(0.25e-101)),
            ("-1.5+3", Some(-1500.0)),
            ("1e400", None),
            ("nan", None),
            ("1.2.3", None),
            ("", None),
            ("-", None),
        ] {
            assert_eq!(real(text.as_bytes()), expected, "{text}");
        }
    }

    #[test]
    fn labels_are_integers_of_nine_digits() {
        assert_eq!(label(b"999999999"), Some(999_999_999));
        assert_eq!(label(b"12.0"), Some(12));
        for text in ["0", "-3", "1000000000", "1.5", "x", ""] {
            assert_eq!(label(text.as_bytes()), None, "{text}");
        }
        assert_eq!(integer(b"-12"), Some(-12));
    }

    #[test]
    fn quoted_commas_do_not_end_a_field() {
        let fields: Vec<_> = Fields::new(b" 1 ,\"a, b\",, c ,").collect();
        let expected: [&[u8]; 5] = [b"1", b"\"a, b\"", b"", b"c", b""];
        assert_eq!(fields, expected);
    }
}
