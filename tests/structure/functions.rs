//! The functions of a source file with their sizes.

use super::text::{Token, closing};

/// A function with a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Function {
    pub(super) name: String,
    /// From the line of `fn` to that of the closing brace.
    pub(super) lines: usize,
    /// What it is given, the value it is called on included.
    pub(super) parameters: usize,
    /// Whether its body has a loop.
    pub(super) has_loop: bool,
}

/// The functions that are defined in tokens, nested ones included.
pub(super) fn functions(tokens: &[Token]) -> Vec<Function> {
    let begins = |k: &usize| tokens[*k].text == "fn" && is_name(&tokens[*k + 1].text);
    let places = (0..tokens.len().saturating_sub(1)).filter(begins);
    places.filter_map(|at| function(tokens, at)).collect()
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// The function whose `fn` stands at a place; none where it has no body.
fn function(tokens: &[Token], at: usize) -> Option<Function> {
    let open = behind_generics(tokens, at + 2);
    let close = closing(tokens, open);
    let mut body = close;
    while !["{", ";"].contains(&tokens[body].text.as_str()) {
        body += 1;
        if ["(", "["].contains(&tokens[body].text.as_str()) {
            body = closing(tokens, body);
        }
    }
    let end = closing(tokens, body);
    let is_loop = |it: &Token| ["for", "loop", "while"].contains(&it.text.as_str());
    (tokens[body].text == "{").then(|| Function {
        name: tokens[at + 1].text.clone(),
        lines: tokens[end].line - tokens[at].line + 1,
        parameters: parameters(&tokens[open + 1..close]),
        has_loop: tokens[body..end].iter().any(is_loop),
    })
}

fn behind_generics(tokens: &[Token], at: usize) -> usize {
    let mut depth = 0_usize;
    let mut k = at;
    loop {
        match tokens[k].text.as_str() {
            "<" => depth += 1,
            ">" => depth -= 1,
            _ => {}
        }
        if depth == 0 && tokens[k].text == "(" {
            return k;
        }
        k += 1;
    }
}

/// Number of values that are bound between the brackets of a signature: a parameter that takes a tuple or an array apart counts by its
/// parts.
fn parameters(tokens: &[Token]) -> usize {
    parts(tokens).map(bindings).sum()
}

/// Values that a parameter binds: the names of a tuple, one of any other pattern.
fn bindings(parameter: &[Token]) -> usize {
    match parameter.first().map(|it| it.text.as_str()) {
        None => 0,
        Some("(" | "[") => parts(&parameter[1..closing(parameter, 0)])
            .map(bindings)
            .sum(),
        Some(_) => 1,
    }
}

/// Parts between commas that no bracket holds.
fn parts(tokens: &[Token]) -> impl Iterator<Item = &[Token]> {
    let mut depth = 0_isize;
    let separates = move |token: &Token| {
        match token.text.as_str() {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" | ">" => depth -= 1,
            _ => {}
        }
        depth == 0 && token.text == ","
    };
    tokens.split(separates).filter(|it| !it.is_empty())
}
