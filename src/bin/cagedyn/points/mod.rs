//! Many runs beside each other: what is kept of each of them from the moment that it is done, and the columns of their tables.

pub mod columns;
pub mod records;
pub mod row;
pub mod spectrum;

pub use records::Records;
pub use row::Row;
