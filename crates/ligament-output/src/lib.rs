//! Result files: VTU fields, PVD collections and CSV histories
//!
//! | Module | Writes |
//! |--------|--------|
//! | [`vtu`] | the fields of one output on points and cells, for ParaView, VTK, PyVista and meshio |
//! | [`pvd`] | the list of those outputs with their times, which ParaView opens as a series |
//! | [`csv`] | tables of scalars over the steps |
//! | [`columns`] | words in columns, for people |
//! | [`checkpoint`] | a run at a moment, from which it can go on |
//! | [`folder`] | the folder that holds them, without destroying what was there |
//! | [`summary`] | a run in numbers |
//! | [`results`] | all of these from a run, as its observer |
//!
//! A file is either appended to by whole rows (CSV) or replaced as a whole by a rename (all others), so the results of
//! a job can be opened while it is running. Only [`results`] knows about models and analyses: the others take plain
//! slices.

mod atomic;
pub mod checkpoint;
pub mod columns;
pub mod csv;
mod error;
pub mod folder;
pub mod pvd;
pub mod quantity;
pub mod results;
mod single_file;
pub mod summary;
pub mod terminal;
pub mod vtu;
mod written;
mod xml;

pub use atomic::{read_text, remove_if_there, rename};
pub use error::{Error, FieldLocation};
pub use single_file::{check_file, is_standard_output, is_stream, replace_file, write_file};
