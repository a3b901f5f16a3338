//! The matches of a source file with the patterns of their arms.

use super::text::{Token, closing};

/// A match.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Match {
    /// Line of the word `match`.
    pub(super) line: usize,
    /// Patterns of the arms with their conditions, each as its tokens.
    pub(super) patterns: Vec<Vec<String>>,
}

impl Match {
    /// Whether some arm names a value of one of these types, and another takes whatever is left.
    pub(super) fn hides_values_of(&self, types: &[&str]) -> bool {
        let names = |pattern: &Vec<String>| {
            let mut pairs = pattern.windows(2);
            pairs.any(|pair| types.contains(&pair[0].as_str()) && pair[1] == "::")
        };
        let takes_all =
            |pattern: &Vec<String>| pattern.iter().all(|it| "(_,)".contains(it.as_str()));
        self.patterns.iter().any(names) && self.patterns.iter().any(takes_all)
    }
}

/// The matches in tokens, nested ones included.
pub(super) fn matches(tokens: &[Token]) -> Vec<Match> {
    let places = (0..tokens.len()).filter(|&at| tokens[at].text == "match");
    places.map(|at| read(tokens, at)).collect()
}

fn read(tokens: &[Token], at: usize) -> Match {
    let text = |k: usize| tokens[k].text.as_str();
    // Behind a bracket, or one token on.
    let next = |k: usize| match text(k) {
        "(" | "[" | "{" => closing(tokens, k) + 1,
        _ => k + 1,
    };
    let mut open = at + 1;
    while text(open) != "{" {
        open = next(open);
    }
    let close = closing(tokens, open);
    let (mut patterns, mut k) = (Vec::new(), open + 1);
    while k < close {
        let begin = k;
        while k < close && text(k) != "=>" {
            k = next(k);
        }
        let pattern = &tokens[begin..k.min(close)];
        patterns.push(pattern.iter().map(|it| it.text.clone()).collect());
        let is_block = k + 1 < close && text(k + 1) == "{";
        k = next((k + 1).min(close));
        while k < close && !is_block && text(k - 1) != "," {
            k = next(k);
        }
        if is_block && k < close && text(k) == "," {
            k += 1;
        }
    }
    Match {
        line: tokens[at].line,
        patterns,
    }
}
