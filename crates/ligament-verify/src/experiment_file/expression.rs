//! Expressions of an experiment: numbers, names, + - * / ^, parentheses, and functions of numbers, of the runs that an entry joins, and of the
//! history of a run.
//!
//! A name has letters, digits, `_` and `.`; a function is a name with expressions in parentheses. The expressions of a statistic are
//! evaluated in every run, the last expression of a function of the history in every row.

use std::ops::Range;

use anyhow::{Context, bail, ensure};
use ligament_study::line_fit::LineFit;

use crate::fast_crack::rayleigh;
use crate::record::Record;

/// An expression of the results of runs.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Expression {
    Number(f64),
    Name(String),
    Negative(Box<Self>),
    Both(Operator, Box<[Self; 2]>),
    Call(&'static Function, Vec<Self>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Power,
}

/// A function of expressions.
#[derive(Debug)]
pub(super) struct Function {
    name: &'static str,
    /// Number of expressions; 0 for one or more.
    n_values: usize,
    of: Evaluation,
}

#[derive(Debug)]
enum Evaluation {
    /// A function of numbers.
    Numbers(fn(&[f64]) -> f64),
    /// A function of pairs of values, one for each run; a single value is the second of its pair.
    Runs(fn(&[[f64; 2]]) -> anyhow::Result<f64>),
    /// A function of the last value in all rows of a run, and of the values before it.
    Rows(fn(&Record, &[f64]) -> anyhow::Result<f64>),
}

use Evaluation::{Numbers, Rows, Runs};

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

const fn function(name: &'static str, n_values: usize, of: Evaluation) -> Function {
    Function { name, n_values, of }
}

static FUNCTIONS: [Function; 32] = [
    function("sqrt", 1, Numbers(|x| x[0].sqrt())),
    function("cbrt", 1, Numbers(|x| x[0].cbrt())),
    function("abs", 1, Numbers(|x| x[0].abs())),
    function("ln", 1, Numbers(|x| x[0].ln())),
    function("sin", 1, Numbers(|x| x[0].sin())),
    function("cos", 1, Numbers(|x| x[0].cos())),
    function("tan", 1, Numbers(|x| x[0].tan())),
    function("asin", 1, Numbers(|x| x[0].asin())),
    function("atan", 1, Numbers(|x| x[0].atan())),
    function("hypot", 2, Numbers(|x| x[0].hypot(x[1]))),
    // Speed of Rayleigh waves over the speed of shear waves, for Poisson's ratio in plane strain.
    function("rayleigh", 1, Numbers(|x| rayleigh(x[0]))),
    // The largest and the smallest of all values of all runs.
    function(
        "max",
        0,
        Runs(|all| Ok(last_values(all).fold(f64::NEG_INFINITY, f64::max))),
    ),
    function(
        "min",
        0,
        Runs(|all| Ok(last_values(all).fold(f64::INFINITY, f64::min))),
    ),
    function("sum", 1, Runs(|all| Ok(last_values(all).sum()))),
    function(
        "mean",
        1,
        Runs(|all| Ok(last_values(all).sum::<f64>() / all.len() as f64)),
    ),
    // Largest minus smallest value over the mean, %.
    function(
        "spread",
        1,
        Runs(|all| Ok(spread(&last_values(all).collect::<Vec<_>>()))),
    ),
    // Last minus first value over the first.
    function(
        "change",
        1,
        Runs(|all| Ok((all[all.len() - 1][1] - all[0][1]) / all[0][1])),
    ),
    // First value over the last.
    function(
        "ratio",
        1,
        Runs(|all| Ok(all[0][1] / all[all.len() - 1][1])),
    ),
    // First minus last value.
    function(
        "difference",
        1,
        Runs(|all| Ok(all[0][1] - all[all.len() - 1][1])),
    ),
    // Number of runs with a larger value than the one before.
    function(
        "rises",
        1,
        Runs(|all| {
            Ok(all
                .windows(2)
                .filter(|pair| pair[1][1] > pair[0][1])
                .count() as f64)
        }),
    ),
    // Slope of the straight line through the second values over the first ones.
    function("slope", 2, Runs(|all| Ok(LineFit::through(all)?.slope))),
    function(
        "intercept",
        2,
        Runs(|all| Ok(LineFit::through(all)?.intercept)),
    ),
    // Largest distance of a value from the line, over the value of the line.
    function(
        "off_line",
        2,
        Runs(|all| {
            let line = LineFit::through(all)?;
            let off = |[x, y]: &[f64; 2]| (y / (line.slope * x + line.intercept) - 1.0).abs();
            Ok(all.iter().map(off).fold(0.0, f64::max))
        }),
    ),
    // Value at a time, between rows by a straight line; in the first row from a time on.
    function("at", 2, Rows(|record, time| record.at(time[0]))),
    function("from", 2, Rows(|record, time| record.from(time[0]))),
    // Time and size of the largest value between two times, by a parabola.
    function(
        "peak_time",
        3,
        Rows(|record, times| Ok(record.peak([times[0], times[1]])?[0])),
    ),
    function(
        "peak",
        3,
        Rows(|record, times| Ok(record.peak([times[0], times[1]])?[1])),
    ),
    // First time after another at which the values fall through zero, and the frequency at which they do.
    function("fall", 2, Rows(|record, time| record.time_of_fall(time[0]))),
    // Real and imaginary part of the Fourier transform of what follows a time, at an angular frequency.
    function(
        "cosine",
        3,
        Rows(|record, at| Ok(record.transform_from(at[0], at[1])[0])),
    ),
    function(
        "sine",
        3,
        Rows(|record, at| Ok(record.transform_from(at[0], at[1])[1])),
    ),
    function("falls", 2, Rows(|record, time| record.frequency(time[0]))),
    function(
        "largest",
        1,
        Rows(|record, _| {
            Ok(record
                .values
                .iter()
                .copied()
                .fold(f64::NEG_INFINITY, f64::max))
        }),
    ),
];

