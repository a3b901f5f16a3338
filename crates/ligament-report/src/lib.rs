//! Results of runs as one page for a browser: no network, no other file.
//!
//! | module | holds |
//! |---|---|
//! | [`page`] | the page: what is asked for, and the file that is written |
//! | `run` | a folder of results as the page has it |
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
mod fields;
mod history;
pub mod page;
mod run;
mod solid;
mod summary;

pub use page::{Contents, ReportError, Request, Written, write_report};
