// SPDX-License-Identifier: MIT OR Apache-2.0
// A mesh with every fault that repair knows.
#ifndef EXAMPLES_PATIENT_HPP
#define EXAMPLES_PATIENT_HPP

#include <embound.hpp>

// A unit cube with a hole in one side, a face without area, faces given twice, every third face turned over; a
// second cube that shares a corner with it; and a third around a hollow, its inner shell facing the wrong way.
embound::Mesh make_patient();

// The volume that is enclosed once it is mended.
constexpr double healthy_volume = 1.0 + 1.0 + (8.0 - 1.0);

#endif
