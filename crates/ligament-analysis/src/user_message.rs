//! Messages to the user about a model, its run or its modes.

use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

/// Largest number of points that one message names.
const SHOWN: usize = 5;

/// Names of points in messages.
pub trait PointNames {
    /// Name of a point.
    fn name(&self, point: u32) -> String;

    /// Name of a point with its position.
    fn name_and_position(&self, point: u32) -> String;

    /// Points in the order in which the user numbers them.
    fn sorted(&self, points: &[u32]) -> Vec<u32>;
}

/// Part of a run to which a message applies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Place {
    /// The model, before the run.
    Model,
    /// A load step, or a row of a motion.
    Step(usize),
    /// A time of a motion, s.
    Time(f64),
}

/// A message to the user.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Message {
    /// Part of the run to which the message applies.
    pub place: Place,
    /// Kind of the message, the same for all models: `parts-detached`.
    pub kind: Cow<'static, str>,
    /// Text of the message, a sentence without a full stop. `{}` stands for the name of the next point, `{at}` for its name and position,
    /// and `{all}` for the names of all points.
    pub text: String,
    /// Points in the order in which the text names them.
    pub points: Vec<u32>,
    /// Advice to the user, if there is any.
    pub advice: Option<String>,
}

impl Message {
    /// A message about a model.
    pub fn new(kind: &'static str, text: impl Into<String>) -> Self {
        Self {
            place: Place::Model,
            kind: kind.into(),
            text: text.into(),
            points: Vec::new(),
            advice: None,
        }
    }

    /// The message with the points that its text names.
    pub fn of_points(self, points: impl Into<Vec<u32>>) -> Self {
        let points = points.into();
        Self { points, ..self }
    }

    /// The message in a load step, or a row of a motion.
    pub fn in_step(self, step: usize) -> Self {
        let place = Place::Step(step);
        Self { place, ..self }
    }

    /// The message at a time of a motion, s.
    pub fn at_time(self, time: f64) -> Self {
        let place = Place::Time(time);
        Self { place, ..self }
    }

    /// The message with an advice, which begins in lower case and has no full stop.
    pub fn with_advice(self, advice: impl Into<String>) -> Self {
        let advice = Some(advice.into());
        Self { advice, ..self }
    }

    /// The message with the names of its points in the text.
    pub fn named(self, names: &dyn PointNames) -> Self {
        let mut points = self.points.iter();
        let mut text = String::new();
        let mut rest = self.text.as_str();
        while let Some((before, after)) = rest.split_once('{').filter(|_| points.len() > 0) {
            text += before;
            rest = if let Some(rest) = after.strip_prefix('}') {
                text.extend(points.next().map(|&it| names.name(it)));
                rest
            } else if let Some(rest) = after.strip_prefix("at}") {
                text.extend(points.next().map(|&it| names.name_and_position(it)));
                rest
            } else if let Some(rest) = after.strip_prefix("all}") {
                text += &listed(&names.sorted(points.as_slice()), names);
                points = [].iter();
                rest
            } else {
                text.push('{');
                after
            };
        }
        text += rest;
        Self {
            text,
            points: Vec::new(),
            ..self
        }
    }

    /// Whether another message differs at most in its step or time.
    pub fn tells_the_same(&self, other: &Self) -> bool {
        self.text == other.text && self.advice == other.advice
    }
}

/// Names of the first points of a list.
fn listed(points: &[u32], names: &dyn PointNames) -> String {
    let shown = points.iter().take(SHOWN);
    let shown: Vec<String> = shown.map(|&point| names.name(point)).collect();
    match shown.as_slice() {
        [one, other] => format!("{one} and {other}"),
        any => any.join(", "),
    }
}

/// Points by their numbers.
struct Numbers;

impl PointNames for Numbers {
    fn name(&self, point: u32) -> String {
        format!("point {point}")
    }

    fn name_and_position(&self, point: u32) -> String {
        self.name(point)
    }

    fn sorted(&self, points: &[u32]) -> Vec<u32> {
        points.to_vec()
    }
}

impl fmt::Display for Message {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.points.is_empty() {
            return self.clone().named(&Numbers).fmt(formatter);
        }
        match self.place {
            Place::Model => Ok(()),
            Place::Step(step) => write!(formatter, "step {step}: "),
            Place::Time(time) => write!(formatter, "time {time:.6e} s: "),
        }?;
        formatter.write_str(&self.text)?;
        match &self.advice {
            Some(advice) => write!(formatter, "; {advice}"),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::serial::Serial;

    /// Names of nodes, which the user numbers backwards.
    struct Nodes;

    impl PointNames for Nodes {
        fn name(&self, point: u32) -> String {
            format!("node {}", 100 - point)
        }

        fn name_and_position(&self, point: u32) -> String {
            format!("{} at 0", self.name(point))
        }

        fn sorted(&self, points: &[u32]) -> Vec<u32> {
            points.iter().rev().copied().collect()
        }
    }

    #[test]
    fn points_are_named_in_their_order() {
        let named = |text: &str, points: &[u32]| {
            let message = Message::new("kind", text).of_points(points);
            message.named(&Nodes).to_string()
        };
        assert_eq!(
            named("{} and {at}, {}", &[3, 5]),
            "node 97 and node 95 at 0, {}"
        );
        assert_eq!(named("{material} {}", &[1]), "{material} node 99");
        assert_eq!(named("{all}", &[1, 2]), "node 98 and node 99");
        assert_eq!(
            named("{}: {all}", &[9, 1, 2, 3, 4, 5, 6]),
            "node 91: node 94, node 95, node 96, node 97, node 98"
        );
    }

    #[test]
    fn place_and_advice_stand_around_the_text() {
        let message = Message::new("kind", "around {}").of_points([7]).in_step(4);
        let message = message.with_advice("remove it");
        assert_eq!(message.to_string(), "step 4: around point 7; remove it");
        let timed = message.at_time(1.5e-3);
        assert_eq!(
            timed.to_string(),
            "time 1.500000e-3 s: around point 7; remove it"
        );
    }

    #[test]
    fn stored_messages_are_read_back() {
        for place in [Place::Model, Place::Step(3), Place::Time(0.1)] {
            let message = Message::new("kind", "text of {}").of_points([2]);
            let message = Message {
                place,
                ..message.with_advice("advice")
            };
            let mut bytes = Vec::new();
            message.write(&mut bytes);
            assert_eq!(Message::read(&mut bytes.as_slice()), Ok(message));
        }
    }
}
