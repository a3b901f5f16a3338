//! What a setup says must go together before anything is made of it.

use ligament_model::{Elasticity, Isotropic, Material, Plane};

use super::{Action, Analysis, Horizon, Law, MaterialRegion, Setup, Surface};
use crate::error::{Fault, Field, SetupError};
use crate::setup::{Alpha, Calibration, Form, Reading, Strains};

impl Setup {
    /// Checks that the fields of the setup make sense and go together. Groups are looked up when the model is built.
    ///
    /// # Errors
    ///
    /// If a field is out of range, missing, or does not go with another.
    pub fn check(&self) -> Result<(), SetupError> {
        let thickness = self.thickness();
        require(
            thickness > 0.0,
            Field::whole("section").part("thickness"),
            "greater than 0",
            thickness,
        )?;
        match self.horizon {
            Horizon::Factor(factor) => {
                require(factor >= 1.0, Field::whole("horizon"), "at least 1", factor)?;
            }
            Horizon::Length(length) => {
                require(
                    length > 0.0,
                    Field::whole("horizon"),
                    "greater than 0",
                    length,
                )?;
            }
        }
        if self.materials.is_empty() {
            let fault =
                Fault::Contradiction("there is no material: give one, or one for each group");
            return Err(Field::whole("materials").error(fault));
        }
        for (index, region) in self.materials.iter().enumerate() {
            self.check_material(Field::element("materials", index), region)?;
        }
        self.check_criteria()?;
        self.check_law()?;
        let loads = self.loads.iter().map(|it| it.name.as_str());
        require_unique("loads", loads)?;
        require_unique("probes", self.probes.iter().map(|it| it.name.as_str()))?;
        self.check_loads()
    }

    fn check_loads(&self) -> Result<(), SetupError> {
        for (index, load) in self.loads.iter().enumerate() {
            let field = Field::element("loads", index);
            if let Some(profile) = load.profile {
                let expected = "another coordinate than `zero`: the load is as given there";
                require(
                    profile.one != profile.zero,
                    field.part("profile.one"),
                    expected,
                    profile.one,
                )?;
            }
            let has_value = match load.action {
                Action::Displacement(it) => it.components().next().is_some(),
                Action::Force(it) | Action::ForcePerLength(it) | Action::BodyForce(it) => {
                    it != [0.0; 2]
                }
                Action::Moment(it) | Action::BodyCouple(it) | Action::Pressure(it) => it != 0.0,
            };
            if !has_value {
                let fault = Fault::Contradiction(
                    "this load does nothing: give one of its components a value other than 0",
                );
                return Err(field.part("action").error(fault));
            }
        }
        Ok(())
    }

    fn check_material(&self, field: Field, region: &MaterialRegion) -> Result<(), SetupError> {
        let material = &region.material;
        if let Elasticity::Isotropic(Isotropic { young, poisson }) = material.elasticity {
            require(
                young > 0.0,
                field.part("elasticity.young"),
                "greater than 0",
                young,
            )?;
            let expected = "greater than -1 and less than 0.5";
            require(
                poisson > -1.0 && poisson < 0.5,
                field.part("elasticity.poisson"),
                expected,
                poisson,
            )?;
        }
        for (part, value) in [
            ("tensile_strength", material.tensile_strength),
            ("compressive_strength", material.compressive_strength),
            ("fracture_energy", material.fracture_energy),
            ("density", material.density),
        ] {
            if let Some(value) = value {
                require(value > 0.0, field.part(part), "greater than 0", value)?;
            }
        }
        if matches!(self.analysis, Analysis::Modal(_)) && material.density.is_none() {
            let fault = Fault::Missing {
                property: "density",
                reason: "(in kg/m^3) because a modal analysis needs masses".to_owned(),
            };
            return Err(field.part("density").error(fault));
        }
        self.check_elasticity(field, material)
    }

    fn check_elasticity(&self, field: Field, material: &Material) -> Result<(), SetupError> {
        let field = field.part("elasticity");
        let suits = match material.elasticity {
            Elasticity::Isotropic(_) => true,
            Elasticity::Orthotropic(_) => {
                matches!(self.law, Law::Orthotropic { .. } | Law::MbbPd { .. })
            }
            Elasticity::Anisotropic(_) => matches!(self.law, Law::MbbPd { .. }),
        };
        if !suits {
            let fault = Fault::Contradiction(
                "the law is one for isotropic materials: an orthotropic material needs `Law::Orthotropic` or `Law::MbbPd`, an \
                 anisotropic one `Law::MbbPd`",
            );
            return Err(field.error(fault));
        }
        match material.elasticity {
            Elasticity::Orthotropic(it)
                if it.out_of_plane.is_none() && self.plane() == Plane::Strain =>
            {
                let fault = Fault::Missing {
                    property: "out_of_plane",
                    reason: "because of plane strain".to_owned(),
                };
                Err(field.error(fault))
            }
            _ => Ok(()),
        }
    }

