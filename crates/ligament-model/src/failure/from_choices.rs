//! Criteria with the limits of the bonds, from the choices of a user.

use super::KINDS;
use super::basis::Basis;
use super::criterion::{Criteria, Criterion};
use super::fracture_energy;
use super::kind::{Choice, Kind};
use super::measure::Measure;
use super::sliding;
use super::softening::{AfterLimit, LAWS, brittle, linear};
use super::unfit::Setting;
use super::unfit::{NoLimit, Unfit};
use crate::advice::Advice;
use crate::scatter::Scattered;

/// The criteria on the bonds, in the order of their choices, which must be [right](Choice::check) and [suit](Choice::suits) all
/// materials.
///
/// # Errors
///
/// If a criterion exists in the plane alone, the strengths of a material leave it without a limit, or its fracture energy leaves
/// nothing after the limit; with the place of the choice.
pub fn criteria<const D: usize>(
    choices: &[Choice],
    basis: &Basis<'_, D>,
) -> Result<Criteria, (usize, NoLimit)> {
    let mut list = Vec::new();
    for (place, choice) in choices.iter().enumerate() {
        let at_place = |error| (place, error);
        let kind = &choice.kind;
        let limits = kind.limits.in_dimension();
        let limits = limits.ok_or_else(|| at_place(plane_only(kind)))?;
        let limits = limits(choice, basis).map_err(at_place)?;
        for (&measure, mut limits) in kind.measures.iter().zip(limits) {
            // Limits that follow the bonds that are left have the factors of their points.
            if limits.has_fixed_limits() {
                scatter(choice, &mut limits.limit, basis);
            }
            list.push(Criterion {
                name: limits.name.unwrap_or(match kind.measures {
                    [_] => kind.word,
                    _ => measure.word(),
                }),
                choice: place,
                measure,
                after: match limits.is_brittle {
                    true => AfterLimit::new(brittle::LAW, Vec::new()),
                    false => after(choice, &limits.limit, basis).map_err(at_place)?,
                },
                limit: limits.limit.into(),
                coefficient: limits.coefficient.into(),
                surroundings: limits.surroundings,
            });
        }
    }
    Ok(Criteria { list })
}

/// Error for a solid whose kind of failure exists only in the plane; it lists the kinds that exist in space.
fn plane_only(kind: &Kind) -> NoLimit {
    let in_space = KINDS.iter().filter(|it| it.limits.solid.is_some());
    NoLimit::PlaneOnly {
        kind: kind.word,
        in_space: in_space.map(|it| it.word).collect(),
    }
}

/// Multiplies limits (n_bonds) by the random factor f of a strength, or by sqrt(f) of an energy.
fn scatter<const D: usize>(choice: &Choice, limits: &mut [f64], basis: &Basis<'_, D>) {
    let of = choice.limits_from();
    let share = match of {
        Scattered::Strength => |factor: f64| factor,
        Scattered::FractureEnergy => f64::sqrt,
    };
    basis.scatter(of, limits, share);
}

/// Behaviour of bonds with these limits (n_bonds) after them. A parameter that is not given makes the lives of the bonds
/// take the fracture energy: (s_G/e_0)^2 times the energy at the limit e_0, where s_G is the critical stretch of a brittle
/// bond with that fracture energy.
fn after<const D: usize>(
    choice: &Choice,
    limits: &[f64],
    basis: &Basis<'_, D>,
) -> Result<AfterLimit, NoLimit> {
    let law = choice.after.clone();
    let (bonds, subdomain) = (&basis.system.bonds, &basis.system.cloud.subdomain);
    let parameter = match (law.parameter, choice.parameter()) {
        (None, _) => Vec::new(),
        (Some(_), Some(given)) => vec![given; limits.len()],
        (Some(parameter), None) => {
            let mut brittle = fracture_energy::critical_stretches(basis);
            basis.scatter(Scattered::FractureEnergy, &mut brittle, f64::sqrt);
            let of_bond = |(bond, (&limit, &brittle)): (usize, (&f64, &f64))| {
                // Bonds that never fail need no end.
                if limit.is_infinite() || brittle.is_infinite() {
                    return Ok(f64::INFINITY);
                }
                let energy = (brittle / limit).powi(2);
                if energy <= parameter.least_energy {
                    let [a, b] = bonds.ends[bond].map(f64::from);
                    return Err([a, b, bonds.horizon[bond], limit, brittle]);
                }
                Ok(law.parameter_for(energy))
            };
            let of_bonds = limits.iter().zip(&brittle).enumerate();
            let found: Result<Vec<f64>, _> = of_bonds.map(of_bond).collect();
            let nothing_left = found.as_ref().err().copied();
            let first = subdomain.all_reduce_min(nothing_left);
            if let Some([_, _, horizon, limit, brittle]) = first {
                return Err(NoLimit::NothingLeft {
                    horizon,
                    limit,
                    brittle,
                    least: parameter.least_energy,
                });
            }
            found.unwrap_or_default()
        }
    };
    Ok(AfterLimit::new(law, parameter))
}

impl Choice {
    /// Checks that the keys of a choice are compatible, on the exact path from breakage to breakage or with load steps.
    ///
    /// # Errors
    ///
    /// If a key does not belong to the kind or the law of softening, is missing beside another or out of range.
    pub fn check(&self, on_exact_path: bool) -> Result<(), Unfit> {
        self.refuse_parameters()?;
        self.check_together()?;
        self.refuse_keys()?;
        (self.kind.check)(self)?;
        self.refuse_softening(on_exact_path)?;
        let softening = self.after.parameter;
        let softening = softening.map(|it| (it.key, self.parameter(), it.above));
        let limits = self.own_limits().map(|(key, value)| (key, value, 0.0));
        for (key, value, above) in limits.into_iter().chain(softening) {
            if let Some(found) = value.filter(|value| value.is_nan() || *value <= above) {
                let expected = format!("greater than {above}");
                return Err(Unfit::OutOfRange {
                    field: key,
                    expected,
                    found,
                });
            }
        }
        Ok(())
    }

