//! Conversion from code for every dimension to code for one dimension.
//!
//! Some laws and elements exist in the plane only. Code over D passes its bonds and points to them with the types of the plane, which
//! succeeds for D = 2 and is decided at compile time.

use std::any::Any;

/// The value as type B; `None` where A is another type.
pub fn cast<A: Any, B: Any>(value: A) -> Option<B> {
    let mut value = Some(value);
    (&mut value as &mut dyn Any)
        .downcast_mut::<Option<B>>()
        .and_then(Option::take)
}

/// Reference to the value as type B; `None` where A is another type.
pub fn cast_ref<A: Any, B: Any>(value: &A) -> Option<&B> {
    (value as &dyn Any).downcast_ref()
}
