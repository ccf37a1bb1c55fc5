//! Sweeps that take long: derivatives and combinations of parts over many states, conservation over long runs, films
//! against quadrature.

#[path = "../common/mod.rs"]
mod common;

mod composition;
mod conservation;
mod film_quadrature;
mod jacobian;
