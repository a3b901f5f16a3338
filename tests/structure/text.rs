//! Source text as its tokens: without comments, without what strings hold, without tests.

/// A token and its line, counted from 1, with what a literal is in the source.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Token {
    pub(super) text: String,
    pub(super) line: usize,
    pub(super) literal: String,
}

/// The tokens of a source file without its comments and without the items behind `#[cfg(test)]`.
///
/// Identifiers, numbers and `::`, `->`, `=>` are one token each, any other character is one of its own. A string or character
/// literal is the token `""`, a lifetime the token `'`.
pub(super) fn tokens(source: &str) -> Vec<Token> {
    without_tests(&scan(source))
}

fn scan(source: &str) -> Vec<Token> {
    let text: Vec<char> = source.chars().collect();
    let mut tokens = Vec::new();
    let (mut at, mut line) = (0, 1);
    while at < text.len() {
        let (end, token) = next_token(&text, at);
        if let Some(token) = token {
            let is_literal = token == "\"\"";
            let literal = text[at..end].iter().filter(|_| is_literal).collect();
            tokens.push(Token {
                text: token,
                line,
                literal,
            });
        }
        line += text[at..end].iter().filter(|&&c| c == '\n').count();
        at = end;
    }
    tokens
}

/// The end of what begins at a place, and its token if it is one.
fn next_token(text: &[char], at: usize) -> (usize, Option<String>) {
    let here = |offset: usize| text.get(at + offset).copied().unwrap_or('\0');
    let literal = || Some("\"\"".to_owned());
    match (here(0), here(1)) {
        (c, _) if c.is_whitespace() => (at + 1, None),
        ('/', '/') => (find(text, at, &['\n']), None),
        ('/', '*') => (find(text, at + 2, &['*', '/']) + 2, None),
        ('"', _) => (end_of_string(text, at + 1), literal()),
        ('b', '"') => (end_of_string(text, at + 2), literal()),
        ('r', '"' | '#') if end_of_raw_string(text, at + 1).is_some() => (
            end_of_raw_string(text, at + 1).unwrap_or(text.len()),
            literal(),
        ),
        ('\'', '\\') => (find(text, at + 3, &['\'']) + 1, literal()),
        ('\'', _) if here(2) == '\'' => (at + 3, literal()),
        ('\'', _) => (end_of_word(text, at + 1), Some("'".to_owned())),
        (c, _) if is_word(c) => {
            let end = end_of_word(text, at);
            (end, Some(text[at..end].iter().collect()))
        }
        (':', ':') | ('-' | '=', '>') => (at + 2, Some(text[at..at + 2].iter().collect())),
        (c, _) => (at + 1, Some(c.to_string())),
    }
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn end_of_word(text: &[char], at: usize) -> usize {
    (at..text.len())
        .find(|&k| !is_word(text[k]))
        .unwrap_or(text.len())
}

/// Where some characters begin, or the end.
fn find(text: &[char], at: usize, wanted: &[char]) -> usize {
    (at..text.len())
        .find(|&k| text[k..].starts_with(wanted))
        .unwrap_or(text.len())
}

fn end_of_string(text: &[char], mut at: usize) -> usize {
    while at < text.len() && text[at] != '"' {
        at += if text[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

/// The end of a raw string whose `#` or `"` stands at a place; none where it is something else (`r#type`).
fn end_of_raw_string(text: &[char], at: usize) -> Option<usize> {
    let hashes = text[at..].iter().take_while(|&&c| c == '#').count();
    if text.get(at + hashes) != Some(&'"') {
        return None;
    }
    let mut closing = vec!['"'];
    closing.resize(1 + hashes, '#');
    Some(find(text, at + hashes + 1, &closing) + closing.len())
}

fn without_tests(tokens: &[Token]) -> Vec<Token> {
    const TEST: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let is_test = tokens.len() >= at + TEST.len()
            && (TEST.iter().zip(&tokens[at..])).all(|(wanted, token)| *wanted == token.text);
        if is_test {
            at = end_of_item(tokens, at + TEST.len());
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    kept
}

/// The end of an item: behind its block, or its semicolon outside of brackets.
fn end_of_item(tokens: &[Token], at: usize) -> usize {
    let mut k = at;
    while k < tokens.len() {
        match tokens[k].text.as_str() {
            ";" => return k + 1,
            "{" => return closing(tokens, k) + 1,
            "(" | "[" => k = closing(tokens, k),
            _ => {}
        }
        k += 1;
    }
    k
}

/// The place of the bracket that closes the one at a place.
pub(super) fn closing(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0_usize;
    for (k, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return k;
        }
    }
    tokens.len().saturating_sub(1)
}
