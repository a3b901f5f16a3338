//! What is recorded of bonds that break.

use ligament_model::element::BondDeformation;
use ligament_model::failure::Criteria;

use crate::bond_numbers::BondNumbers;
use crate::history::BreakRecord;

/// Criteria with the deformations that they judge.
#[derive(Clone, Copy)]
pub(super) struct CriteriaAtDeformations<'a> {
    pub(super) criteria: &'a Criteria,
    /// Deformation of a bond by its place among those that break, and the bond.
    pub(super) deformation: &'a dyn Fn(usize, usize) -> BondDeformation,
}

/// Bonds that are about to break.
pub(super) struct Breaking<'a> {
    /// Ends of all bonds that are known here, shape (n_bonds).
    pub(super) ends: &'a [[u32; 2]],
    pub(super) judged: CriteriaAtDeformations<'a>,
    /// What the records have in common, with the number of bonds broken before.
    pub(super) moment: BreakRecord,
}

impl Breaking<'_> {
    /// The records of bonds, in their order.
    pub(super) fn records(&self, bonds: &[u32]) -> Vec<BreakRecord> {
        let placed = bonds.iter().enumerate();
        let records = placed.filter_map(|(place, &bond)| self.record(place, bond as usize, bond));
        records.collect()
    }

    /// The records of bonds by their numbers among all of a body that processes share out: each tells of those that it counts.
    pub(super) fn records_of_all(&self, numbers: &BondNumbers, bonds: &[u32]) -> Vec<BreakRecord> {
        let counted = |(place, &number): (usize, &u32)| {
            let bond = numbers.known(number).filter(|&it| numbers.counts(it))?;
            self.record(place, bond, number)
        };
        let told = bonds.iter().enumerate().filter_map(counted).map(|it| {
            let [a, b] = it.ends.map(f64::from);
            let [stretch, shear, rotation] = it.deformation.strains();
            let (order, number) = (it.order as f64, f64::from(it.bond));
            let criterion = it.criterion as f64;
            [
                order, number, a, b, criterion, it.ratio, stretch, shear, rotation,
            ]
        });
        let told: Vec<[f64; 9]> = told.collect();
        let all = numbers.portion().concatenated(&told).into_iter();
        let mut records: Vec<BreakRecord> = all
            .map(
                |[
                    order,
                    number,
                    a,
                    b,
                    criterion,
                    ratio,
                    stretch,
                    shear,
                    rotation,
                ]| {
                    BreakRecord {
                        order: order as usize,
                        bond: number as u32,
                        ends: [a as u32, b as u32],
                        criterion: criterion as usize,
                        ratio,
                        deformation: BondDeformation::new([stretch, shear, rotation]),
                        ..self.moment
                    }
                },
            )
            .collect();
        records.sort_unstable_by_key(|it| it.order);
        records
    }

    /// The record of a bond with a number, at its place among those that break.
    fn record(&self, place: usize, bond: usize, number: u32) -> Option<BreakRecord> {
        let deformation = (self.judged.deformation)(place, bond);
        let verdict = self.judged.criteria.breaking(bond, &deformation)?;
        Some(BreakRecord {
            order: self.moment.order + place + 1,
            bond: number,
            ends: self.ends[bond],
            criterion: verdict.criterion,
            ratio: verdict.ratio(),
            deformation,
            ..self.moment
        })
    }
}
