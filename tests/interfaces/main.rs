//! What users touch: command line, C ABI and its header, pages.

#[path = "../common/c_programs.rs"]
mod c_programs;
#[path = "../common/mod.rs"]
mod common;

mod abi;
mod analysis;
mod c_abi;
mod c_cvode;
mod calls;
mod case_sets;
mod cli;
mod cli_check;
mod cli_files;
mod cli_shell;
mod docs;
mod examples;
mod fmu;
mod formats;
mod fuzzed;
mod header;
mod hosts;
mod install;
mod pictures;
mod report;
mod spectra;
mod sweep;
mod sweep_parts;
