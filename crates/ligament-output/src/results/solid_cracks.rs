//! Crack surfaces of a stored run of a solid.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use ligament_analysis::result_fields::HORIZON;
use ligament_post::surfaces::{
    CrackSurface, Link, Links, Tetrahedra, crack_surface, sides_of_tetrahedra,
};

use super::columns::is_in_time;
use super::cracks::{
    CrackRecord, OpeningEvent, broken_pairs, known_states, record_at, records_with_growth,
    softened_pairs,
};
use super::outputs::{OutputKind, Outputs, bonded_pairs, cut_pairs};
use super::softening_table::CrackedBelow;
use super::solid_body::{SolidBody, is_solid};
use super::stored_state::StoredState;
use crate::Error;
use crate::csv::read::CsvTable;
use crate::vtu::read::VtuFile;

/// A solid with the order in which a run separated its points.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidCracks {
    /// The body, with its cells or boxes.
    pub body: SolidBody,
    /// Tetrahedra that are cut at some time.
    pub(super) tetrahedra: Tetrahedra,
    /// Connections of the pairs of points that are not bonded before the first load.
    at_first: Links,
    /// Separated pairs, with the event and the step of separation, in their order.
    opened: Vec<([u32; 2], OpeningEvent, usize)>,
    /// Rows of the history.
    pub(super) records: Vec<CrackRecord>,
    /// States of which the cracks are known: the rows of the history and the stored states.
    states: Vec<StoredState>,
    /// Whether the run is a motion, whose load factor is the time.
    pub(super) in_time: bool,
    /// Mean horizon of the points, m.
    mean_horizon: f64,
}

/// Largest number of records of the history at which the surface is computed.
const MOST_RECORDS: usize = 200;

/// Whether the body of a run is a solid.
///
/// # Errors
///
/// If the folder has no results, or its first output cannot be read.
pub fn has_solid(folder: &Path) -> Result<bool, Error> {
    let outputs = Outputs::list(folder)?;
    match outputs.files.first_key_value() {
        Some((_, path)) => is_solid(&VtuFile::open(path)?),
        None => Ok(false),
    }
}

impl SolidCracks {
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
    /// If the folder has no results of a solid under loads, or a file cannot be used.
    pub fn open_below(folder: &Path, cracked: CrackedBelow) -> Result<Self, Error> {
        let outputs = Outputs::list(folder)?;
        let first = outputs.files.first_key_value();
        let Some((_, path)) = first.filter(|_| outputs.kind == OutputKind::Steps) else {
            return Err(Error::NoResults {
                path: folder.to_path_buf(),
                reason: "it has natural modes, in which nothing breaks".to_owned(),
            });
        };
        let file = VtuFile::open(path)?;
        let body = SolidBody::read(&file)?;
        let horizon = file.finite_numbers(body.location, HORIZON.name)?;
        let history = CsvTable::read(folder.join("history.csv"))?;
        let records = history.rows(CrackRecord::read)?;
        let opened = separated_pairs((folder, cracked), &body, &records)?;
        let cut = cut_pairs(folder)?.unwrap_or_default();
        let cut: Vec<[u32; 2]> = cut.into_iter().filter_map(|it| body.points(it)).collect();
        let parted: HashSet<[u32; 2]> = (opened.iter().map(|it| it.0))
            .chain(cut.iter().copied())
            .map(ascending)
            .collect();
        let tetrahedra = Tetrahedra::new(&body.grid).with_edges(|pair| parted.contains(&pair));
        let mut at_first =
            edges_without_bond(&tetrahedra, edges_with_bond(folder, &body, &tetrahedra)?);
        for pair in cut {
            at_first.name(pair, Link::PreCrack);
        }
        Ok(Self {
            mean_horizon: horizon.iter().sum::<f64>() / horizon.len().max(1) as f64,
            body,
            tetrahedra,
            at_first,
            opened,
            states: known_states(&records, &outputs),
            records,
            in_time: is_in_time(history.columns()),
        })
    }

    /// Links of the points in a state, or in the last one before it.
    pub fn links(&self, state: impl Into<StoredState>) -> Links {
        let mut links = self.at_first.clone();
        if let Some(record) = record_at(&self.records, state.into()) {
            let open = self.opened.iter().filter(|it| record.is_after(it.1));
            open.for_each(|(pair, ..)| links.name(*pair, Link::Open));
        }
        links
    }

    /// The smoothed crack surface in a state.
    pub fn surface(&self, state: impl Into<StoredState>) -> CrackSurface {
        crack_surface(&self.tetrahedra, &self.links(state)).smoothed()
    }

    /// Sides of the crack on which the corners of the [tetrahedra](Self::tetrahedra) lie in a state, shape (n_tetrahedra).
    pub fn sides(&self, state: impl Into<StoredState>) -> Vec<[u8; 4]> {
        sides_of_tetrahedra(&self.tetrahedra, &self.links(state))
    }

