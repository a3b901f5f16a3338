//! Crack lines of a stored run.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use ligament_analysis::result_fields::{DISPLACEMENT, HORIZON, VOLUME};
use ligament_mesh::Cell;
use ligament_model::Canvas;
use ligament_post::OpenedCells;
use ligament_post::crack::{
    CrackLine, CrackOpening, FaceState, Faces, crack_lines, opened_cells, openings, sides_of_cells,
};

use super::columns::is_in_time;
use super::outputs::{OutputKind, Outputs, cut_pairs};
use super::point_fields::location;
use super::softening_table::{self, CrackedBelow};
use super::stored_state::StoredState;
use crate::csv::read::{CsvTable, Row};
use crate::vtu::read::{TAG_NOUNS, VtuFile};
use crate::{Error, FieldLocation, vtu};

/// The faces of a body with the order in which a run opened them.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredCracks {
    /// Thickness of the body, its volume over its area, m.
    pub thickness: f64,
    /// Positions of the points, shape (n_points), m.
    positions: Vec<[f64; 2]>,
    cells: Vec<Cell>,
    faces: Faces,
    /// Horizons, shape (n_points), m.
    horizon: Vec<f64>,
    /// Faces that a pre-crack separates.
    cut: Vec<usize>,
    /// Faces that opened, with the event of opening.
    opened: Vec<(usize, OpeningEvent)>,
    records: Vec<CrackRecord>,
    /// States of which the cracks are known: the rows of the history and the stored states.
    states: Vec<StoredState>,
    /// Whether the run is a motion, whose load factor is the time.
    pub(super) in_time: bool,
}

/// The event from which a face is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OpeningEvent {
    /// Breakage of a bond, by its number in the order of all breakages, from 1.
    Breakage(usize),
    /// Opening of a softening bond in this step.
    Step(usize),
}

/// Columns of a row of the history that concern cracks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackRecord {
    /// Number of the step or event.
    pub step: usize,
    /// Load factor.
    pub load_factor: f64,
    /// Displacement of the first load, m.
    pub displacement: f64,
    /// Force of the first load, N.
    pub reaction: f64,
    /// Energy released by breakages so far, J.
    pub released_energy: f64,
    /// Energy dissipated by bonds so far, J.
    pub dissipated_energy: f64,
    /// Number of broken bonds.
    pub broken_bonds: usize,
}

/// Largest number of records of the history at which cracks are computed.
const MOST_RECORDS: usize = 500;

impl StoredCracks {
    /// Reads the cracks from the folder of a run; bonds that soften are cracked below a tenth of their force.
    ///
    /// # Errors
    ///
    /// As for [`open_below`](Self::open_below).
    pub fn open(folder: &Path) -> Result<Self, Error> {
        Self::open_below(folder, CrackedBelow::default())
    }

    /// Reads the cracks from the folder of a run; bonds that soften are cracked below a share of their force.
    ///
    /// # Errors
    ///
    /// If the folder has no results of a run under loads, or a file cannot be used.
    pub fn open_below(folder: &Path, cracked: CrackedBelow) -> Result<Self, Error> {
        let outputs = Outputs::list(folder)?;
        let first = outputs.files.first_key_value();
        let Some((_, path)) = first.filter(|_| outputs.kind == OutputKind::Steps) else {
            return Err(Error::NoResults {
                path: folder.to_path_buf(),
                reason: "it has natural modes, in which nothing breaks".to_owned(),
            });
        };
        let body = StoredBody::read(path)?;
        let faces = Faces::new(&body.positions, &body.canvas);
        let place = |tags: [i64; 2]| -> Option<usize> {
            let [a, b] = tags.map(|tag| body.places.get(&tag).copied());
            faces.between([a?, b?])
        };
        let cut = cut_pairs(folder)?.unwrap_or_default();
        let breaks = (1..).zip(broken_pairs(folder)?);
        let breaks = breaks.map(|(order, tags)| (tags, OpeningEvent::Breakage(order)));
        let softened = softened_pairs(folder, cracked.event())?.into_iter();
        let softened = softened.map(|(tags, step)| (tags, OpeningEvent::Step(step)));
        let opened = breaks
            .chain(softened)
            .filter_map(|(tags, event)| Some((place(tags)?, event)));
        let history = CsvTable::read(folder.join("history.csv"))?;
        let records = history.rows(CrackRecord::read)?;
        Ok(Self {
            thickness: body.thickness,
            cut: cut.into_iter().filter_map(place).collect(),
            opened: opened.collect(),
            horizon: body.horizon,
            in_time: is_in_time(history.columns()),
            states: known_states(&records, &outputs),
            records,
            positions: body.positions,
            cells: match body.canvas {
                Canvas::Between(cells) => cells,
                Canvas::Around(_) | Canvas::Solid(_) | Canvas::Boxes(_) => Vec::new(),
            },
            faces,
        })
    }

