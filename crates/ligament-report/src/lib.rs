//! Results of runs as one page for a browser, without network access or other files.
//!
//! | module | holds |
//! |---|---|
//! | [`page`] | the request for a page, and the written file |
//! | `run` | a result folder as data of the page |
//! | `parts` | texts of columns, and the budget of a page's size |
//! | [`ReportError`] | errors of making a page |
//! | `body` | points, cells and the order of the points |
//! | `crack` | cracks over the steps |
//! | `fields` | fields over the steps |
//! | `bonds` | bonds, their limits and their breakage |
//! | `history` | the table of the steps |
//! | `inputs` | mesh, material and loads as text |
//! | `sketch` | supports and loads as symbols on the body |
//! | `study` | intervals of convergence and pictures of a study |
//! | `summary` | title, warnings and results as text |
//! | `columns` | encoding of numbers as compressed text |
//! | `viewer/` | the program of the page: HTML, CSS and JavaScript, joined without changes |
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")
)]

mod body;
mod bonds;
mod columns;
mod crack;
mod error;
mod fields;
mod history;
mod inputs;
pub mod page;
mod parts;
mod run;
mod sketch;
mod study;
mod summary;

pub use error::ReportError;
pub use page::{DIGITS, MEGABYTE, PageContents, Request, SIZE, STEPS, WrittenPage, write_report};
pub use parts::UnitOf;
