//! Checks that the settings of a setup exist in the dimension of its body and suit its law.

use ligament_analysis::Component;
use ligament_analysis::probe::PointReading;
use ligament_model::horizon::INCLUSION_TOLERANCE;
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::law::{BondLaw, laws_with, listed, orthotropic};
use ligament_model::material::Space;
use ligament_model::stress::tip_field::TipQuantity;
use ligament_model::tensor::SymTensor;
use ligament_model::{Advice, ElementKind, StressAcrossPlane};

use super::check::{Checked, contradiction, positive, require, within};
use super::setting::Setting;
use super::{
    Action, Analysis, CorrectionDomain, CrackShape, Displacement, Form, Place, Position, Profile,
    Reading, Section, Setup, Strains, Support, Tip,
};
use crate::body::Origin;
use crate::error::Field;

/// Message about a z axis in the plane.
pub(super) const NO_Z: &str = "a body in the plane has no z: give \"x\" or \"y\"";

/// Message about a component of the stress that bodies in the plane do not have.
const ONLY_OF_SOLIDS: &str = "a body in the plane has no such component of the stress: xx, yy, zz and xy, and the principal values 1 and 2";

/// Message about what follows from the stress across a plane.
const UNKNOWN_ACROSS: &str = "in plane strain the stress across the plane is known of isotropic materials alone: take stress.xx, .yy, .xy or stress_principal";

/// Message about a component of the strain that bodies in the plane do not have.
const NO_STRAIN_ACROSS: &str = "of a body in the plane the strains xx, yy and xy are read";

/// Reason why a probe cannot read a quantity at the tip of a pre-crack.
fn unread_at_tip(tip: Tip, dimensions: usize) -> Option<&'static str> {
    let is_solid = dimensions > 2;
    match tip.quantity {
        _ if is_solid && tip.growing => Some(
            "only the tip of a crack in the plane can be `growing`: read the front of the pre-crack without it",
        ),
        TipQuantity::Advance if !tip.growing => {
            Some("only a `growing` tip has an \"advance\": add growing = true")
        }
        TipQuantity::Tearing if !is_solid => {
            Some("a crack in the plane has no K_III: read \"J\", \"K_I\" or \"K_II\"")
        }
        _ if !is_solid && tip.front_length.is_some() => {
            Some("only the pre-crack of a solid has a front: remove `front_length`")
        }
        _ => None,
    }
}

/// Message about a component of motion that points in a space do not have.
fn no_motion(space: Space, is_field: bool) -> &'static str {
    match space {
        Space::Plane(_) => {
            "a body in the plane moves by `x`, `y` and `rotation`: the others are those of solids"
        }
        Space::Solid if is_field => {
            "a solid turns about three axes: give `rotation.x`, `rotation.y` or `rotation.z`"
        }
        Space::Solid => {
            "a solid turns about three axes: give `rotation_x`, `rotation_y` or `rotation_z`"
        }
    }
}

impl Setup {
    /// Number of dimensions of the body.
    pub(crate) fn dimensions(&self) -> usize {
        self.body.dimensions()
    }