    /// The cracks in a state, or in the last one before it. Pre-cracks are not included, but cracks start there.
    pub fn lines(&self, state: impl Into<StoredState>) -> Vec<CrackLine> {
        let record = record_at(&self.records, state.into());
        record.map_or_else(Vec::new, |it| self.lines_at(&it))
    }

    /// The cracks in the state of a record.
    pub fn lines_at(&self, record: &CrackRecord) -> Vec<CrackLine> {
        crack_lines(&self.faces, &self.face_states(Some(record)), &self.horizon)
    }

    /// The cells between the points of the body, opened along the cracks and the pre-cracks in a state, or in the last one before it.
    pub fn opened_cells(&self, state: impl Into<StoredState>) -> OpenedCells<Cell> {
        opened_cells(
            (&self.positions, &self.cells),
            self.is_separated(state.into()),
        )
    }

    /// Sides of the cracks and the pre-cracks on which the corners of the [cells](Self::cells) lie in a state, or in the last one before
    /// it, shape (n_cells).
    pub fn sides(&self, state: impl Into<StoredState>) -> Vec<[u8; 4]> {
        sides_of_cells(&self.cells, self.is_separated(state.into()))
    }

    /// The cells between the points of the body, in the order of the files; empty for a lattice.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// Whether the face between a pair of points is open in a state, or in the last one before it.
    fn is_separated(&self, state: StoredState) -> impl Fn([u32; 2]) -> bool {
        let record = record_at(&self.records, state);
        let parts = self.face_states(record.as_ref());
        move |pair| {
            let face = self.faces.between(pair);
            face.is_some_and(|it| parts[it] != FaceState::Whole)
        }
    }

    /// State of each face in a record, shape (n_faces); without a record, before the first load.
    fn face_states(&self, record: Option<&CrackRecord>) -> Vec<FaceState> {
        let mut parts = vec![FaceState::Whole; self.faces.len()];
        for &face in &self.cut {
            parts[face] = FaceState::PreCrack;
        }
        for (face, event) in &self.opened {
            if record.is_some_and(|it| it.is_after(*event)) {
                parts[*face] = FaceState::Open;
            }
        }
        parts
    }

    /// The records in which faces opened; if there are very many, an even selection with the last.
    pub fn records_with_growth(&self) -> Vec<&CrackRecord> {
        let open = |record: &CrackRecord| {
            let open = self.opened.iter().filter(|it| record.is_after(it.1));
            open.count()
        };
        records_with_growth(&self.records, open, MOST_RECORDS)
    }

    /// Mean horizon of the points, m.
    pub fn mean_horizon(&self) -> f64 {
        self.horizon.iter().sum::<f64>() / self.horizon.len().max(1) as f64
    }

    /// States of which the cracks are known: the rows of the history and the stored states, ascending.
    pub fn states(&self) -> &[StoredState] {
        &self.states
    }
}

