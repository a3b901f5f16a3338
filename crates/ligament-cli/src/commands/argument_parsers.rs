//! Parsers of numbers and output paths on the command line.

use std::path::{Path, PathBuf};

use clap::builder::{PathBufValueParser, TypedValueParser};

/// A finite number.
pub(super) fn number(text: &str) -> Option<f64> {
    let number = text.trim().parse::<f64>().ok();
    number.filter(|it| it.is_finite())
}

/// A finite number greater than 0.
pub(super) fn positive_number(text: &str) -> Option<f64> {
    number(text).filter(|it| *it > 0.0)
}

/// COUNT finite numbers between commas.
pub(super) fn numbers<const COUNT: usize>(text: &str) -> Option<[f64; COUNT]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    numbers?.try_into().ok()
}

/// A position in the plane, m.
pub(super) fn position(text: &str) -> Result<[f64; 2], String> {
    let solid = match numbers::<3>(text) {
        Some(_) => "; lines through solids are not sampled yet",
        None => "",
    };
    numbers(text).ok_or_else(|| format!("expected X,Y in m, such as 0.01,-0.02{solid}"))
}

/// Path that stands for standard output, as in many programs.
const STANDARD_OUTPUT: &str = "-";

/// Parser of the path of a file to write.
pub(super) fn output_file() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => PathBuf::from("/dev/stdout"),
        false => path,
    })
}

/// Parser of the path of a folder to write.
pub fn output_folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(|path| match path == Path::new(STANDARD_OUTPUT) {
        true => Err("the results are a folder, which standard output cannot take: name one"),
        false => Ok(path),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_two_numbers() {
        assert_eq!(position("-0.01, 2e-3"), Ok([-0.01, 2e-3]));
        assert_eq!(position("1e-2, -0.5"), Ok([0.01, -0.5]));
        for wrong in ["0.1", "0.01,", "1,2,3", "0.1,nan"] {
            assert!(
                position(wrong).is_err_and(|error| error.contains("X,Y")),
                "{wrong}"
            );
        }
    }
}
