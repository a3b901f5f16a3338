//! What a setup says of a body in the plane alone.

use ligament_analysis::Component;
use ligament_analysis::probe::PointField;
use ligament_model::horizon::INCLUSION_TOLERANCE;

use super::check::{Checked, Checks, contradiction, positive, require};
use super::{Action, Analysis, Axis, Dim, Displacement, Form, Law, Reading, Setup, Strains};
use crate::body::Origin;
use crate::error::Field;

/// What is wrong with a z axis in the plane.
const NO_Z: &str = "a body in the plane has no z: give \"x\" or \"y\"";

/// What is said of a motion along z or about x or y.
const MOTIONS: &str =
    "a body in the plane moves by `x`, `y` and `rotation`: the others are those of solids";

impl Checks<2> for Dim {
    fn check(setup: &Setup) -> Checked {
        setup.check_in_plane()
    }
}

impl Setup {
    fn check_in_plane(&self) -> Checked {
        positive(
            Field::whole("section").part("thickness"),
            Some(self.thickness()),
        )?;
        self.check_strains_of_bonds()?;
        self.check_rotational_scale()?;
        self.check_precracks()?;
        self.check_closing()?;
        self.check_readings()?;
        self.check_components()
    }

    /// Probes read forces along x and y, and motions that points of the plane have.
    fn check_readings(&self) -> Checked {
        for (index, probe) in self.probes.iter().enumerate() {
            let probed = Field::element("probes", index);
            match probe.reading {
                Reading::Section { component, .. } if component == Axis::Z => {
                    return contradiction(probed.part("component"), NO_Z);
                }
                Reading::Between { component, .. } if !Component::ALL.contains(&component) => {
                    return contradiction(probed.part("component"), MOTIONS);
                }
                Reading::At {
                    field: PointField::Motion(component),
                    ..
                } if !Component::ALL.contains(&component) => {
                    return contradiction(probed.part("field"), MOTIONS);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Points of the plane move along x and y and turn about z.
    fn check_components(&self) -> Checked {
        let reason = MOTIONS;
        let leaves = |given: &Displacement| {
            let beyond = [
                given.z,
                given.rotation_x,
                given.rotation_y,
                given.rotation_z,
            ];
            beyond.iter().any(Option::is_some)
        };
        for (index, support) in self.supports.iter().enumerate() {
            let held = support.held.iter();
            if held.clone().any(|it| !Component::ALL.contains(it))
                || leaves(&support.stiffness.components)
            {
                return contradiction(Field::element("supports", index), reason);
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            if load.profile.is_some_and(|it| it.along == Axis::Z) {
                return contradiction(Field::element("loads", index).part("profile"), NO_Z);
            }
            let action = Field::element("loads", index).part("action");
            match load.action {
                Action::Displacement(it) if leaves(&it) => return contradiction(action, reason),
                Action::ForcePerArea(_) => {
                    let reason =
                        "a body in the plane has curves and no surfaces: give a force per length";
                    return contradiction(action, reason);
                }
                Action::Moment(it) | Action::BodyCouple(it) if it.about[..2] != [0.0; 2] => {
                    let reason = "in the plane couples turn about z alone";
                    return contradiction(action, reason);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Elements with strains of their own need rows and columns, and not all analyses take all of their variants.
    fn check_strains_of_bonds(&self) -> Checked {
        let Law::MbbPd { form, strains } = self.law else {
            return Ok(());
        };
        let law = Field::whole("law");
        let Origin::Lattice(lattice) = self.body.origin() else {
            let reason = "`Law::MbbPd` classes bonds by the rows and columns of a lattice: give `LatticeBody`, or take \
                          another law";
            return contradiction(law, reason);
        };
        let [shorter, longer] = {
            let [dx, dy] = lattice.spacing;
            [dx.min(dy), dx.max(dy)]
        };
        let horizon = self.horizon.at_spacing(shorter);
        if horizon * (1.0 + INCLUSION_TOLERANCE) < longer {
            let reason = format!(
                "`Law::MbbPd` takes strains between neighbours along rows and along columns: make it at least {longer:?} m, the longer side \
                 of the cells (it is {horizon:?} m)"
            );
            return contradiction(Field::whole("horizon"), reason);
        }
        let is_elastic = matches!(self.analysis, Analysis::Elastic { .. });
        if form == Form::Pairwise {
            let reason = if !is_elastic {
                "the printed forces are not those of an energy, so that there is no stiffness whose modes or breakages could be \
                 followed: it is for elastic analyses; take `Form::Full`"
            } else if !self.precracks.is_empty() {
                "the printed factors are those of whole families: it takes no pre-cracks; take `Form::Full`"
            } else if strains == Strains::True {
                "it takes `Strains::Small` alone"
            } else {
                return Ok(());
            };
            return contradiction(law.part("form"), reason);
        }
        let has_steps = matches!(self.analysis, Analysis::Stepped(_));
        if strains == Strains::True && !is_elastic && !has_steps {
            let reason = "true strains are not proportional to the load, as the exact path and modes are: they are for elastic analyses and \
                          load steps; take `Strains::Small`";
            return contradiction(law.part("strains"), reason);
        }
        Ok(())
    }

    fn check_precracks(&self) -> Checked {
        for (index, crack) in self.precracks.iter().enumerate() {
            let field = Field::element("precracks", index).part("points");
            let points = &crack.points;
            require(points.len() >= 2, field, "two points or more", points)?;
            for pair in points.windows(2) {
                let expected = "another point than the one before it";
                require(pair[0] != pair[1], field, expected, pair[1])?;
            }
        }
        Ok(())
    }
}
