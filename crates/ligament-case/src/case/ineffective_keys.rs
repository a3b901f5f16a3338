//! Keys that do not apply with a setting, each with the reason.

use super::analysis::Analysis;
use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::fracture::Control;
use super::key_path::KeyPath;
use super::word::word_of;
use ligament_analysis::motion::Scheme;

/// Settings of a case that decide whether keys have an effect.
pub(super) struct Settings {
    /// Kind of analysis.
    pub(super) analysis: Option<Analysis>,
    /// Scheme of a motion.
    pub(super) scheme: Option<Scheme>,
    /// Control of the loads in a fracture analysis.
    pub(super) control: Option<Control>,
    /// Whether the case has stages.
    pub(super) has_stages: bool,
}

/// Keys that do not apply with a setting.
struct IneffectiveKeys {
    /// Setting of the case with which the keys do not apply.
    with: CaseSetting,
    /// Section that has the keys; empty for keys outside of all sections.
    section: &'static str,
    keys: &'static [&'static str],
    reason: &'static str,
}

/// Setting of a case.
enum CaseSetting {
    /// One of some analyses.
    Analysis(&'static [Analysis]),
    /// One of some schemes of a motion.
    Scheme(&'static [Scheme]),
    /// Words of a setting, and whether a case has it.
    Setting(&'static str, fn(&Settings) -> bool),
}

const MODAL: CaseSetting = CaseSetting::Analysis(&[Analysis::Modal]);
const MOTION: CaseSetting = CaseSetting::Analysis(&[Analysis::Motion]);
const EVENT: CaseSetting = CaseSetting::Setting("control = \"event\"", |it| {
    it.scheme.is_none() && it.control == Some(Control::Event)
});
const STAGES: CaseSetting =
    CaseSetting::Setting("[[stage]]", |it| it.scheme.is_none() && it.has_stages);
const EXPLICIT: CaseSetting = CaseSetting::Scheme(&[Scheme::Explicit]);

const NOT_WITH: [IneffectiveKeys; 22] = [
    row(
        CaseSetting::Analysis(&[Analysis::Static, Analysis::Fracture, Analysis::Motion]),
        ("", &["modal"]),
        "it says which modes are wanted, and only analysis = \"modal\" finds any",
    ),
    row(
        CaseSetting::Analysis(&[Analysis::Static, Analysis::Fracture, Analysis::Modal]),
        ("", &["motion", "initial_velocity", "quiet"]),
        "only a motion takes place in time",
    ),
    row(
        CaseSetting::Analysis(&[Analysis::Static]),
        ("", &["fracture"]),
        "no bond breaks in an elastic solution",
    ),
    row(MODAL, ("", &["fracture"]), "no bond breaks in a mode"),
    row(
        MODAL,
        ("", &["load"]),
        "modes are free vibrations without loads; supports hold",
    ),
    row(
        MODAL,
        ("", &["temperature", "stage", "curve"]),
        "modes are free vibrations without loads",
    ),
    row(MODAL, ("", &["probe"]), "modes have no history to read"),
    row(
        MODAL,
        ("", &["output"]),
        "every mode is written, to a file of its own",
    ),
    row(
        MOTION,
        ("", &["stage"]),
        "each load follows an `amplitude` of its own in time",
    ),
    row(
        MOTION,
        ("", &["temperature"]),
        "a change of temperature would act at once at time zero",
    ),
    row(
        MOTION,
        ("fracture", &["control", "steps", "refine_first_break"]),
        "a motion has no load steps: bonds break at the time at which they reach their limits",
    ),
    row(
        MOTION,
        ("fracture", &["stop"]),
        "a motion has a `stop` of its own, in [motion]",
    ),
    row(
        EXPLICIT,
        (
            "fracture",
            &[
                "bonds_per_iteration",
                "order",
                "max_iterations",
                "tie_tolerance",
                "energy_tolerance",
            ],
        ),
        "all bonds at their limits break in an explicit step",
    ),
    row(
        EXPLICIT,
        (
            "solver",
            &[
                "method",
                "tolerance",
                "factorisation",
                "ordering",
                "update",
                "rebuild_every",
            ],
        ),
        "explicit steps solve no equations",
    ),
    row(
        EXPLICIT,
        ("motion", &["dissipation", "statics"]),
        "explicit steps take no energy and follow no equilibria",
    ),
    row(
        CaseSetting::Scheme(&[Scheme::Implicit]),
        ("motion", &["statics"]),
        "all implicit steps have inertia; those of the scheme \"auto\" have it where the body loses its balance",
    ),
    row(
        CaseSetting::Scheme(&[Scheme::Implicit, Scheme::Auto]),
        ("motion", &["safety"]),
        "implicit steps are stable at any length",
    ),
    row(
        CaseSetting::Analysis(&[Analysis::Static]),
        ("output", &["during_breakage"]),
        "no bond breaks in an elastic solution",
    ),
    row(
        MOTION,
        ("output", &["during_breakage"]),
        "a motion has no load steps: more `rows` in [motion] show more of its states",
    ),
    row(
        EVENT,
        ("output", &["during_breakage"]),
        "every event is an equilibrium between breakages: `fields_every` chooses those with field files",
    ),
    row(
        EVENT,
        (
            "fracture",
            &[
                "steps",
                "bonds_per_iteration",
                "order",
                "max_iterations",
                "refine_first_break",
            ],
        ),
        "the path goes from breakage to breakage without load steps",
    ),
    row(
        STAGES,
        ("fracture", &["steps"]),
        "the load steps are those of the stages: each takes its `steps`",
    ),
];

const fn row(
    with: CaseSetting,
    (section, keys): (&'static str, &'static [&'static str]),
    reason: &'static str,
) -> IneffectiveKeys {
    IneffectiveKeys {
        with,
        section,
        keys,
        reason,
    }
}

impl IneffectiveKeys {
    /// The words of the setting, if a case with these settings has it.
    fn among(&self, settings: &Settings) -> Option<String> {
        match self.with {
            CaseSetting::Analysis(any) => {
                let analysis = settings.analysis.filter(|it| any.contains(it))?;
                Some(format!("analysis = \"{}\"", word_of(&analysis)))
            }
            CaseSetting::Scheme(any) => {
                let scheme = settings.scheme.filter(|it| any.contains(it))?;
                let section = if self.section == "motion" {
                    ""
                } else {
                    "motion."
                };
                Some(format!("{section}scheme = \"{}\"", word_of(&scheme)))
            }
            CaseSetting::Setting(words, holds) => holds(settings).then(|| words.to_owned()),
        }
    }
}

/// Refuses keys of a document that do not apply with a setting of its case.
pub(super) fn refuse_keys_without_effect(
    document: &Node,
    settings: &Settings,
) -> Result<(), KeyFault> {
    for row in &NOT_WITH {
        let (section, table) = match row.section {
            "" => (Some(document), KeyPath::default()),
            name => (document.get(name), KeyPath::default().child(name)),
        };
        let is_given = |key: &&&'static str| {
            let given = section.and_then(|it| it.get(key));
            given.is_some_and(|it| !matches!(&it.value, Value::List(of) if of.is_empty()))
        };
        let Some(&key) = row.keys.iter().find(is_given) else {
            continue;
        };
        if let Some(setting) = row.among(settings) {
            let reason = row.reason;
            let fault = Fault::NotWith {
                key,
                setting,
                reason,
            };
            return Err(KeyFault::new(table.child(key), fault));
        }
    }
    Ok(())
}

/// Keys that do not apply in a case, each with its section.
pub(super) fn keys_without_effect(
    settings: &Settings,
) -> impl Iterator<Item = (&'static str, &'static str)> {
    let rows = NOT_WITH.iter().filter(|it| it.among(settings).is_some());
    rows.flat_map(|it| it.keys.iter().map(|key| (it.section, *key)))
}
