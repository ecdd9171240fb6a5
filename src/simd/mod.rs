// SPDX-License-Identifier: MIT OR Apache-2.0
//! Lanes, run-time detection of the instruction set, one entry point per instruction set behind one
//! dispatcher, and the floating-point environment every result is computed in.

pub(crate) mod environment;
