//! Upper halves of the vector registers of a thread.

/// Clears the upper halves of the vector registers, which hold nothing across a call.
///
/// Loops that are compiled for every processor use the lower halves. Once the system has let a thread wait and go on, some processors take
/// the upper halves as used, keep them in every such instruction, and are slow until they are cleared: with two threads the second one, which
/// waits between tasks, took 2.2 times as long for its half of a product (AMD EPYC).
#[inline]
pub(crate) fn clear_upper_halves() {
    #[cfg(target_arch = "x86_64")]
    if let Some(processor) = pulp::x86::V3::try_new() {
        processor.avx._mm256_zeroupper();
    }
}