/// The last values of all runs.
fn last_values(all: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    all.iter().map(|it| it[1])
}

/// Largest minus smallest value over the mean, %.
fn spread(values: &[f64]) -> f64 {
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    100.0 * (largest - smallest) / mean
}

/// Names of the number of rows of a run and of the time in a row.
pub(super) const ROWS: &str = "history.rows";
pub(super) const TIME: &str = "history.time";

/// A run, and a row of its history; without one its last state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RunRow {
    pub(super) run: usize,
    pub(super) row: Option<usize>,
}

/// Function for the value of a name in a run and row.
pub(super) type Value<'a> = &'a mut dyn FnMut(RunRow, &str) -> anyhow::Result<f64>;

impl Expression {
    /// Reads an expression.
    pub(super) fn parse(text: &str) -> anyhow::Result<Self> {
        let mut reader = Reader { text, left: text };
        let found = reader.sum();
        let found = found.and_then(|it| {
            ensure!(reader.next().is_none(), "`{}` is left over", reader.left);
            Ok(it)
        });
        found.with_context(|| format!("`{text}` is no expression"))
    }

    /// Names whose values the text does not define.
    pub(super) fn names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Name(name) => vec![name],
            Self::Negative(of) => of.names(),
            Self::Both(_, both) => both.iter().flat_map(Self::names).collect(),
            Self::Call(function, of) => {
                let mut names: Vec<&str> = of.iter().flat_map(Self::names).collect();
                if matches!(function.of, Rows(_)) {
                    names.extend([ROWS, TIME]);
                }
                names
            }
        }
    }

    /// Value of the expression in `runs`; outside of statistics there must be one run.
    pub(super) fn value(&self, runs: Range<usize>, of: Value<'_>) -> anyhow::Result<f64> {
        self.in_row(runs, None, of)
    }

    /// Value of the expression in a run and row.
    pub(super) fn at(&self, place: RunRow, of: Value<'_>) -> anyhow::Result<f64> {
        self.in_row(place.run..place.run + 1, place.row, of)
    }

    fn in_row(&self, runs: Range<usize>, row: Option<usize>, of: Value<'_>) -> anyhow::Result<f64> {
        Ok(match self {
            Self::Number(number) => *number,
            Self::Name(name) => of(row_of(name, runs, row)?, name)?,
            Self::Negative(term) => -term.in_row(runs, row, of)?,
            Self::Both(operator, both) => {
                let one = both[0].in_row(runs.clone(), row, of)?;
                let other = both[1].in_row(runs, row, of)?;
                match operator {
                    Operator::Plus => one + other,
                    Operator::Minus => one - other,
                    Operator::Times => one * other,
                    Operator::Over => one / other,
                    Operator::Power if other.fract() == 0.0 => one.powi(other as i32),
                    Operator::Power => one.powf(other),
                }
            }
            Self::Call(function, terms) => match function.of {
                Numbers(function) => {
                    let values = terms.iter().map(|it| it.in_row(runs.clone(), row, of));
                    function(&values.collect::<anyhow::Result<Vec<_>>>()?)
                }
                Runs(statistic) => {
                    let mut all = Vec::new();
                    for run in runs {
                        let mut values = Vec::new();
                        for term in terms {
                            values.push(term.in_row(run..run + 1, row, of)?);
                        }
                        match (function.n_values, &*values) {
                            (2, &[x, y]) => all.push([x, y]),
                            _ => all.extend(values.iter().map(|value| [0.0, *value])),
                        }
                    }
                    statistic(&all)?
                }
                Rows(function_of_rows) => {
                    let (last, before) = terms.split_last().context("no values in the rows")?;
                    let before = before.iter().map(|it| it.in_row(runs.clone(), row, of));
                    let before = before.collect::<anyhow::Result<Vec<_>>>()?;
                    let record = last.record(row_of(function.name, runs, None)?, of)?;
                    function_of_rows(&record, &before)?
                }
            },
        })
    }

    /// The values in all rows of a run.
    fn record(&self, place: RunRow, of: Value<'_>) -> anyhow::Result<Record> {
        let (mut times, mut values) = (Vec::new(), Vec::new());
        for row in 0..of(place, ROWS)? as usize {
            let row = RunRow {
                row: Some(row),
                ..place
            };
            times.push(of(row, TIME)?);
            values.push(self.at(row, of)?);
        }
        Ok(Record { times, values })
    }
}

