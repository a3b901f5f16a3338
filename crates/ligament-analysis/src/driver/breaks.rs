//! Records of bonds that break.

use ligament_model::communicator::Wire;
use ligament_model::element::BondDeformation;
use ligament_model::failure::CriteriaInState;

use crate::bond_numbers::BondNumbers;
use crate::history::BreakRecord;

/// Criteria and the deformations to which they apply.
#[derive(Clone, Copy)]
pub(super) struct CriteriaAtDeformations<'a> {
    pub(super) criteria: &'a CriteriaInState<'a>,
    /// Deformation of a bond, by its index among the breaking bonds and its local number.
    pub(super) deformation: &'a dyn Fn(usize, usize) -> BondDeformation,
}

/// Bonds that are about to break.
pub(super) struct Breaking<'a> {
    /// Ends of all local bonds, shape (n_bonds).
    pub(super) ends: &'a [[u32; 2]],
    pub(super) judged: CriteriaAtDeformations<'a>,
    /// Fields common to all records, with the number of bonds broken before.
    pub(super) moment: BreakRecord,
}

impl Breaking<'_> {
    /// Records of breaking bonds, given by global numbers, in their order. Collective.
    pub(super) fn records(&self, numbers: &BondNumbers, bonds: &[u32]) -> Vec<BreakRecord> {
        let owned = |(place, &number): (usize, &u32)| {
            let bond = numbers.local(number).filter(|&it| numbers.owns(it))?;
            let ends = numbers.subdomain().numbers(self.ends[bond]);
            self.record(place, bond, (number, ends))
        };
        let owned = bonds.iter().enumerate().filter_map(owned);
        let mut records = numbers.subdomain().all_gather_list(owned.collect());
        records.sort_unstable_by_key(|it| it.order);
        records
    }

    /// Record of a bond with a global number and the numbers of its ends in the body, at its index among the breaking bonds.
    fn record(
        &self,
        place: usize,
        bond: usize,
        (number, ends): (u32, [u32; 2]),
    ) -> Option<BreakRecord> {
        let deformation = (self.judged.deformation)(place, bond);
        let verdict = self.judged.criteria.breaking(bond, &deformation)?;
        Some(BreakRecord {
            order: self.moment.order + place + 1,
            bond: number,
            ends,
            criterion: verdict.criterion,
            ratio: verdict.ratio(),
            deformation,
            ..self.moment
        })
    }
}

impl Wire<14> for BreakRecord {
    fn numbers(&self) -> [f64; 14] {
        let [order, step, round, criterion] =
            [self.order, self.step, self.round, self.criterion].map(|it| it as f64);
        let [bond, a, b] = [self.bond, self.ends[0], self.ends[1]].map(f64::from);
        let [stretch, shear, rotation] = self.deformation.strains();
        let Self {
            load_factor,
            displacement,
            reaction,
            ratio,
            ..
        } = *self;
        [
            order,
            step,
            round,
            criterion,
            bond,
            a,
            b,
            load_factor,
            displacement,
            reaction,
            ratio,
            stretch,
            shear,
            rotation,
        ]
    }

    fn from_numbers(numbers: [f64; 14]) -> Self {
        let [order, step, round, criterion, bond, a, b, ..] = numbers.map(|it| it as usize);
        let [
            ..,
            load_factor,
            displacement,
            reaction,
            ratio,
            stretch,
            shear,
            rotation,
        ] = numbers;
        Self {
            order,
            step,
            round,
            criterion,
            bond: bond as u32,
            ends: [a as u32, b as u32],
            load_factor,
            displacement,
            reaction,
            ratio,
            deformation: BondDeformation::new([stretch, shear, rotation]),
        }
    }
}
