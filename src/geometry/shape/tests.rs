// SPDX-License-Identifier: MIT OR Apache-2.0
//! Each shape against closed forms, brute force and its own facts.
