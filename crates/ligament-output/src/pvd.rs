//! PVD collections: the series of VTU files over the load history.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::Error;
use crate::atomic::remove_file;
use crate::replace_file;
use crate::xml::escape_attribute;

/// A list of VTU files with their times, which ParaView opens as one series.
///
/// Times grow from each file to the next: readers sort the files by time and show one file per time.
#[derive(Debug)]
pub struct Collection {
    path: PathBuf,
    /// Time and file name, in the order of output.
    outputs: Vec<(f64, String)>,
}

impl Collection {
    /// An empty collection that will be written to `path`.
    ///
    /// The file is created with the first output: ParaView rejects a collection without files.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            outputs: Vec::new(),
        }
    }

    /// A collection with these outputs, whose file is rewritten, or removed without outputs.
    ///
    /// # Errors
    ///
    /// If the file cannot be replaced or removed.
    pub fn with_outputs(
        path: impl Into<PathBuf>,
        outputs: Vec<(f64, String)>,
    ) -> Result<Self, Error> {
        let path = path.into();
        let collection = Self { path, outputs };
        if collection.outputs.is_empty() {
            remove_file(&collection.path)?;
        } else {
            replace_file(&collection.path, collection.to_xml().as_bytes())?;
        }
        Ok(collection)
    }

    /// The outputs so far: times and file names.
    pub fn outputs(&self) -> &[(f64, String)] {
        &self.outputs
    }

    /// Lists `file`, relative to the folder of the collection, under `time` and rewrites the collection atomically, so
    /// that a running job can be opened. The file should exist by then.
    ///
    /// # Errors
    ///
    /// If the time is not finite or not after the time of the previous file, or the collection cannot be written.
    pub fn append(&mut self, time: f64, file: impl Into<String>) -> Result<(), Error> {
        let file = file.into();
        let before = self.outputs.last().map_or(f64::NEG_INFINITY, |it| it.0);
        if !(time.is_finite() && time > before) {
            let path = self.path.clone();
            let reason = format!(
                "the time of {file} is {time} after {before}; a collection needs finite times that grow"
            );
            return Err(Error::Refused { path, reason });
        }
        self.outputs.push((time, file));
        replace_file(&self.path, self.to_xml().as_bytes())
    }

    /// Takes files off the list whose names are not kept.
    ///
    /// # Errors
    ///
    /// If the collection cannot be written.
    pub(crate) fn retain(&mut self, is_kept: impl Fn(&str) -> bool) -> Result<(), Error> {
        let n_before = self.outputs.len();
        self.outputs.retain(|(_, file)| is_kept(file));
        match self.outputs.len() {
            after if after == n_before => Ok(()),
            _ => replace_file(&self.path, self.to_xml().as_bytes()),
        }
    }

    fn to_xml(&self) -> String {
        let mut xml = String::from(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (time, file) in &self.outputs {
            // `{:?}` prints the shortest decimal that reads back to the same bits. Writing to a string cannot fail.
            let _ = writeln!(
                xml,
                "<DataSet timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"{}\"/>",
                escape_attribute(file)
            );
        }
        xml.push_str("</Collection>\n</VTKFile>\n");
        xml
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn is_complete_after_each_output() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.pvd");
        let mut collection = Collection::new(&path);
        for step in 0..3 {
            collection
                .append(0.1 * f64::from(step), format!("fields_{step:04}.vtu"))
                .unwrap();
            let xml = fs::read_to_string(&path).unwrap();
            assert_eq!(xml.matches("<DataSet ").count() as i32, step + 1);
            assert!(xml.ends_with("</Collection>\n</VTKFile>\n"));
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn times_keep_every_digit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.pvd");
        let mut collection = Collection::new(&path);
        let times = [-2.5e-300, 0.0, 1e-7, 0.1 + 0.2];
        for time in times {
            collection.append(time, "a.vtu").unwrap();
        }
        let xml = fs::read_to_string(&path).unwrap();
        let read: Vec<f64> = xml
            .split("timestep=\"")
            .skip(1)
            .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
            .collect();
        assert_eq!(read, times);
    }

    #[test]
    fn names_are_escaped() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.pvd");
        let mut collection = Collection::new(&path);
        collection.append(0.0, "a<b>&\"c'.vtu").unwrap();
        let xml = fs::read_to_string(&path).unwrap();
        assert!(xml.contains("file=\"a&lt;b&gt;&amp;&quot;c&apos;.vtu\""));
    }

    #[test]
    fn a_time_that_does_not_grow_is_refused_and_not_listed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fields.pvd");
        let mut collection = Collection::new(&path);
        collection.append(1.0, "b.vtu").unwrap();
        for time in [f64::NAN, f64::INFINITY, 0.5, 1.0] {
            let error = collection.append(time, "a.vtu").unwrap_err().to_string();
            assert!(error.contains("the time of a.vtu is"), "{error}");
            assert!(error.ends_with("needs finite times that grow"), "{error}");
        }
        assert!(!fs::read_to_string(&path).unwrap().contains("a.vtu"));
    }
}
