//! The library from outside: bodies and setups that are refused, programmes of loads, the examples.

mod by_hand;
mod examples;
mod half_a_body;
mod motion;
mod programmes;
mod unsound_bodies;
mod wrong_setups;
