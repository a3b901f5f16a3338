//! Closed forms and fixtures shared by the verification tests.
