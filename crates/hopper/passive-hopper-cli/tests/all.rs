//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs, clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod any_model;
mod basin_calls;
mod cli_page;
mod common;
mod damaged_files;
mod errors_of_numbers;
mod help_examples;
mod job_folders;
mod kills;
mod long_jobs;
mod long_jobs_page;
mod modes_and_diagrams;
mod random_arguments;
mod refusals;
mod streams;
mod two_calls;
