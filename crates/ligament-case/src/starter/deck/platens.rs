//! Rigid bodies, couplings and equations of a deck as platens: nodes that follow a reference node.

use ligament_mesh::inp::{Keyword, number};

use super::load::Load;
use super::prescribed::degrees_of_freedom;
use super::translation::{AXES, Kind, Platen, Row, Translation, value};

impl Translation<'_> {
    /// Finds the platens of a deck, before keywords that move them.
    pub(super) fn find_platens(&mut self) {
        let keywords = &self.places.deck.keywords;
        for (keyword, next) in keywords
            .iter()
            .zip(keywords.iter().skip(1).map(Some).chain([None]))
        {
            let spreads = next.is_some_and(|it| it.is("DISTRIBUTING"));
            match keyword.name.as_str() {
                "RIGID BODY" => self.find_platen(
                    keyword,
                    &["NSET", "TIE NSET", "PIN NSET", "ELSET"],
                    Kind::Rigid,
                ),
                "COUPLING" if spreads => self.find_platen(keyword, &["SURFACE"], Kind::Spread),
                "COUPLING" => self.find_platen(keyword, &["SURFACE"], Kind::Rigid),
                "EQUATION" => self.find_tied(keyword),
                _ => {}
            }
        }
        for platen in &mut self.platens {
            platen.nodes.sort_unstable();
            platen.nodes.dedup();
        }
        for keyword in keywords.iter().filter(|it| it.is("BOUNDARY")) {
            for line in &keyword.data {
                let fields = line.fields();
                let held = degrees_of_freedom(&fields).map(|(dofs, _)| dofs);
                let turn = if self.places.dimensions() > 2 {
                    4..=6
                } else {
                    6..=6
                };
                if held.is_some_and(|dofs| turn.clone().any(|dof| dofs.contains(&dof))) {
                    let outside = self.places.find(&fields[0], &keyword.scope).outside;
                    let held = self
                        .platens
                        .iter_mut()
                        .filter(|it| outside.contains(&it.reference));
                    held.for_each(|it| it.is_upright = true);
                }
            }
        }
    }

    fn find_platen(&mut self, keyword: &Keyword, sets: &[&str], kind: Kind) {
        let reference =
            value(keyword, "REF NODE").map(|it| self.places.find(it, &keyword.scope).outside);
        let sets = sets.iter().filter_map(|it| value(keyword, it));
        let nodes = sets.flat_map(|set| self.places.nodes_of(set, &keyword.scope));
        let nodes: Vec<u32> = nodes.collect();
        match reference.unwrap_or_default().as_slice() {
            [reference] if !nodes.is_empty() => self.platens.push(Platen {
                keyword: keyword.clone(),
                reference: *reference,
                kind,
                nodes,
                is_upright: false,
                is_used: false,
            }),
            _ => self.omit(
                keyword,
                "as a platen it needs nodes of the body, and a REF NODE that is none of them",
            ),
        }
    }

    /// Reads equations u_i - u_reference = 0 for the nodes of a set.
    fn find_tied(&mut self, keyword: &Keyword) {
        let fields = keyword.data.iter().flat_map(|line| line.fields());
        let fields: Vec<String> = fields.filter(|it| !it.is_empty()).collect();
        let mut rest = fields.as_slice();
        let mut tied: Vec<(u64, usize, Vec<u32>)> = Vec::new();
        while let [count, terms @ ..] = rest {
            let count = number(count).unwrap_or(0.0) as usize;
            let terms = if count == 2 {
                terms.split_at_checked(6)
            } else {
                None
            };
            let Some((equation, after)) = terms else {
                break;
            };
            let numbers = [1, 2, 4, 5].map(|it| number(&equation[it]).unwrap_or(0.0));
            let [follower, leader] =
                [0, 3].map(|it| self.places.find(&equation[it], &keyword.scope));
            let [dof, a, same, b] = numbers;
            let (&[reference], true) = (leader.outside.as_slice(), a + b == 0.0 && dof == same)
            else {
                break;
            };
            let known = tied
                .iter_mut()
                .find(|it| (it.0, it.1) == (reference, dof as usize));
            match known {
                Some((_, _, nodes)) => nodes.extend(follower.inside),
                None => tied.push((reference, dof as usize, follower.inside)),
            }
            rest = after;
        }
        if !rest.is_empty()
            || tied
                .iter()
                .any(|(_, dof, nodes)| nodes.is_empty() || *dof == 0)
        {
            return self.omit(keyword, "of equations a case has those by which nodes follow a node beside the body: u_i - u = 0");
        }
        self.platens
            .extend(tied.into_iter().map(|(reference, dof, nodes)| Platen {
                keyword: keyword.clone(),
                reference,
                kind: Kind::Tied(dof),
                nodes,
                is_upright: true,
                is_used: false,
            }));
    }

    /// Platens that a reference node moves along an axis, with their nodes.
    fn moved(&mut self, reference: u64, dof: usize) -> Vec<Platen> {
        let follows = |it: &&mut Platen| {
            it.reference == reference && !matches!(it.kind, Kind::Tied(tied) if tied != dof)
        };
        let followers = self.platens.iter_mut().filter(follows);
        followers
            .map(|it| {
                it.is_used = true;
                it.clone()
            })
            .collect()
    }

    /// Moves or holds the platens of reference nodes.
    pub(super) fn move_platens(
        &mut self,
        row: Row<'_>,
        references: &[u64],
        dofs: &[usize],
        size: f64,
    ) {
        let each = references
            .iter()
            .flat_map(|it| dofs.iter().map(move |dof| (*it, *dof)));
        for (reference, dof) in each {
            for platen in self.moved(reference, dof) {
                match AXES[..usize::from(self.places.dimensions())].get(dof - 1) {
                    Some(axis) => self.move_platen(row, platen, axis, size),
                    None if dof > AXES.len() && size != 0.0 => {
                        self.omit_row(row, "a platen is not turned by a given angle");
                    }
                    None => {}
                }
            }
        }
    }

    fn move_platen(&mut self, row: Row<'_>, platen: Platen, axis: &'static str, size: f64) {
        let is_rate =
            value(row.keyword, "TYPE").is_some_and(|it| it.eq_ignore_ascii_case("VELOCITY"));
        let key = if is_rate { "velocity" } else { "displacement" };
        let mut load = Load::new(
            Vec::new(),
            key,
            vec![(axis, 1.0)],
            size * self.units.for_key(key),
        );
        if platen.is_upright || size == 0.0 || self.procedure().is_motion() {
            if !platen.is_upright {
                self.omit_row(row, "the points of this platen do not turn with it");
            }
            return self.prescribe(row, &row.name(), platen.nodes, load);
        }
        let place = self.places.line_of_nodes(&row.name(), platen.nodes);
        load.lines = vec![place, "tilts = true".to_owned()];
        self.add_load(row, load);
    }

    /// Applies the force on a reference node to its platen.
    pub(super) fn force_on_platen(
        &mut self,
        row: Row<'_>,
        reference: u64,
        axis: usize,
        force: f64,
    ) {
        let platens = self.moved(reference, axis + 1);
        if platens.is_empty() {
            self.omit_row(row, "its node is none of the body and of no platen");
        }
        for platen in platens {
            let mut lines = vec![self.places.line_of_nodes(&row.name(), platen.nodes)];
            let is_rigid = platen.kind != Kind::Spread;
            if is_rigid && self.procedure().is_motion() {
                self.omit_row(row, "in a motion the force is spread over the points of its platen, which is not rigid");
            } else if is_rigid {
                lines.push("tilts = true".to_owned());
                if platen.is_upright {
                    self.omit_row(row, "a platen under a force may tilt");
                }
            }
            let size = force * self.units.force;
            self.add_load(
                row,
                Load::new(lines, "force", vec![(AXES[axis], 1.0)], size),
            );
        }
    }

    /// Notes the platens that nothing moves as left out.
    pub(super) fn omit_unused_platens(&mut self) {
        for platen in std::mem::take(&mut self.platens) {
            if !platen.is_used {
                self.omit(
                    &platen.keyword,
                    "nothing moves or loads its reference node: its points are free",
                );
            }
        }
    }
}