    /// Components of the motion of a point that turns.
    fn components(&self) -> &'static [Component] {
        Component::in_dimensions(self.dimensions())
    }

    pub(super) fn check_dimension(&self) -> Checked {
        let is_plane = matches!(self.section, Section::Plane { .. });
        if is_plane != (self.dimensions() == 2) {
            let reason = "a body in the plane has `Section::Plane`, one in space `Section::Solid`";
            return contradiction(Field::whole("section"), reason);
        }
        let thickness = Field::whole("section").part("thickness");
        positive(thickness, Some(self.thickness()))?;
        self.check_law()?;
        self.check_strains_of_bonds()?;
        self.check_rotational_scale()?;
        self.check_precracks()?;
        self.check_closing()?;
        self.check_readings()?;
        self.check_components()?;
        self.check_positions()
    }

    fn check_law(&self) -> Checked {
        let space = self.space();
        let field = Field::whole("law");
        if !self.law.row.exists_in(space) {
            let reason = format!(
                "\"{}\" is a law of the plane: solids take {}",
                self.law.name(),
                listed(&laws_with(|it| it.exists_in(space)), BondLaw::quoted)
            );
            return contradiction(field, reason);
        }
        if let Some(option) = self.law.misplaced_option() {
            let text = "{} leaves other options open: choose what its row has, and that alone";
            let law = Setting::Law(vec![self.law.row]);
            return contradiction(field.part(option), Advice::new(text, [law]));
        }
        Ok(())
    }

    /// Checks the size of the rotational stiffness against law and materials.
    fn check_rotational_scale(&self) -> Checked {
        let (field, scale) = (Field::whole("rotational_scale"), self.rotational_scale);
        let law = self.law.name();
        match (self.law.rotational_profile(), scale) {
            (_, RotationalScale::Factor(1.0)) => return Ok(()),
            (None, _) => {
                let reason = format!(
                    "the points of \"{law}\" have no rotations, so that nothing resists them: take {}",
                    listed(&laws_with(|it| it.shear_form.is_some()), BondLaw::quoted)
                );
                return contradiction(field, reason);
            }
            (Some(profile), _) if profile.rotational == RotationalStiffness::Zero => {
                let text = "there is no rotational stiffness to scale: take {}";
                let decaying = Setting::RotationalStiffness(RotationalStiffness::Decaying);
                return contradiction(field, Advice::new(text, [decaying]));
            }
            _ => {}
        }
        match scale {
            RotationalScale::Factor(factor) => {
                within(RotationalScale::FACTOR, field.part("factor"), factor)
            }
            RotationalScale::CosseratLength(length) => {
                within(RotationalScale::LENGTH, field.part("length"), length)?;
                self.check_coupling(field.part("length"))
            }
        }
    }

    /// Refuses a negative shear stiffness with a positive rotational stiffness: waves of rotation of some wave length would have no energy.
    fn check_coupling(&self, field: Field) -> Checked {
        let of_bonds = self.of_bonds();
        let setup = of_bonds.as_ref().unwrap_or(self);
        let elasticities = setup.materials.iter().map(|it| &it.material.elasticity);
        let least = elasticities.map(|it| orthotropic::smallest_shear(it, self.plane()));
        let least = least.fold(f64::INFINITY, f64::min);
        if least < 0.0 {
            let reason = format!(
                "the shear stiffness of some bonds is negative (k_t H^3 t = {least:.4e} Pa), and a length makes their rotational \
                 stiffness positive, so that waves of rotation would cost nothing: take a factor, whose sign is that of the shear \
                 stiffness, or a smaller Poisson's ratio"
            );
            return contradiction(field, reason);
        }
        Ok(())
    }

    /// Checks closing faces against law and correction.
    fn check_closing(&self) -> Checked {
        let friction = Field::whole("closing_friction");
        within(Self::CLOSING_FRICTION, friction, self.closing_friction)?;
        if self.closing_friction > 0.0 && !self.closing {
            let reason =
                "faces that do not close carry no pressure, and so no friction: let them close";
            return contradiction(friction, reason);
        }
        if !self.closing {
            return Ok(());
        }
        let field = Field::whole("closing");
        let law = self.law.name();
        if self.law.element() != ElementKind::Beam {
            let reason = format!(
                "faces can slide on each other without turning moments only where points turn, and those of \"{law}\" do not: take {}",
                listed(&laws_with(|it| it.shear_form.is_some()), BondLaw::quoted)
            );
            return contradiction(field, reason);
        }
        let cut_first = self.correction.domain == CorrectionDomain::Cracked;
        if cut_first && !self.precracks.is_empty() {
            let text = "the bonds that pre-cracks cut have the stiffness of the whole body when their faces close: take {}";
            let whole = Setting::Domain(CorrectionDomain::Whole);
            return contradiction(field, Advice::new(text, [whole]));
        }
        Ok(())
    }

    /// Refuses probes along axes, or of components, that the body does not have.
    fn check_readings(&self) -> Checked {
        let components = self.components();
        for (index, probe) in self.probes.iter().enumerate() {
            let probed = Field::element("probes", index);
            let (component, part) = match probe.reading {
                Reading::Section { component, .. } if component.number() >= self.dimensions() => {
                    return contradiction(probed.part("component"), NO_Z);
                }
                Reading::Between { component, .. } => (component, "component"),
                Reading::Force { component, .. } => (component, "component"),
                Reading::Tip(tip) => {
                    if let Some(reason) = unread_at_tip(tip, self.dimensions()) {
                        return contradiction(probed.part("reading"), reason);
                    }
                    continue;
                }
                Reading::At { field, .. } | Reading::Mean { field, .. } => match field.reading {
                    PointReading::Motion(component) => (component, "field"),
                    _ if self.dimensions() > 2 => continue,
                    _ => match self.unread_in_plane(&field.reading) {
                        Some(reason) => return contradiction(probed.part("field"), reason),
                        None => continue,
                    },
                },
                Reading::Section { .. } => continue,
            };
            if !components.contains(&component) {
                return contradiction(probed.part(part), no_motion(self.space(), part == "field"));
            }
        }
        Ok(())
    }

    /// Reason why a probe cannot read a stress or a strain of a body in the plane.
    fn unread_in_plane(&self, reading: &PointReading) -> Option<&'static str> {
        match *reading {
            PointReading::MaterialStress {
                in_plane: false, ..
            } => Some(ONLY_OF_SOLIDS),
            PointReading::MaterialStress {
                read, component, ..
            } => {
                let is_unknown = self.stress_across_plane() == StressAcrossPlane::Unknown;
                let reads_across = || read(&[0.0, 0.0, 0.0, f64::NAN])[component].is_nan();
                (is_unknown && reads_across()).then_some(UNKNOWN_ACROSS)
            }
            PointReading::Strain(component) => {
                (component as usize >= SymTensor::<2>::NAMES.len()).then_some(NO_STRAIN_ACROSS)
            }
            _ => None,
        }
    }

    /// Whether a vector or a position of a body in the plane has a z coordinate other than zero.
    pub(super) fn leaves_plane(&self, vector: &Position) -> bool {
        self.dimensions() == 2 && vector[2] != 0.0
    }

    /// Refuses positions with a z coordinate in a body in the plane.
    fn check_positions(&self) -> Checked {
        let is_off = |place: &Place| match place {
            Place::At(position) => self.leaves_plane(position),
            Place::Everywhere | Place::Group(_) | Place::Box(_) => false,
        };
        let supports = self.supports.iter().map(|it| ("supports", &it.place));
        let loads = self.loads.iter().map(|it| ("loads", &it.place));
        for places in [supports.collect::<Vec<_>>(), loads.collect()] {
            for (index, (list, place)) in places.into_iter().enumerate() {
                if is_off(place) {
                    return contradiction(Field::element(list, index).part("place"), NO_Z);
                }
            }
        }
        for (index, probe) in self.probes.iter().enumerate() {
            let positions = match &probe.reading {
                Reading::Section { line, .. } => line,
                Reading::Tip(tip) => std::slice::from_ref(&tip.position),
                reading => reading.positions(),
            };
            if positions.iter().any(|it| self.leaves_plane(it)) {
                return contradiction(Field::element("probes", index).part("reading"), NO_Z);
            }
        }
        let leans = |it: &Support| it.normal.is_some_and(|normal| self.leaves_plane(&normal));
        match self.supports.iter().position(leans) {
            Some(index) => contradiction(Field::element("supports", index).part("normal"), NO_Z),
            None => Ok(()),
        }
    }

    /// Refuses supports and loads on components that the points do not have.
    fn check_components(&self) -> Checked {
        let (components, reason) = (self.components(), no_motion(self.space(), false));
        let leaves = |given: &Displacement| {
            let mut given = given.components();
            given.any(|(component, _)| !components.contains(&component))
        };
        for (index, support) in self.supports.iter().enumerate() {
            let mut held = support.held.iter();
            if held.any(|it| !components.contains(it)) || leaves(&support.stiffness.along_axes()) {
                return contradiction(Field::element("supports", index), reason);
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            let field = Field::element("loads", index);
            if let Some(Profile::Linear { along, .. }) = &load.profile
                && along.number() >= self.dimensions()
            {
                return contradiction(field.part("profile"), NO_Z);
            }
            let action = field.part("action");
            if load.action.motion().is_some_and(|it| leaves(&it)) {
                return contradiction(action, reason);
            }
            match load.action {
                Action::Force(it)
                | Action::ForcePerLength(it)
                | Action::BodyForce(it)
                | Action::Acceleration(it)
                    if self.leaves_plane(&it) =>
                {
                    return contradiction(action, NO_Z);
                }
                Action::ForcePerArea(_) if self.dimensions() == 2 => {
                    let reason =
                        "a body in the plane has curves and no surfaces: give a force per length";
                    return contradiction(action, reason);
                }
                Action::Moment(it) | Action::BodyCouple(it)
                    if self.dimensions() == 2 && it.about[..2] != [0.0; 2] =>
                {
                    let reason = "in the plane couples turn about z alone";
                    return contradiction(action, reason);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Refuses elements with strains of their own (`mbb-pd`) off a lattice, and with settings that they do not support.
    fn check_strains_of_bonds(&self) -> Checked {
        let (row, options) = (self.law.row, self.law.options);
        if !row.needs_lattice {
            return Ok(());
        }
        let (law, name) = (Field::whole("law"), Setting::Law(vec![row]));
        let Origin::Lattice(lattice) = self.body.origin() else {
            let text = "{} classes bonds by the rows and columns of a lattice: give {}, or take another law";
            return contradiction(law, Advice::new(text, [name, Setting::Lattice]));
        };
        let [shorter, longer] = {
            let [dx, dy] = lattice.spacing;
            [dx.min(dy), dx.max(dy)]
        };
        let horizon = self.horizon.at_spacing(shorter);
        if horizon * (1.0 + INCLUSION_TOLERANCE) < longer {
            let text = format!(
                "{{}} takes strains between neighbours along rows and along columns: make it at least {longer:?} m, the longer side \
                 of the cells (it is {horizon:?} m)"
            );
            return contradiction(Field::whole("horizon"), Advice::new(text, [name]));
        }
        let is_elastic = matches!(self.analysis, Analysis::Elastic { .. });
        if options.form == Some(Form::Pairwise) {
            let (text, instead) = if !is_elastic {
                let text = "the printed forces are not those of an energy, so that there is no stiffness whose modes or breakages could be \
                            followed: it is for elastic analyses; take {}";
                (text, Setting::Form(Form::Full))
            } else if !self.precracks.is_empty() {
                let text = "the printed factors are those of whole families: it takes no pre-cracks; take {}";
                (text, Setting::Form(Form::Full))
            } else if options.strains == Some(Strains::True) {
                ("it takes {} alone", Setting::Strains(Strains::Small))
            } else {
                return Ok(());
            };
            return contradiction(law.part("form"), Advice::new(text, [instead]));
        }
        let has_steps = matches!(self.analysis, Analysis::Stepped(_));
        if options.strains == Some(Strains::True) && !is_elastic && !has_steps {
            let text = "true strains are not proportional to the load, as the exact path and modes are: they are for elastic analyses and \
                        load steps; take {}";
            let small = Setting::Strains(Strains::Small);
            return contradiction(law.part("strains"), Advice::new(text, [small]));
        }
        Ok(())
    }

    fn check_precracks(&self) -> Checked {
        for (index, crack) in self.precracks.iter().enumerate() {
            let field = Field::element("precracks", index);
            let CrackShape::Line(points) = &crack.shape else {
                if self.dimensions() == 2 && !crack.is_along_group() {
                    let reason = "a body in the plane is cut by lines: give `CrackShape::Line` or a group of curves";
                    return contradiction(field.part("surface"), reason);
                }
                continue;
            };
            if self.dimensions() != 2 {
                let reason = "a solid is cut by surfaces: give one of the other shapes";
                return contradiction(field.part("points"), reason);
            }
            let field = field.part("points");
            require(points.len() >= 2, field, "two points or more", points)?;
            for pair in points.windows(2) {
                let expected = "another point than the one before it";
                require(pair[0] != pair[1], field, expected, pair[1])?;
            }
        }
        Ok(())
    }
}
