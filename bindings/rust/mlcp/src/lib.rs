#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))] // docs.rs tells which feature an item needs
#![deny(missing_docs, missing_debug_implementations)]
#![deny(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod body;
mod bulk;
mod callbacks;
mod constants;
mod contacts;
mod ecosystem;
mod error;
mod factor;
mod library;
mod mask;
mod matrix;
mod memory;
mod numbers;
mod pivot;
mod problem;
mod real;
mod report;
mod request;
mod rows;
mod settings;
mod snapshot;
mod solver;
mod sparse;
mod strided;
pub mod timestep;

pub use body::Body;
pub use callbacks::Progress;
pub use contacts::{Contact, ContactState, Contacts, Friction, FrictionFields};
pub use error::{Error, Result};
pub use factor::Factor;
pub use library::version;
pub use mask::{Mask, MaskRef, RowState};
pub use matrix::{Compressed, MatrixView, Order, Triangle};
pub use pivot::Pivot;
pub use problem::Problem;
pub use real::Real;
pub use report::{Outcome, Report, Times};
pub use request::Request;
pub use rows::{Row, RowFields, RowFieldsMut, Rows};
pub use settings::{Impulses, Method, PivotRule, Refactorize, Settings};
pub use snapshot::{Recording, Snapshot};
pub use solver::{Certificate, Solver};
pub use sparse::SparseMatrix;
pub use strided::{Blocks, Strided, StridedMut};