/// The run and row of a name with one value.
fn row_of(name: &str, runs: Range<usize>, row: Option<usize>) -> anyhow::Result<RunRow> {
    ensure!(
        runs.len() == 1,
        "`{name}` has {} values: it needs a statistic such as spread({name})",
        runs.len()
    );
    Ok(RunRow {
        run: runs.start,
        row,
    })
}

/// Reader of an expression.
struct Reader<'a> {
    text: &'a str,
    left: &'a str,
}

impl<'a> Reader<'a> {
    /// The next character that is no space.
    fn next(&mut self) -> Option<char> {
        self.left = self.left.trim_start();
        self.left.chars().next()
    }

    /// Skips a character if it is the next one.
    fn skip_if(&mut self, wanted: char) -> bool {
        let is_next = self.next() == Some(wanted);
        if is_next {
            self.left = &self.left[wanted.len_utf8()..];
        }
        is_next
    }

    fn sum(&mut self) -> anyhow::Result<Expression> {
        let mut found = self.product()?;
        loop {
            let operator = match self.next() {
                Some('+') => Operator::Plus,
                Some('-') => Operator::Minus,
                _ => return Ok(found),
            };
            self.left = &self.left[1..];
            found = Expression::Both(operator, Box::new([found, self.product()?]));
        }
    }

    fn product(&mut self) -> anyhow::Result<Expression> {
        let mut found = self.term()?;
        loop {
            let operator = match self.next() {
                Some('*') => Operator::Times,
                Some('/') => Operator::Over,
                _ => return Ok(found),
            };
            self.left = &self.left[1..];
            found = Expression::Both(operator, Box::new([found, self.term()?]));
        }
    }

    fn term(&mut self) -> anyhow::Result<Expression> {
        if self.skip_if('-') {
            return Ok(Expression::Negative(Box::new(self.term()?)));
        }
        let base = self.base()?;
        if !self.skip_if('^') {
            return Ok(base);
        }
        let both = Box::new([base, self.term()?]);
        Ok(Expression::Both(Operator::Power, both))
    }

    fn base(&mut self) -> anyhow::Result<Expression> {
        if self.skip_if('(') {
            let found = self.sum()?;
            ensure!(self.skip_if(')'), "a `)` is missing");
            return Ok(found);
        }
        match self.next() {
            Some(first) if first.is_ascii_digit() => self.number(),
            Some(first) if first.is_alphabetic() => self.name(),
            Some(other) => bail!("`{other}` begins no term"),
            None => bail!("a term is missing at the end of `{}`", self.text),
        }
    }

