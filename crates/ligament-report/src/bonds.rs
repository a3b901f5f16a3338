//! Bonds of a run: ends, factors, limits, largest utilisations, and steps of breaking.

use std::collections::HashMap;

use ligament_output::results::stored::{StoredCriterion, StoredRun};

use crate::body::Body;
use crate::columns::{Column, Digits};

/// Digits of factors, limits and utilisations.
const DIGITS: u32 = 4;

/// Bonds as columns, in the order of their first and second ends.
#[derive(Debug)]
pub(crate) struct Bonds {
    /// Number of pairs, bonds and absent bonds.
    pub(crate) count: usize,
    /// Ends by their indices in the page, the smaller one first; required by all other columns.
    pub(crate) ends: [Column; 2],
    /// Columns by name, the most important ones first.
    pub(crate) columns: Vec<(String, Column)>,
    /// Broken bonds in the order of breaking: index of the bond, step, round, index of the criterion.
    pub(crate) breaks: [Vec<i64>; 4],
    /// Utilisations at breaking, in the order of breaking.
    pub(crate) utilisation_at_break: Vec<f64>,
    /// Names of the criteria.
    pub(crate) criteria: Vec<String>,
}

impl Bonds {
    /// The bonds of a stored run with the points of a body.
    pub(crate) fn new(run: &StoredRun, body: &Body) -> Self {
        let places: HashMap<i64, u32> = body.tags.iter().copied().zip(0..).collect();
        let model = &run.model;
        let place = |end: u32| {
            let tag = model.tags[end as usize];
            places.get(&tag).copied().unwrap_or_default()
        };
        let sorted = |ends: [u32; 2]| {
            let [a, b] = ends.map(place);
            [a.min(b), a.max(b)]
        };
        let mut pairs: Vec<([u32; 2], usize)> = (model.bonds.ends.iter().enumerate())
            .map(|(pair, ends)| (sorted(*ends), pair))
            .collect();
        pairs.sort_unstable();
        let order: Vec<usize> = pairs.iter().map(|it| it.1).collect();
        let ends =
            [0, 1].map(|end| Column::whole_numbers(pairs.iter().map(|it| i64::from(it.0[end]))));
        let criteria: Vec<String> = model.criteria.iter().map(|it| it.name.clone()).collect();
        let (breaks, utilisation_at_break) = breaks(run, &places, &pairs);
        Self {
            count: pairs.len(),
            ends,
            columns: columns(run, &order),
            breaks,
            utilisation_at_break,
            criteria,
        }
    }

    /// Number of characters of the ends in a page.
    pub(crate) fn n_characters(&self) -> usize {
        self.ends.iter().map(Column::n_characters).sum()
    }
}

/// The columns of the bonds in an order.
fn columns(run: &StoredRun, order: &[usize]) -> Vec<(String, Column)> {
    let bonds = &run.model.bonds;
    let number = |values: &[f64]| {
        let values: Vec<f64> = order.iter().map(|it| values[*it]).collect();
        Column::single(&values, Digits::OfLargest(DIGITS))
    };
    let whole = |values: &[i64]| Column::whole_numbers(order.iter().map(|it| values[*it]));
    let absent: Vec<i64> = (bonds.absence.iter())
        .map(|it| it.map_or(0, |it| it.number()))
        .collect();
    let mut columns = vec![("absent".to_owned(), whole(&absent))];
    if let Some(largest) = &run.model.largest {
        columns.push(("utilisation".to_owned(), number(&largest.utilisation)));
        columns.push(("step_of_largest".to_owned(), whole(&largest.step)));
        columns.push(("criterion_of_largest".to_owned(), whole(&largest.criterion)));
    }
    for StoredCriterion { name, limit, .. } in &run.model.criteria {
        columns.push((format!("limit.{name}"), number(limit)));
    }
    columns
}

/// The broken bonds in the order of breaking, by their indices among the sorted pairs.
fn breaks(
    run: &StoredRun,
    places: &HashMap<i64, u32>,
    pairs: &[([u32; 2], usize)],
) -> ([Vec<i64>; 4], Vec<f64>) {
    let mut found: [Vec<i64>; 4] = Default::default();
    let mut utilisation = Vec::new();
    for broke in &run.breaks {
        let [Some(a), Some(b)] = broke.tags.map(|tag| places.get(&tag).copied()) else {
            continue;
        };
        let ends = [a.min(b), a.max(b)];
        let Ok(bond) = pairs.binary_search_by_key(&ends, |it| it.0) else {
            continue;
        };
        let criteria = &run.model.criteria;
        let criterion = criteria.iter().position(|it| it.name == broke.criterion);
        let row = [
            bond,
            broke.at.step,
            broke.round,
            criterion.unwrap_or_default(),
        ];
        for (column, value) in found.iter_mut().zip(row) {
            column.push(value as i64);
        }
        utilisation.push(broke.utilisation);
    }
    (found, utilisation)
}