/// States of which the cracks are known: the rows of the history and the stored states, ascending.
pub(super) fn known_states(records: &[CrackRecord], outputs: &Outputs) -> Vec<StoredState> {
    let rows = records.iter().map(|it| StoredState::end(it.step));
    let between = outputs.files.keys().copied();
    let all: BTreeSet<StoredState> = rows
        .chain(between.filter(|it| it.breakages().is_some()))
        .collect();
    all.into_iter().collect()
}

/// The record of a state, or of the last one before it; between breakages that of the step before with the bonds that broke since.
pub(super) fn record_at(records: &[CrackRecord], state: StoredState) -> Option<CrackRecord> {
    let until = records
        .iter()
        .take_while(|it| StoredState::end(it.step) <= state);
    let record = *until.last()?;
    let broken_bonds = record.broken_bonds + state.breakages().unwrap_or(0);
    Some(CrackRecord {
        broken_bonds,
        ..record
    })
}

/// Openings at evenly spread places of a line between two ends (m) in a state with fields, from the points within a mean horizon on both
/// sides.
///
/// # Errors
///
/// If the folder has no results of a body in the plane, or none of the state.
pub fn stored_openings(
    folder: &Path,
    state: StoredState,
    ends: [[f64; 2]; 2],
    samples: usize,
) -> Result<Vec<CrackOpening>, Error> {
    let cracks = StoredCracks::open(folder)?;
    let outputs = Outputs::list(folder)?;
    let Some(path) = outputs.files.get(&state) else {
        return Err(Error::NoResults {
            path: folder.to_path_buf(),
            reason: format!("it has no fields of step {state}"),
        });
    };
    let file = VtuFile::open(path)?;
    let values = file.finite_numbers(location(&file), DISPLACEMENT.name)?;
    // Files have three components in the plane too.
    let displacements: Vec<[f64; 2]> = values.chunks_exact(3).map(|it| [it[0], it[1]]).collect();
    let points = [&cracks.positions[..], &displacements];
    Ok(openings(points, ends, samples, cracks.mean_horizon()))
}

/// The records with more open faces or pairs than before; if there are more than `most`, an even selection with the last.
pub(super) fn records_with_growth(
    records: &[CrackRecord],
    open: impl Fn(&CrackRecord) -> usize,
    most: usize,
) -> Vec<&CrackRecord> {
    let mut before = 0;
    let mut records_with_growth: Vec<&CrackRecord> = Vec::new();
    for record in records {
        let now = open(record);
        if now > before {
            records_with_growth.push(record);
        }
        before = now;
    }
    let stride = records_with_growth.len().div_ceil(most).max(1);
    let last = records_with_growth.len().saturating_sub(1);
    let numbered = records_with_growth.into_iter().enumerate();
    let chosen = numbered.filter(|(place, _)| (last - place).is_multiple_of(stride));
    chosen.map(|(_, record)| record).collect()
}

impl CrackRecord {
    /// Whether the record's state is after a event. On the exact path the state precedes the breakages of its event.
    pub(super) fn is_after(&self, event: OpeningEvent) -> bool {
        match event {
            OpeningEvent::Breakage(order) => order <= self.broken_bonds,
            OpeningEvent::Step(step) => step <= self.step,
        }
    }

    pub(super) fn read(row: Row<'_>) -> Result<Self, Error> {
        Ok(Self {
            step: row.value("step")?,
            load_factor: row.number("load_factor")?,
            displacement: row.number("displacement")?,
            reaction: row.number("reaction")?,
            released_energy: row.number("released_energy")?,
            dissipated_energy: row.number("dissipated_energy")?,
            broken_bonds: row.value("broken_bonds")?,
        })
    }
}

/// Tags of the ends of the broken bonds, in the order of breaking.
pub(super) fn broken_pairs(folder: &Path) -> Result<Vec<[i64; 2]>, Error> {
    let Some(sheet) = table(&folder.join("breaks.csv"))? else {
        return Ok(Vec::new());
    };
    let columns = columns_of_ends(&sheet);
    sheet.rows(|row| tag_pair(row, &columns))
}