    fn check_criteria(&self) -> Result<(), SetupError> {
        let on_exact_path = matches!(self.analysis, Analysis::Event(_));
        let takes_strains = matches!(self.law, Law::MbbPd { .. });
        if self.analysis.is_fracture() && self.criteria.is_empty() {
            let fault =
                Fault::Contradiction("bonds break by a criterion, and there is none: give one");
            return Err(Field::whole("criteria").error(fault));
        }
        for (index, choice) in self.criteria.iter().enumerate() {
            let field = Field::element("criteria", index);
            choice
                .check(on_exact_path)
                .map_err(|unfit| field.error(Fault::Unfit(unfit)))?;
            if choice.kind.takes_strains() != takes_strains {
                let fault = Fault::Contradiction(
                    "`mixed-mode` looks at strains of the bond's own, which only `Law::MbbPd` has, and the other criteria at stretch \
                     and sliding, which it does not have",
                );
                return Err(field.part("kind").error(fault));
            }
            for (place, region) in self.materials.iter().enumerate() {
                let field = Field::element("materials", place);
                let suits = choice.suits(&region.material);
                suits.map_err(|unfit| field.error(Fault::Unfit(unfit)))?;
            }
        }
        Ok(())
    }

    /// Laws leave not everything open.
    fn check_law(&self) -> Result<(), SetupError> {
        let contradiction = |field: Field, reason| Err(field.error(Fault::Contradiction(reason)));
        let (law, correction) = (Field::whole("law"), Field::whole("correction"));
        let is_discrete = self.law.calibration() == Some(Calibration::Discrete);
        if is_discrete && self.correction.surface == Surface::Volume {
            let reason = "the discrete calibration has the surfaces in its sums: take `Surface::None`, or `Calibration::Integral`";
            return contradiction(correction.part("surface"), reason);
        }
        let Law::MbbPd { form, strains } = self.law else {
            return Ok(());
        };
        let lattice_cell = match self.body.origin() {
            crate::body::Origin::Lattice(lattice) => Some(lattice.spacing),
            _ => None,
        };
        if lattice_cell.is_none_or(|[dx, dy]| dx != dy) {
            let reason = "the law classes bonds by the rows and columns of a lattice of square cells: give it one, or take another law";
            return contradiction(law, reason);
        }
        if self.correction.alpha != Alpha::None || self.correction.surface != Surface::None {
            let reason = "the factors psi of the law make all energies right: take `Alpha::None` and `Surface::None`";
            return contradiction(correction, reason);
        }
        let is_elastic = matches!(self.analysis, Analysis::Elastic { .. });
        if form == Form::Pairwise
            && !(is_elastic && self.precracks.is_empty() && strains == Strains::Small)
        {
            let reason = "the printed forces are not those of an energy: the form is for elastic analyses of whole bodies with small \
                          strains; take `Form::Full`";
            return contradiction(law.part("form"), reason);
        }
        if strains == Strains::True && !is_elastic {
            let reason = "true strains are not proportional to the load: they are for elastic analyses; take `Strains::Small`";
            return contradiction(law.part("strains"), reason);
        }
        let is_section = |reading: &Reading| matches!(reading, Reading::Section { .. });
        match self.probes.iter().position(|it| is_section(&it.reading)) {
            Some(index) => {
                let reason = "the elements of the law couple up to six points, so that their forces go through no line: the forces of \
                              supports and loads are in the history";
                contradiction(Field::element("probes", index).part("reading"), reason)
            }
            None => Ok(()),
        }
    }
}

fn require(
    holds: bool,
    field: Field,
    expected: &'static str,
    found: f64,
) -> Result<(), SetupError> {
    if holds {
        return Ok(());
    }
    let found = format!("{found:?}");
    Err(field.error(Fault::OutOfRange { expected, found }))
}

fn require_unique<'a>(
    list: &'static str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<(), SetupError> {
    for (index, name) in names.clone().enumerate() {
        if let Some(first) = names.clone().take(index).position(|it| it == name) {
            let fault = Fault::NameTwice {
                name: name.to_owned(),
                first: Field::element(list, first),
            };
            return Err(Field::element(list, index).part("name").error(fault));
        }
    }
    Ok(())
}
