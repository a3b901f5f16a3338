//! Result files: VTU fields, PVD collections and CSV histories
//!
//! | Module | Writes |
//! |--------|--------|
//! | [`vtu`] | the fields of one output on points and cells, for ParaView, VTK, PyVista and meshio |
//! | [`pvd`] | the list of those outputs with their times, which ParaView opens as a series |
//! | [`csv`] | tables of scalars over the steps |
//! | [`columns`] | text in aligned columns |
//! | [`checkpoint`] | the state of a run, from which it can be resumed |
//! | [`folder`] | the folder of results, without loss of earlier files |
//! | [`summary`] | a run in numbers |
//! | [`quantity`] | numbers with their units, as text |
//! | [`terminal`] | texts without control characters |
//! | [`remedy`] | nothing: what the user can do about an error |
//! | [`results`] | all of these files from a run, as its observer |
//!
//! A file is either appended to by whole rows (CSV) or replaced as a whole by a rename (all others), so the results of a job can be opened
//! while it is running. Only [`results`] depends on models and analyses: the other modules take slices.

mod atomic;
pub mod checkpoint;
pub mod columns;
pub mod csv;
mod error;
mod file_digest;
pub mod folder;
pub mod pvd;
pub mod quantity;
pub mod remedy;
pub mod results;
mod single_file;
pub mod summary;
pub mod terminal;
pub mod vtu;
mod xml;

pub use atomic::{read_json, read_text, remove_if_there, rename};
pub use error::{Error, FieldLocation};
pub use single_file::{check_file, is_standard_output, is_stream, replace_file, write_file};
