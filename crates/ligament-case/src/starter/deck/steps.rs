//! Steps of a deck: the analysis and the sequence of loads.

use std::fmt::Write;

use ligament_mesh::inp::{Keyword, number};

use super::amplitude::{Procedure, Step};
use super::load::Load;
use super::translation::Translation;
use super::units;
use crate::starter::text::quoted;

impl Translation<'_> {
    /// Begins a step.
    pub(super) fn begin_step(&mut self, keyword: &Keyword) {
        let named = keyword.parameter("NAME").and_then(|it| it.value.clone());
        self.steps.push(Step {
            name: named.unwrap_or_else(|| format!("step-{}", self.steps.len() + 1)),
            procedure: Procedure::Static,
            duration: 1.0,
        });
        self.is_left_out = false;
        if keyword
            .parameter("NLGEOM")
            .is_some_and(|it| it.value.as_deref() != Some("NO"))
        {
            self.omit(keyword, "NLGEOM: displacements are small against the body");
        }
    }

    /// Reads the procedure of a step; a step of another kind than the first one is left out.
    pub(super) fn read_procedure(&mut self, keyword: &Keyword) {
        let fields = keyword.data.first().map(|line| line.fields());
        let value = |place: usize| number(fields.as_ref()?.get(place)?).filter(|it| *it > 0.0);
        let has = |name: &str| keyword.parameter(name).is_some();
        let procedure = match keyword.name.as_str() {
            "STATIC" => Procedure::Static,
            "FREQUENCY" => Procedure::Modes(value(0).unwrap_or(10.0) as usize),
            _ if has("EXPLICIT") => Procedure::Explicit,
            _ => Procedure::Implicit(value(0).unwrap_or(1.0)),
        };
        if has("RIKS") {
            self.omit(
                keyword,
                "RIKS: in a case with [fracture] a stage has a `control`",
            );
        }
        let first = self.steps.first().map_or(procedure, |it| it.procedure);
        let n_steps = self.steps.len();
        let follows = procedure == Procedure::Static && first == Procedure::Static;
        match self.steps.last_mut() {
            Some(step) if n_steps == 1 || follows => {
                step.procedure = procedure;
                step.duration = value(1).unwrap_or(1.0);
            }
            _ => self.omit_step(keyword),
        }
    }

    /// Leaves out the last step, with its loads.
    pub(super) fn omit_step(&mut self, keyword: &Keyword) {
        self.omit(keyword, "a case has one analysis, here that of the first step: this step and its loads are left out");
        self.steps.pop();
        self.is_left_out = true;
    }

    /// Text of the lines for the variation of a load in a motion.
    pub(super) fn variation(&self, load: &Load) -> String {
        let given = load.values.first().and_then(|it| it.amplitude.as_ref());
        match given.filter(|_| self.procedure().is_motion()) {
            Some(amplitude) => format!("amplitude = {} # s\n", amplitude.in_time(self.units.time)),
            None => String::new(),
        }
    }

    /// Text of `[motion]` or `[modal]`, or of the stages, unless the loading is one proportional step.
    pub(super) fn analysis_text(&self, loads: &[&Load], heated_in: Option<usize>) -> String {
        let step = self.steps.first();
        let duration = step.map_or(1.0, |it| it.duration) * self.units.time;
        let duration = format!("duration = {} # s\n", units::number(duration));
        match self.procedure() {
            Procedure::Modes(count) => format!("[modal]\nmodes = {count}\n"),
            Procedure::Explicit => format!("[motion]\n{duration}"),
            Procedure::Implicit(step) => {
                let step = units::number(step * self.units.time);
                format!("[motion]\n{duration}scheme = \"implicit\"\nstep = {step} # s\n")
            }
            Procedure::Static => self.stages(loads, heated_in),
        }
    }

    fn stages(&self, loads: &[&Load], heated_in: Option<usize>) -> String {
        let varies = |it: &&&Load| it.values.iter().any(|it| it.amplitude.is_some());
        if self.steps.len() < 2 && !loads.iter().any(|it| varies(&it)) {
            return String::new();
        }
        let mut text =
            "# Loads go to their factors one stage after the other; without fracture a stage has one solution.\n"
                .to_owned();
        let mut start = 0.0;
        for (index, step) in (1..).zip(&self.steps) {
            let course = |load: &&Load| {
                let value = load.values.iter().rfind(|it| it.step == index)?;
                let factor = value.size / load.size();
                let factors = match &value.amplitude {
                    Some(amplitude) => amplitude.factors_text(factor, step, start),
                    None => units::number(factor),
                };
                Some(format!("{} = {factors}", quoted(&load.name)))
            };
            let mut courses: Vec<String> = loads.iter().filter_map(course).collect();
            courses.extend((heated_in == Some(index)).then(|| "temperature = 1.0".to_owned()));
            if !courses.is_empty() {
                let (name, loads) = (quoted(&step.name), courses.join(", "));
                let _ = writeln!(text, "[[stage]]\nname = {name}\nloads = {{ {loads} }}");
            }
            start += step.duration;
        }
        text + "\n"
    }
}
