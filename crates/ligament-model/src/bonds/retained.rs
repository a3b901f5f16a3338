//! Selected entries of an array, in order.

/// The entries of `values` for which `keep` is true, in order.
pub(crate) fn retained<T>(mut values: Vec<T>, keep: &[bool]) -> Vec<T> {
    let mut keep = keep.iter();
    values.retain(|_| keep.next().is_some_and(|&kept| kept));
    values.shrink_to_fit();
    values
}
