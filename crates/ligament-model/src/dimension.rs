//! From code for every dimension to what one dimension alone has.
//!
//! Some laws and elements exist in the plane alone. Code over D passes its bonds and points on to them as those of the plane, which
//! succeeds for D = 2 and is decided when the program is compiled.

use std::any::Any;

/// The value as one of type B; none where A is another type.
pub fn cast<A: Any, B: Any>(value: A) -> Option<B> {
    let mut value = Some(value);
    (&mut value as &mut dyn Any)
        .downcast_mut::<Option<B>>()
        .and_then(Option::take)
}

/// The value as one of type B, by reference; none where A is another type.
pub fn cast_ref<A: Any, B: Any>(value: &A) -> Option<&B> {
    (value as &dyn Any).downcast_ref()
}