    /// The characters up to the first one that does not belong to a word.
    fn word(&mut self, belongs: impl Fn(char, Option<char>) -> bool) -> &'a str {
        let mut before = None;
        let end = self.left.char_indices().find(|(_, it)| {
            let ends = !belongs(*it, before);
            before = Some(*it);
            ends
        });
        let (word, left) = self.left.split_at(end.map_or(self.left.len(), |it| it.0));
        self.left = left;
        word
    }

    fn number(&mut self) -> anyhow::Result<Expression> {
        let word = self.word(|it, before| {
            let is_exponent = it == '-' && before == Some('e');
            it.is_ascii_digit() || it == '.' || it == 'e' || is_exponent
        });
        let number = word.parse();
        Ok(Expression::Number(
            number.with_context(|| format!("`{word}` is no number"))?,
        ))
    }

    fn name(&mut self) -> anyhow::Result<Expression> {
        let word = self.word(|it, _| it.is_alphanumeric() || it == '_' || it == '.');
        if !self.skip_if('(') {
            return Ok(Expression::Name(word.to_owned()));
        }
        let function = FUNCTIONS.iter().find(|it| it.name == word);
        let known = || FUNCTIONS.each_ref().map(|it| it.name).join(", ");
        let function =
            function.with_context(|| format!("no function `{word}`; there are {}", known()))?;
        let mut terms = vec![self.sum()?];
        while self.skip_if(',') {
            terms.push(self.sum()?);
        }
        ensure!(self.skip_if(')'), "a `)` is missing");
        let (found, expected) = (terms.len(), function.n_values);
        ensure!(
            expected == 0 || found == expected,
            "`{word}` takes {expected} expressions, not {found}"
        );
        Ok(Expression::Call(function, terms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str, runs: usize) -> anyhow::Result<f64> {
        let mut of = |place: RunRow, name: &str| match name {
            "x" => Ok(place.run as f64),
            "crack.y_2" => Ok(3.0 * place.run as f64 + 1.0),
            ROWS => Ok(4.0),
            // 2, 1, 0, -1 in the rows, and -7 in the last state.
            TIME => Ok(place.row.map_or(9.0, |row| 10.0 * row as f64)),
            "falling" => Ok(place.row.map_or(-7.0, |row| 2.0 - row as f64)),
            other => bail!("no `{other}`"),
        };
        Expression::parse(text)?.value(0..runs, &mut of)
    }

    #[test]
    fn products_go_before_sums_and_from_left_to_right() {
        for (text, expected) in [
            ("1 + 2*3 - 4/2/2", 6.0),
            ("-(1 + 1e-1)*2", -2.2),
            ("sqrt(2*8)/2", 2.0),
            ("2*-3", -6.0),
            ("12/crack.y_2/2", 6.0),
            ("-2^3*4^-0.5", -4.0),
            ("hypot(3, 2^2)", 5.0),
            ("max(1, 3, 2) - min(1, 3, -2)", 5.0),
        ] {
            assert_eq!(value(text, 1).unwrap(), expected, "{text}");
        }
        assert_eq!(
            Expression::parse("a*(b.c - 2)/max(d)").unwrap().names(),
            ["a", "b.c", "d"]
        );
    }

    #[test]
    fn statistics_join_runs() {
        for (text, expected) in [
            ("max(2*x)", 6.0),
            ("sum(x) + mean(x)", 7.5),
            ("spread(crack.y_2)", 100.0 * 9.0 / 5.5),
            ("rises(-x) + rises(x)", 3.0),
            ("change(crack.y_2)", 9.0),
            ("slope(x, crack.y_2)*10 + intercept(x, crack.y_2)", 31.0),
        ] {
            let found = value(text, 4).unwrap();
            assert!((found - expected).abs() < 1e-12, "{text}: {found}");
        }
        assert!(value("off_line(x, crack.y_2)", 4).unwrap() < 1e-15);
    }

    #[test]
    fn functions_of_the_history_read_every_row() {
        for (text, expected) in [
            ("at(15, 2*falling)", 1.0),
            ("from(15, falling) + x", 0.0),
            ("largest(-falling)", 1.0),
            ("fall(0, falling + history.time/100)", 10.0 * 2.0 / 0.9),
            ("at(largest(history.time - 15), falling)", 0.5),
            ("falling", -7.0),
        ] {
            let found = value(text, 1).unwrap();
            assert!((found - expected).abs() < 1e-12, "{text}: {found}");
        }
        assert_eq!(value("max(at(0, falling) + x)", 3).unwrap(), 4.0);
        assert!(value("at(0, falling)", 2).is_err());
        let names = Expression::parse("at(start, end.y)").unwrap();
        assert_eq!(names.names(), ["start", "end.y", ROWS, TIME]);
    }

    #[test]
    fn what_is_no_expression_is_told() {
        for (text, expected) in [
            ("1 +", "a term is missing"),
            ("2 x", "`x` is left over"),
            ("(1", "a `)` is missing"),
            ("median(x)", "no function `median`; there are sqrt, cbrt"),
            ("slope(x)", "`slope` takes 2 expressions, not 1"),
            ("1.2.3", "`1.2.3` is no number"),
            ("2^", "a term is missing"),
        ] {
            let found = format!("{:#}", value(text, 1).unwrap_err());
            assert!(found.contains(expected), "{text}: {found}");
        }
        let found = value("x + 1", 2).unwrap_err().to_string();
        assert!(found.contains("needs a statistic"), "{found}");
    }
}