/// Tags of the ends of the softening bonds with an event in the table of softening, and the step of the event.
pub(super) fn softened_pairs(folder: &Path, event: &str) -> Result<Vec<([i64; 2], usize)>, Error> {
    let Some(sheet) = table(&folder.join(softening_table::FILE))? else {
        return Ok(Vec::new());
    };
    let columns = columns_of_ends(&sheet);
    let rows = sheet.rows(|row| {
        let is_sought = row.value::<String>("event")? == event;
        Ok(is_sought.then_some((tag_pair(row, &columns)?, row.value("step")?)))
    })?;
    Ok(rows.into_iter().flatten().collect())
}

fn table(path: &Path) -> Result<Option<CsvTable>, Error> {
    path.is_file().then(|| CsvTable::read(path)).transpose()
}

/// Tags of the ends of the bond of a row, from the columns that hold them.
pub(super) fn tag_pair(row: Row<'_>, [a, b]: &[String; 2]) -> Result<[i64; 2], Error> {
    Ok([row.value(a)?, row.value(b)?])
}

/// Names of the columns with the tags of the ends of bonds in a table.
pub fn columns_of_ends(sheet: &CsvTable) -> [String; 2] {
    let has = |tagged: &&str| {
        sheet
            .columns()
            .iter()
            .any(|it| *it == format!("{tagged}_a"))
    };
    let tagged = TAG_NOUNS.into_iter().find(has).unwrap_or(TAG_NOUNS[0]);
    ["a", "b"].map(|end| format!("{tagged}_{end}"))
}

/// A body in the plane, read from a file of fields.
struct StoredBody {
    positions: Vec<[f64; 2]>,
    canvas: Canvas,
    /// Horizons, shape (n_points), m.
    horizon: Vec<f64>,
    thickness: f64,
    /// Indices of the points by their tags.
    places: HashMap<i64, u32>,
}

impl StoredBody {
    fn read(path: &Path) -> Result<Self, Error> {
        let file = VtuFile::open(path)?;
        let corners = file.points_in_plane()?;
        let cells: Option<Vec<Cell>> = file.cells()?.iter().map(vtu::Cell::planar).collect();
        let cells =
            cells.ok_or_else(|| file.malformed("its cells are no triangles or quadrangles"))?;
        let area: f64 = cells.iter().map(|cell| cell.area(&corners).abs()).sum();
        let location = location(&file);
        let (positions, canvas) = if location == FieldLocation::Point {
            (corners, Canvas::Between(cells))
        } else {
            let (positions, squares) = squares(&cells, &corners);
            (positions, Canvas::Around(squares))
        };
        let volumes = file.finite_numbers(location, VOLUME.name)?;
        let (_, tags) = file.tags(location)?;
        Ok(Self {
            positions,
            canvas,
            horizon: file.finite_numbers(location, HORIZON.name)?,
            thickness: volumes.iter().sum::<f64>() / area,
            places: tags.into_iter().zip(0..).collect(),
        })
    }
}

/// Midpoints and corners of the quadrangles of a lattice.
fn squares(cells: &[Cell], corners: &[[f64; 2]]) -> (Vec<[f64; 2]>, Vec<[[f64; 2]; 4]>) {
    let squares: Vec<[[f64; 2]; 4]> = (cells.iter())
        .filter_map(|cell| match cell {
            Cell::Quadrangle(numbers) => Some(numbers.map(|it| corners[it as usize])),
            Cell::Triangle(_) => None,
        })
        .collect();
    let middle = |square: &[[f64; 2]; 4]| {
        [0, 1].map(|axis| square.iter().map(|it| it[axis]).sum::<f64>() / 4.0)
    };
    (squares.iter().map(middle).collect(), squares)
}
