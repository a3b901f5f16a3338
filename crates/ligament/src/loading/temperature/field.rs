//! Temperatures from a field of the mesh file.

use ligament_mesh::NodeField;

use crate::body::Body;
use crate::error::Fault;

/// The scalar field of a name, at a time step if there are several; as the error the wrong part of the setup and its fault.
pub(super) fn find<'a>(
    body: &'a dyn Body,
    name: &str,
    time_step: Option<i32>,
) -> Result<&'a NodeField, (&'static str, Fault)> {
    let fields = body.fields();
    let named: Vec<&NodeField> = fields.iter().filter(|field| field.name == name).collect();
    let Some(first) = named.first() else {
        let mut names: Vec<&str> = fields.iter().map(|field| field.name.as_str()).collect();
        names.dedup();
        let what = "field at the nodes ($NodeData) in the mesh file";
        let fault = Fault::UnknownName {
            what,
            found: name.to_owned(),
            candidates: names.into_iter().map(str::to_owned).collect(),
        };
        return Err(("name", fault));
    };
    if first.components != 1 {
        let reason = format!(
            "the field `{name}` has {} values a node; a temperature is one value",
            first.components
        );
        return Err(("name", Fault::NoSuchField(reason)));
    }
    let steps: Vec<String> = (named.iter())
        .map(|field| field.time_step.to_string())
        .collect();
    match time_step {
        None if named.len() == 1 => Ok(first),
        None => {
            let reason = format!(
                "the field `{name}` has several time steps ({}): choose one by `time_step`",
                steps.join(", ")
            );
            Err(("name", Fault::NoSuchField(reason)))
        }
        Some(step) => {
            let at_step = named.into_iter().find(|field| field.time_step == step);
            at_step.ok_or_else(|| {
                let reason = format!(
                    "the field `{name}` has no time step {step}; it has {}",
                    steps.join(", ")
                );
                ("time_step", Fault::NoSuchField(reason))
            })
        }
    }
}
