//! Messages of a run as the user reads them.

use ligament::setup::{Analysis, Setup};
use ligament::{Body, Message};
use ligament_model::ElementKind;
use ligament_model::law::{BondLaw, laws_with, listed};

/// A message with the names of its points, and with the advice for a setup.
pub fn with_point_names(message: Message, body: &dyn Body, setup: &Setup) -> Message {
    let known = |it: &str| {
        message
            .advice
            .as_ref()
            .map(|advice| format!("{advice} ({it})"))
    };
    let advice = match &*message.kind {
        "overlap" => Some(remedy_of_overlap(setup)),
        "past-peak" => known("fracture.control = \"event\""),
        "undeformed" => known("[[support]]"),
        _ => message.advice.clone(),
    };
    Message { advice, ..message }.named(&body)
}

/// Messages in their order; messages that differ only in their step or time become one, with their number.
pub fn merged_messages(messages: impl IntoIterator<Item = Message>) -> Vec<String> {
    let mut all: Vec<(Message, usize)> = Vec::new();
    for message in messages {
        match all.iter_mut().find(|it| it.0.tells_the_same(&message)) {
            Some((_, count)) => *count += 1,
            None => all.push((message, 1)),
        }
    }
    let counted = all.into_iter().map(|(message, count)| match count {
        1 => message.to_string(),
        _ => format!("{message} ({count} times)"),
    });
    counted.collect()
}

/// Advice by which faces of cracks carry pressure in a setup.
fn remedy_of_overlap(setup: &Setup) -> String {
    let turns = setup.law.element() == ElementKind::Beam;
    match &setup.analysis {
        Analysis::Motion(it) if it.is_explicit() => {
            "[[contact]] with `cracks = true` lets them".to_owned()
        }
        _ if turns => "`closing = true` in [model] lets them".to_owned(),
        _ => {
            let laws = laws_with(|it| it.shear_form.is_some());
            let laws = listed(&laws, BondLaw::quoted);
            format!("`closing = true` in [model] lets them with laws whose points turn ({laws})")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_that_tell_the_same_are_one_with_their_number() {
        let message = |text: &str| Message::new("kind", text);
        let messages = [
            message("a: b"),
            message("c").in_step(3),
            message("c").at_time(1e-3),
            message("d"),
            message("d").in_step(4),
            message("c").in_step(5),
        ];
        let found = merged_messages(messages);
        assert_eq!(found, ["a: b", "step 3: c (3 times)", "d (2 times)"]);
    }
}
