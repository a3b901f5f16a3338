//! What the user can do about an error, in the terms of each front end.

use std::error::Error;
use std::fmt;

/// What the user can do about an error. It is the last source of the error, so it passes through all errors around it to the front end
/// ([`causes`]), which words it in its own terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Remedy {
    /// Another path for the file or folder, or a resolution by which this path can be written to.
    OtherPath(PathKind, Option<Resolution>),
    /// Another run, with this value of a key of the case.
    RunAgain {
        /// Path of the key, `output.model`.
        key: &'static str,
        /// The value, in TOML.
        value: &'static str,
    },
    /// An option of the request, with a value.
    Give {
        /// Name of the option on the command line, `at`.
        option: &'static str,
        /// Placeholder for its value, `X,Y,Z`.
        value: &'static str,
    },
    /// An option of the request, with a number.
    GiveNumber {
        /// Name of the option on the command line, `point`.
        option: &'static str,
        /// Number to give for the option.
        value: i64,
    },
    /// An option of the request, to be left out.
    OmitOption(&'static str),
}

/// Purpose of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PathKind {
    /// A path of a file.
    File,
    /// A folder of results.
    Folder,
}

/// Resolution of a path that is occupied: what lets the user write there after all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolution {
    /// The existing file or folder is replaced.
    Replace,
    /// The user removes the existing file or folder.
    Remove,
    /// The user waits for the end of another process.
    Wait,
}

/// Terms of a front end.
#[derive(Debug, Clone, Copy)]
pub struct Terms {
    /// Text that asks for another path, appended to a message: " with --out".
    pub elsewhere: &'static str,
    /// Text that asks for a replacement, appended to a message: " with --force".
    pub replace: &'static str,
    /// Words for setting a key to a value.
    pub setting: fn(&str, &str) -> String,
    /// Words for an option, from its name on the command line and the placeholder of its value; the latter is empty where the option is
    /// only named.
    pub option: fn(&str, &str) -> String,
}

/// Terms that belong to no front end.
const COMMON: Terms = Terms {
    elsewhere: "",
    replace: "",
    setting: |key, value| format!("`{key} = {value}`"),
    option: |name, value| format!("{name} {value}").trim_end().to_owned(),
};

impl Remedy {
    /// The remedy in the terms of a front end.
    pub fn text_in_terms(self, terms: &Terms) -> String {
        let (kind, resolution) = match self {
            Self::OtherPath(kind, resolution) => (kind, resolution),
            Self::RunAgain { key, value } => {
                return format!("run it again with {}", (terms.setting)(key, value));
            }
            Self::Give { option, value } => {
                return format!("give {}", (terms.option)(option, value));
            }
            Self::GiveNumber { option, value } => {
                return format!("give {}", (terms.option)(option, &value.to_string()));
            }
            Self::OmitOption(option) => return format!("leave out {}", (terms.option)(option, "")),
        };
        let kind = match kind {
            PathKind::File => "file",
            PathKind::Folder => "folder",
        };
        let resolution = match resolution {
            Some(Resolution::Replace) => format!(", or replace it{}", terms.replace),
            Some(Resolution::Remove) => ", or remove it yourself".to_owned(),
            Some(Resolution::Wait) => ", or wait for its end".to_owned(),
            None => String::new(),
        };
        format!("choose another {kind}{}{resolution}", terms.elsewhere)
    }
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text_in_terms(&COMMON))
    }
}

impl Error for Remedy {}

/// Messages of an error and its causes, the outermost first; the last is followed by the remedy, if there is one, in the terms of a front end.
pub fn causes<'a>(
    chain: impl Iterator<Item = &'a (dyn Error + 'static)>,
    terms: &Terms,
) -> Vec<String> {
    let mut causes: Vec<String> = Vec::new();
    for cause in chain {
        match (cause.downcast_ref::<Remedy>(), causes.last_mut()) {
            (Some(remedy), Some(last)) => *last += &format!("; {}", remedy.text_in_terms(terms)),
            _ => causes.push(cause.to_string()),
        }
    }
    causes
}

#[cfg(test)]
mod tests {
    use std::iter::successors;

    use super::*;

    /// An error around another one that has a remedy, as front ends see it.
    #[derive(Debug, thiserror::Error)]
    enum OuterError {
        #[error(transparent)]
        Inner(#[from] Inner),
    }

    #[derive(Debug, thiserror::Error)]
    #[error("out has results")]
    struct Inner(#[source] Remedy);

    #[test]
    fn each_front_end_words_the_remedy() {
        let terms = Terms {
            elsewhere: " by PATH",
            replace: " by REPLACE",
            setting: |key, value| format!("{key}:{value}"),
            option: |name, value| format!("/{name}:{value}"),
        };
        let remedy = Remedy::OtherPath(PathKind::Folder, Some(Resolution::Replace));
        let error = OuterError::from(Inner(remedy));
        let chain = successors(Some(&error as &(dyn Error + 'static)), |it| (*it).source());
        let expected = "out has results; choose another folder by PATH, or replace it by REPLACE";
        assert_eq!(causes(chain, &terms), [expected]);
        let again = Remedy::RunAgain {
            key: "output.model",
            value: "true",
        };
        assert_eq!(
            again.text_in_terms(&terms),
            "run it again with output.model:true"
        );
        let at = Remedy::Give {
            option: "at",
            value: "X,Y",
        };
        assert_eq!(at.text_in_terms(&terms), "give /at:X,Y");
        assert_eq!(at.to_string(), "give at X,Y");
        assert_eq!(Remedy::OmitOption("view").to_string(), "leave out view");
        assert_eq!(again.to_string(), "run it again with `output.model = true`");
    }
}
