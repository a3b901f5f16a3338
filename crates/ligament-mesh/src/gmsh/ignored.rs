//! Sections of a file that are not used.

use super::cursor::Cursor;
use crate::remark::Remark;

/// Number of sections that are named in the remark.
const NAMED: usize = 12;

/// Number of characters of a name in the remark.
const LENGTH: usize = 40;

/// Sections that are not used, though they say something about the body.
#[derive(Debug, Default)]
pub(super) struct IgnoredSections {
    /// Names, each once, with the first offset, bytes.
    named: Vec<(String, usize)>,
    /// Number of other sections.
    others: usize,
}

impl IgnoredSections {
    /// Adds a section by its name and its offset.
    pub(super) fn push(&mut self, (name, offset): (&str, usize)) {
        let name: String = name.escape_debug().take(LENGTH).collect();
        let is_new = self.named.iter().all(|it| it.0 != name);
        if is_new && self.named.len() < NAMED {
            self.named.push((name, offset));
        } else {
            self.others += usize::from(is_new);
        }
    }

    /// The remark on all of them.
    pub(super) fn remark(&self, cursor: &Cursor<'_>) -> Option<Remark> {
        let named = self.named.iter();
        let sections = named.map(|(name, offset)| (name.clone(), cursor.place(*offset)));
        (!self.named.is_empty()).then(|| Remark::IgnoredSections {
            sections: sections.collect(),
            others: self.others,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_is_listed_once_and_many_are_counted() {
        let cursor = Cursor::new(b"a\nb\nc\n");
        let mut ignored = IgnoredSections::default();
        assert_eq!(ignored.remark(&cursor), None);
        ignored.push(("Colours", 2));
        ignored.push(("Colours", 4));
        let remark = ignored.remark(&cursor).unwrap().to_string();
        let expected = "the section $Colours (line 2) was ignored: nothing in it is used";
        assert_eq!(remark, expected);
        ignored.push(("a\u{1b}[31m", 4));
        for number in 0..NAMED {
            ignored.push((&format!("S{number}"), 4));
        }
        let remark = ignored.remark(&cursor).unwrap().to_string();
        assert!(
            remark.contains("$a\\u{1b}[31m (line 3), $S0 (line 3)"),
            "{remark}"
        );
        assert!(
            remark.ends_with("and 2 others were ignored: nothing in them is used"),
            "{remark}"
        );
    }
}
