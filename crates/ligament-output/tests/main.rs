//! Result files as other readers see them.

mod python_readers;
mod vtkio_reader;
