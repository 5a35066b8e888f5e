// SPDX-License-Identifier: BSD-3-Clause
//! The C interface of Cairn as it is: every function, struct and constant under its C name. All functions are unsafe.
//! The crate `cairn` is the safe interface.
#![allow(non_camel_case_types, non_snake_case)]

#[rustfmt::skip]
mod bindings;
pub use bindings::*;