    /// Refuses parameters that the law of softening does not have.
    fn refuse_parameters(&self) -> Result<(), Unfit> {
        let own = self.after.parameter.map(|it| it.key);
        let given = self.parameters();
        let is_given = |wanted: &str| given.iter().any(|(key, it)| *key == wanted && it.is_some());
        let others = LAWS.iter().filter_map(|it| Some((it.word, it.parameter?)));
        let mut refused = others.filter(|(_, it)| Some(it.key) != own && is_given(it.key));
        match refused.next() {
            None => Ok(()),
            Some((word, other)) => Err(Unfit::NotWith {
                field: other.key,
                named: Setting::Field(other.key),
                setting: Setting::After(self.after.word),
                reason: Advice::new(other.exclusive_reason, [Setting::After(word)]),
            }),
        }
    }

    /// Refuses keys without effect on the kind, from which a user would expect one.
    fn refuse_keys(&self) -> Result<(), Unfit> {
        let calibration = ("calibration", self.calibration.map(|_| 0.0));
        let others = [
            calibration,
            ("friction_angle", self.friction_angle),
            ("cohesion", self.cohesion),
            ("fibre_distance", self.fibre_distance),
        ];
        let given = self.own_limits().into_iter().chain(others);
        let mut refused =
            given.filter(|(key, value)| value.is_some() && !self.kind.keys.contains(key));
        let Some((key, _)) = refused.next() else {
            return Ok(());
        };
        let kinds_with_key = kinds_with_key(key);
        let reason = match (key, self.kind.keys) {
            ("limit", ["critical_stretch", ..]) => {
                "it has two limits: `critical_stretch` of opening and `critical_angle` of shear"
                    .to_owned()
            }
            ("limit", _) => format!("its limits come from the material; {kinds_with_key} take one"),
            ("calibration", _) => {
                format!(
                    "only the limit of {kinds_with_key} can come from the strengths in two ways"
                )
            }
            ("friction_angle", _) => format!("only {kinds_with_key} have friction"),
            ("cohesion", _) => format!("only {kinds_with_key} has a cohesion"),
            ("fibre_distance", _) => {
                format!("only {kinds_with_key} looks at a fibre beside the axis of the bond")
            }
            _ => format!(
                "only {kinds_with_key} has a limit for opening and one for shear; others take one as `limit`"
            ),
        };
        Err(Unfit::NotWith {
            field: key,
            named: Setting::Field(key),
            setting: Setting::Criterion(self.kind.word),
            reason: reason.into(),
        })
    }

    /// Refuses one limit alone of a kind with two.
    fn check_together(&self) -> Result<(), Unfit> {
        let of_kind =
            (self.own_limits().into_iter()).filter(|(key, _)| self.kind.keys.contains(key));
        let (given, missing): (Vec<_>, Vec<_>) = of_kind.partition(|(_, limit)| limit.is_some());
        match (given.first(), missing.first()) {
            (Some((given, _)), Some((field, _))) => Err(Unfit::Missing {
                field,
                reason: format!(
                    "beside `{given}`: the limits of opening and of shear are given together, or both come from the fracture energies"
                )
                .into(),
            }),
            _ => Ok(()),
        }
    }

    /// Refuses softening that the criterion or the control of the load does not allow.
    fn refuse_softening(&self, on_exact_path: bool) -> Result<(), Unfit> {
        let law = &self.after;
        if let Some(reason) = self.kind.softens_because.filter(|_| !law.softens) {
            return Err(Unfit::Missing {
                field: "after",
                reason: Advice::new(
                    format!("with {{}}, such as {{}}: {reason}"),
                    [
                        Setting::Criterion(self.kind.word),
                        Setting::After(linear::LAW.word),
                    ],
                ),
            });
        }
        if !law.softens {
            return Ok(());
        }
        let kind = Setting::Criterion(self.kind.word);
        let refused = |setting: Setting, reason: Advice<Setting>| Unfit::NotWith {
            field: "after",
            named: Setting::After(law.word),
            setting,
            reason,
        };
        if let Some(reason) = self.kind.brittle_because {
            return Err(refused(kind, reason.into()));
        }
        let slides = self.kind.measures == [Measure::Sliding];
        if let Some(reason) = law.sliding_because.filter(|_| !slides) {
            let sliding = Setting::Criterion(sliding::SLIDING.word);
            return Err(refused(kind, Advice::new(reason, [sliding])));
        }
        if on_exact_path {
            let reason =
                "the exact path is straight between breakages, and softening bends it: take {}";
            let reason = Advice::new(reason, [Setting::LoadSteps]);
            return Err(refused(Setting::ExactPath, reason));
        }
        match self.parameter_from_energy() {
            Some(field) if self.spends_fracture_energy() => Err(Unfit::Missing {
                field,
                reason: Advice::new(
                    "with {}: up to the limit a bond takes all of the fracture energy, and nothing is left to soften by; or take \
                     {}, whose limit comes from the `tensile_strength`",
                    [kind, Setting::Criterion(fracture_energy::BOND_ENERGY.word)],
                ),
            }),
            _ => Ok(()),
        }
    }
}

/// Names of the kinds that have a key: `a`, `b` and `c`.
fn kinds_with_key(key: &str) -> String {
    let kinds = KINDS.iter().filter(|it| it.keys.contains(&key));
    let words: Vec<String> = kinds.map(|it| format!("\"{}\"", it.word)).collect();
    match words.as_slice() {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        words => words.concat(),
    }
}