    /// Tetrahedra that are cut at some time.
    pub fn tetrahedra(&self) -> &Tetrahedra {
        &self.tetrahedra
    }

    /// Opening and sliding at each vertex of a surface for displacements of the points (n_points, m), shape (n_places), m: jumps normal and
    /// tangential to the surface, averaged over the pairs separated there; positive openings separate.
    pub fn jumps(&self, surface: &CrackSurface, displacement: &[[f64; 3]]) -> Vec<[f64; 2]> {
        let positions = &self.body.grid.positions;
        let places = surface.parted.iter().zip(surface.normals());
        let of_place = |(pairs, normal): (&Vec<[u32; 2]>, [f64; 3])| {
            let along = |vector: [f64; 3]| -> f64 { (0..3).map(|k| vector[k] * normal[k]).sum() };
            let of_pair = |pair: &[u32; 2]| {
                let [a, b] = pair.map(|it| it as usize);
                let less = |of: &[[f64; 3]]| [0, 1, 2].map(|k| of[b][k] - of[a][k]);
                let (jump, from) = (less(displacement), less(positions));
                let across = along(jump);
                let square: f64 = jump.iter().map(|it| it * it).sum();
                let opening = if along(from) < 0.0 { -across } else { across };
                [opening, (square - across * across).max(0.0).sqrt()]
            };
            let count = pairs.len() as f64;
            let all: Vec<[f64; 2]> = pairs.iter().map(of_pair).collect();
            [0, 1].map(|place| all.iter().map(|it| it[place]).sum::<f64>() / count)
        };
        places.map(of_place).collect()
    }

    /// Step in which each pair separated.
    pub(super) fn steps_of_separation(&self) -> HashMap<[u32; 2], usize> {
        let opened = self.opened.iter().rev();
        opened.map(|(pair, _, step)| (*pair, *step)).collect()
    }

    /// The records with newly separated pairs; if there are very many, an even selection with the last.
    pub fn records_with_growth(&self) -> Vec<&CrackRecord> {
        let open = |record: &CrackRecord| {
            let open = self.opened.iter().filter(|it| record.is_after(it.1));
            open.count()
        };
        records_with_growth(&self.records, open, MOST_RECORDS)
    }

    /// Mean horizon of the points, m.
    pub fn mean_horizon(&self) -> f64 {
        self.mean_horizon
    }

    /// States of which the cracks are known: the rows of the history and the stored states, ascending.
    pub fn states(&self) -> &[StoredState] {
        &self.states
    }
}

/// Separated pairs in their order, with the event and the step of separation.
fn separated_pairs(
    (folder, cracked): (&Path, CrackedBelow),
    body: &SolidBody,
    records: &[CrackRecord],
) -> Result<Vec<([u32; 2], OpeningEvent, usize)>, Error> {
    let breaks = (1..).zip(broken_pairs(folder)?);
    let breaks = breaks.map(|(order, tags)| (tags, OpeningEvent::Breakage(order)));
    let softened = softened_pairs(folder, cracked.event())?.into_iter();
    let softened = softened.map(|(tags, step)| (tags, OpeningEvent::Step(step)));
    let mut opened = Vec::new();
    for (tags, event) in breaks.chain(softened) {
        let step = match event {
            OpeningEvent::Step(step) => step,
            // During a run, broken bonds of a step may be written before the step's row.
            OpeningEvent::Breakage(_) => records
                .iter()
                .find(|it| it.is_after(event))
                .map_or(0, |it| it.step),
        };
        if let Some(pair) = body.points(tags) {
            opened.push((ascending(pair), event, step));
        }
    }
    Ok(opened)
}

/// The edges of tetrahedra that are bonds; `None` where the run wrote no model.
fn edges_with_bond(
    folder: &Path,
    body: &SolidBody,
    tetrahedra: &Tetrahedra,
) -> Result<Option<HashSet<[u32; 2]>>, Error> {
    if tetrahedra.corners.is_empty() {
        return Ok(None);
    }
    let bonds = bonded_pairs(folder)?;
    Ok(bonds.map(|bonds| {
        let pairs = bonds.into_iter().filter_map(|tags| body.points(tags));
        pairs.map(ascending).collect()
    }))
}

/// The edges of tetrahedra that are not bonds.
fn edges_without_bond(tetrahedra: &Tetrahedra, bonds: Option<HashSet<[u32; 2]>>) -> Links {
    let mut links = Links::default();
    let Some(bonds) = bonds else {
        return links;
    };
    for corners in &tetrahedra.corners {
        let points = corners.map(|node| tetrahedra.points[node as usize]);
        for (place, a) in points.iter().enumerate() {
            for b in &points[place + 1..] {
                if a != b && !bonds.contains(&ascending([*a, *b])) {
                    links.name([*a, *b], Link::Unbonded);
                }
            }
        }
    }
    links
}

fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
