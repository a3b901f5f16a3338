//! Expressions of an experiment: numbers, names, + - * /, parentheses, square roots, and statistics over the runs that an entry joins.
//!
//! A name has letters, digits, `_` and `.`; a statistic is a name with expressions in parentheses, each of which is evaluated in every run.

use anyhow::{Context, bail, ensure};
use ligament_study::line_fit::LineFit;

use crate::spread::spread;

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Expression {
    Number(f64),
    Name(String),
    Negative(Box<Self>),
    Root(Box<Self>),
    Both(Operator, Box<[Self; 2]>),
    Statistic(&'static Statistic, Vec<Self>),
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

/// A statistic of values of several runs.
#[derive(Debug)]
pub(super) struct Statistic {
    name: &'static str,
    /// Number of values of each run.
    n_values: usize,
    /// Value of the statistic for the values of all runs; the only value of a run is the last one.
    of: fn(&[[f64; 2]]) -> anyhow::Result<f64>,
}

impl PartialEq for Statistic {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

static STATISTICS: [Statistic; 10] = [
    Statistic {
        name: "max",
        n_values: 1,
        of: |all| Ok(all.iter().map(|it| it[1]).fold(f64::NEG_INFINITY, f64::max)),
    },
    Statistic {
        name: "sum",
        n_values: 1,
        of: |all| Ok(all.iter().map(|it| it[1]).sum()),
    },
    Statistic {
        name: "mean",
        n_values: 1,
        of: |all| Ok(all.iter().map(|it| it[1]).sum::<f64>() / all.len() as f64),
    },
    // Largest minus smallest value over the mean, %.
    Statistic {
        name: "spread",
        n_values: 1,
        of: |all| Ok(spread(&all.iter().map(|it| it[1]).collect::<Vec<_>>())),
    },
    // Last minus first value over the first.
    Statistic {
        name: "change",
        n_values: 1,
        of: |all| Ok((all[all.len() - 1][1] - all[0][1]) / all[0][1]),
    },
    // First value over the last.
    Statistic {
        name: "ratio",
        n_values: 1,
        of: |all| Ok(all[0][1] / all[all.len() - 1][1]),
    },
    // Number of runs with a larger value than the one before.
    Statistic {
        name: "rises",
        n_values: 1,
        of: |all| {
            Ok(all
                .windows(2)
                .filter(|pair| pair[1][1] > pair[0][1])
                .count() as f64)
        },
    },
    // Of the straight line through the second values over the first ones.
    Statistic {
        name: "slope",
        n_values: 2,
        of: |all| Ok(LineFit::through(all)?.slope),
    },
    Statistic {
        name: "intercept",
        n_values: 2,
        of: |all| Ok(LineFit::through(all)?.intercept),
    },
    // Largest distance of a value from the line, over that of the line.
    Statistic {
        name: "off_line",
        n_values: 2,
        of: |all| {
            let line = LineFit::through(all)?;
            let off = |[x, y]: &[f64; 2]| (y / (line.slope * x + line.intercept) - 1.0).abs();
            Ok(all.iter().map(off).fold(0.0, f64::max))
        },
    },
];

/// Value of a name in a run.
pub(super) type Value<'a> = &'a mut dyn FnMut(usize, &str) -> anyhow::Result<f64>;

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

    /// Names that have no value in the text.
    pub(super) fn names(&self) -> Vec<&str> {
        match self {
            Self::Number(_) => Vec::new(),
            Self::Name(name) => vec![name],
            Self::Negative(of) | Self::Root(of) => of.names(),
            Self::Both(_, both) => both.iter().flat_map(Self::names).collect(),
            Self::Statistic(_, of) => of.iter().flat_map(Self::names).collect(),
        }
    }

    /// Value of the expression in `runs`; outside of statistics there must be one run.
    pub(super) fn value(&self, runs: std::ops::Range<usize>, of: Value<'_>) -> anyhow::Result<f64> {
        Ok(match self {
            Self::Number(number) => *number,
            Self::Name(name) => {
                ensure!(
                    runs.len() == 1,
                    "`{name}` has {} values: it needs a statistic such as spread({name})",
                    runs.len()
                );
                of(runs.start, name)?
            }
            Self::Negative(term) => -term.value(runs, of)?,
            Self::Root(term) => term.value(runs, of)?.sqrt(),
            Self::Both(operator, both) => {
                let one = both[0].value(runs.clone(), of)?;
                let other = both[1].value(runs, of)?;
                match operator {
                    Operator::Plus => one + other,
                    Operator::Minus => one - other,
                    Operator::Times => one * other,
                    Operator::Over => one / other,
                }
            }
            Self::Statistic(statistic, terms) => {
                let mut all = Vec::new();
                for run in runs {
                    let mut values = [0.0; 2];
                    for (value, term) in values[2 - terms.len()..].iter_mut().zip(terms) {
                        *value = term.value(run..run + 1, of)?;
                    }
                    all.push(values);
                }
                (statistic.of)(&all)?
            }
        })
    }
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

    /// Goes beyond a character if it is the next one.
    fn takes(&mut self, wanted: char) -> bool {
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
        if self.takes('-') {
            return Ok(Expression::Negative(Box::new(self.term()?)));
        }
        if self.takes('(') {
            let found = self.sum()?;
            ensure!(self.takes(')'), "a `)` is missing");
            return Ok(found);
        }
        match self.next() {
            Some(first) if first.is_ascii_digit() => self.number(),
            Some(first) if first.is_alphabetic() => self.name(),
            Some(other) => bail!("`{other}` begins no term"),
            None => bail!("a term is missing at the end of `{}`", self.text),
        }
    }

    /// The characters up to the first one that does not belong.
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
        if !self.takes('(') {
            return Ok(Expression::Name(word.to_owned()));
        }
        if word == "sqrt" {
            let of = self.sum()?;
            ensure!(self.takes(')'), "a `)` is missing");
            return Ok(Expression::Root(Box::new(of)));
        }
        let statistic = STATISTICS.iter().find(|it| it.name == word);
        let known = || STATISTICS.each_ref().map(|it| it.name).join(", ");
        let statistic =
            statistic.with_context(|| format!("no statistic `{word}`; there are {}", known()))?;
        let mut terms = vec![self.sum()?];
        while self.takes(',') {
            terms.push(self.sum()?);
        }
        ensure!(self.takes(')'), "a `)` is missing");
        let (found, expected) = (terms.len(), statistic.n_values);
        ensure!(
            found == expected,
            "`{word}` takes {expected} expressions, not {found}"
        );
        Ok(Expression::Statistic(statistic, terms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str, runs: usize) -> anyhow::Result<f64> {
        let mut of = |run: usize, name: &str| match name {
            "x" => Ok(run as f64),
            "crack.y_2" => Ok(3.0 * run as f64 + 1.0),
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
    fn what_is_no_expression_is_told() {
        for (text, expected) in [
            ("1 +", "a term is missing"),
            ("2 x", "`x` is left over"),
            ("(1", "a `)` is missing"),
            ("median(x)", "no statistic `median`; there are max, sum"),
            ("slope(x)", "`slope` takes 2 expressions, not 1"),
            ("1.2.3", "`1.2.3` is no number"),
            ("2^3", "`^3` is left over"),
        ] {
            let found = format!("{:#}", value(text, 1).unwrap_err());
            assert!(found.contains(expected), "{text}: {found}");
        }
        let found = value("x + 1", 2).unwrap_err().to_string();
        assert!(found.contains("needs a statistic"), "{found}");
    }
}
