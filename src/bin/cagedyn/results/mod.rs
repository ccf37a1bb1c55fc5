//! What comes out of a run: tables, texts and files.

pub mod facts;
pub mod files;
pub mod finished;
pub mod formats;
pub mod intervals;
pub mod lines;
pub mod map;
pub mod output;
pub mod report;
pub mod sectors;
pub mod stream;
pub mod summary;
pub mod table;
