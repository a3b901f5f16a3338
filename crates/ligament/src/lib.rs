//! Peridynamics in memory: a typed setup in, a broken body out.
