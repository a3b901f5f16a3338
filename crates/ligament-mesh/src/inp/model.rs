//! A model: nodes, elements and sets of its own, parts, and instances of the parts.

use super::element_type::ElementType;
use super::fields;
use super::geometry::Frame;
use super::keyword::Keyword;
use super::part::{Items, Member, Part};
use super::source::Position;

/// An instance of a part.
pub(super) struct Instance {
    pub(super) name: String,
    pub(super) position: Position,
    /// Index of the part.
    pub(super) part: usize,
    pub(super) motion: Frame,
    /// The part with what the instance defines in addition.
    pub(super) own: Option<Part>,
}

/// Everything that a deck says of the mesh, and its other keywords.
#[derive(Default)]
pub(super) struct Model {
    /// Nodes, elements and sets outside of parts and instances.
    pub(super) own: Part,
    pub(super) parts: Vec<Part>,
    pub(super) instances: Vec<Instance>,
    pub(super) types: Vec<ElementType>,
    pub(super) keywords: Vec<Keyword>,
    /// Surfaces without sides of elements or nodes: positions, names and types.
    pub(super) other_surfaces: Vec<(Position, String, String)>,
}

impl Model {
    /// The part of an instance, with what the instance adds.
    pub(super) fn part_of<'a>(&'a self, instance: &'a Instance) -> &'a Part {
        let part = &self.parts[instance.part];
        instance.own.as_ref().unwrap_or(part)
    }

    /// Index and instance of a given name, without regard to case.
    pub(super) fn instance(&self, name: &str) -> Option<(usize, &Instance)> {
        let mut instances = self.instances.iter().enumerate();
        instances.find(|(_, it)| is_same_name(&it.name, name))
    }

    /// The instance that a qualified name begins with, as in `Bolt-1.Head` or `Assembly.Bolt-1.Head`, and the rest of the name.
    pub(super) fn qualified<'n>(&self, name: &'n str) -> Option<(usize, &'n str)> {
        let dots = name.match_indices('.').map(|(dot, _)| dot);
        let starts = std::iter::once(0).chain(dots.clone().map(|dot| dot + 1));
        let mut pairs = starts.flat_map(|start| dots.clone().map(move |dot| (start, dot)));
        pairs.find_map(|(start, dot)| {
            let (instance, _) = self.instance(name.get(start..dot)?)?;
            Some((instance, &name[dot + 1..]))
        })
    }
}

/// Whether two names are the same without regard to case.
pub(super) fn is_same_name(one: &str, other: &str) -> bool {
    one.to_uppercase() == other.to_uppercase()
}

/// Sets or numbers that names in a line refer to.
pub(super) struct Names<'a> {
    /// Sets and numbers without the name of an instance.
    pub(super) part: &'a Part,
    /// Space of these numbers.
    pub(super) space: u32,
    /// The model whose instances names may begin with, outside of parts and instances.
    pub(super) model: Option<&'a Model>,
}

impl Names<'_> {
    /// Members that a name stands for: the set of this name, or for a qualified name the set or number of an instance.
    pub(super) fn members(&self, items: Items, name: &str) -> Option<Vec<Member>> {
        let in_space = |members: Vec<Member>, space: u32| {
            let moved = members.into_iter().map(|member| match member.space {
                0 => Member { space, ..member },
                _ => member,
            });
            moved.collect()
        };
        if let Some(members) = self.part.members(items, name) {
            return Some(in_space(members, self.space));
        }
        let (instance, rest) = self.model?.qualified(name)?;
        let space = instance as u32 + 1;
        let model = self.model?;
        let part = model.part_of(&model.instances[instance]);
        match part.members(items, rest) {
            Some(members) => Some(in_space(members, space)),
            None => {
                let label = fields::label(rest.as_bytes())?;
                Some(vec![Member { space, label }])
            }
        }
    }

    /// The part of a space that members have.
    pub(super) fn part_of(&self, space: u32) -> &Part {
        match self.model {
            Some(model) if space > 0 => model.part_of(&model.instances[space as usize - 1]),
            _ => self.part,
        }
    }

    /// All elements, with those of the instances.
    pub(super) fn all_elements(&self) -> Vec<Member> {
        let instances = self.model.map_or(0, |model| model.instances.len() as u32);
        let spaces = std::iter::once(self.space).chain(1..=instances);
        let members = spaces.flat_map(|space| {
            let elements = self.part_of(space).elements.list.iter();
            elements.map(move |it| Member {
                space,
                label: it.label,
            })
        });
        members.collect()
    }
}
