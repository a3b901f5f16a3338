//! Results of runs as one page for a browser: no network, no other file.
//!
//! | module | holds |
//! |---|---|
//! | [`page`] | the page: what is asked for, and the file that is written |
//! | `run` | a folder of results as the page has it |
//! | `parts` | what both kinds of bodies give to a page |
//! | [`ReportError`] | why there is no page |
//! | `solid` | pictures of a solid over the steps |
//! | `body` | points, cells and the order of the points |
//! | `fields` | fields over the steps |
//! | `bonds` | bonds, their limits and what became of them |
//! | `history` | the table of the steps |
//! | `summary` | title, warnings and results in words |
//! | `columns` | numbers rounded, predicted, compressed and as text |
//! | `viewer/` | the program of the page: HTML, CSS and JavaScript, joined as they are |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod body;
mod bonds;
mod columns;
mod error;
mod fields;
mod history;
pub mod page;
mod parts;
mod run;
mod solid;
mod summary;

pub use error::ReportError;
pub use page::{Contents, Request, Written, write_report};
