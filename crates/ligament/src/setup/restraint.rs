//! Checks of supports and loads with springs, rollers and platens.

use ligament_analysis::Component;
use ligament_model::Advice;

use super::check::{Checked, contradiction, in_range, positive};
use super::conditions::axis_along;
use super::setting::Setting;
use super::{Action, Analysis, Form, Load, Position, Setup, Support};
use crate::error::Field;

impl Support {
    /// Whether the support has springs or an inclined normal.
    pub fn is_restraint(&self) -> bool {
        let mut springs = self.stiffness.along_axes().components();
        self.restrained_normal().is_some() || springs.next().is_some()
    }

    /// Components that springs and inclined normals resist: of a normal all displacements.
    pub fn restrained(&self) -> Vec<Component> {
        let springs = self
            .stiffness
            .along_axes()
            .components()
            .map(|(component, _)| component);
        let normal = self.restrained_normal().map(|_| displacements());
        springs.chain(normal.into_iter().flatten()).collect()
    }

    /// The normal, where it has a spring or is inclined to the axes.
    pub fn restrained_normal(&self) -> Option<Position> {
        let has_spring = self.stiffness.normal.is_some();
        self.normal
            .filter(|it| has_spring || axis_along(it).is_none())
    }
}

impl Load {
    /// Whether the load acts through springs or a platen.
    pub fn is_restraint(&self) -> bool {
        self.stiffness.is_some() || self.tilts
    }

    /// Components that its springs or its platen resist.
    pub fn restrained(&self) -> Vec<Component> {
        let all = self.is_restraint().then(displacements);
        all.into_iter().flatten().collect()
    }
}

/// All displacements.
fn displacements() -> impl Iterator<Item = Component> {
    let all = Component::IN_SPACE.iter().copied();
    all.filter(|it| !it.is_rotation())
}

impl Setup {
    pub(super) fn check_restraints(&self) -> Checked {
        for (index, support) in self.supports.iter().enumerate() {
            let field = Field::element("supports", index);
            check_support(field, support, self.body.dimensions())?;
            if support.is_restraint() {
                self.check_takes_restraints(field)?;
            }
            let has_rotations = self.law.rotational_profile().is_some();
            let mut springs = support.stiffness.along_axes().components();
            if springs.any(|(it, _)| it.is_rotation()) && !has_rotations {
                let reason =
                    "points have no rotations under this law: springs against them act on nothing";
                return contradiction(field.part("stiffness"), reason);
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            let field = Field::element("loads", index);
            check_load(field, load)?;
            if load.is_restraint() {
                self.check_takes_restraints(field)?;
            }
        }
        Ok(())
    }

    fn check_takes_restraints(&self, field: Field) -> Checked {
        if matches!(self.analysis, Analysis::Modal(_)) {
            let reason = "natural modes take only supports with a `displacement`, no springs, inclined rollers or platens";
            return contradiction(field, reason);
        }
        if self.law.options.form == Some(Form::Pairwise) {
            let text =
                "springs, inclined rollers and platens need a stiffness with symmetry: take {}";
            return contradiction(field, Advice::new(text, [Setting::Form(Form::Full)]));
        }
        Ok(())
    }
}

fn check_support(field: Field, support: &Support, dimensions: usize) -> Checked {
    let Support {
        held,
        normal,
        stiffness,
        ..
    } = support;
    in_range(stiffness, |_| field.part("stiffness"))?;
    if let Some(normal) = normal {
        if *normal == [0.0; 3] || !normal.iter().all(|it| it.is_finite()) {
            let reason = format!("must be a direction other than {:?}", vec![0; dimensions]);
            return contradiction(field.part("normal"), reason);
        }
        if held.iter().any(|it| !it.is_rotation()) {
            let reason = "a support holds components of the `displacement` or one direction between them, its `normal`: give one of \
                          the two, or two supports";
            return contradiction(field.part("normal"), reason);
        }
    } else if stiffness.normal.is_some() {
        let reason = "`normal` of the stiffness needs the direction `normal` of the support";
        return contradiction(field.part("stiffness"), reason);
    }
    let mut springs = stiffness.along_axes().components();
    if springs.any(|(component, _)| held.contains(&component)) {
        let reason = "a component is held by `displacement` or by a spring, not by both";
        return contradiction(field.part("stiffness"), reason);
    }
    match support.components().next().is_some() || support.is_restraint() {
        true => Ok(()),
        false => contradiction(
            field,
            "holds nothing: give a `displacement`, a `normal` or a `stiffness`",
        ),
    }
}

fn check_load(field: Field, load: &Load) -> Checked {
    positive(field.part("stiffness"), load.stiffness)?;
    let moves = load.action.motion().is_some_and(|it| it.is_translation());
    if load.stiffness.is_some() && !moves {
        let reason = "only a `displacement` along the axes goes through springs";
        return contradiction(field.part("stiffness"), reason);
    }
    let is_force = matches!(load.action, Action::Force(_));
    if load.tilts && !moves && !is_force {
        let reason = "a platen tilts under a `displacement` along the axes or under a `force`";
        return contradiction(field.part("tilts"), reason);
    }
    if load.tilts && moves && load.profile.is_some() {
        let reason =
            "a platen moves by the mean of its points: a `profile` goes with a `force` alone";
        return contradiction(field.part("tilts"), reason);
    }
    Ok(())
}
