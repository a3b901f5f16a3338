//! Messages about settings, which each layer names by its own keywords.

use std::borrow::Cow;
use std::fmt;

/// A message that names settings of type S: with their Rust names by [`Display`](fmt::Display), with the names of another layer by
/// [`said`](Self::said).
#[derive(Debug, Clone, PartialEq)]
pub struct Advice<S> {
    text: Cow<'static, str>,
    settings: Vec<S>,
}

impl<S> Advice<S> {
    /// A message with settings in the places of its `{}`, one for each.
    pub fn new(text: impl Into<Cow<'static, str>>, settings: impl Into<Vec<S>>) -> Self {
        let (text, settings) = (text.into(), settings.into());
        Self { text, settings }
    }

    /// The message with each setting named by a function.
    pub fn said(&self, words: impl Fn(&S) -> String) -> String {
        let mut pieces = self.text.splitn(self.settings.len() + 1, "{}");
        let begin = pieces.next().unwrap_or_default().to_owned();
        let named = pieces.zip(&self.settings);
        named.fold(begin, |text, (piece, setting)| {
            text + &words(setting) + piece
        })
    }
}

impl<S: fmt::Display> fmt::Display for Advice<S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.said(S::to_string))
    }
}

impl<S> From<&'static str> for Advice<S> {
    fn from(text: &'static str) -> Self {
        Self::new(text, Vec::new())
    }
}

impl<S> From<String> for Advice<S> {
    fn from(text: String) -> Self {
        Self::new(text, Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_layer_names_the_settings_in_its_own_words() {
        let advice = Advice::new("take {} or {}", [1, 2]);
        assert_eq!(advice.to_string(), "take 1 or 2");
        assert_eq!(
            advice.said(|it| format!("key = {it}")),
            "take key = 1 or key = 2"
        );
        let as_it_is: Advice<i32> = "a group called `{}`".into();
        assert_eq!(as_it_is.to_string(), "a group called `{}`");
    }
}
