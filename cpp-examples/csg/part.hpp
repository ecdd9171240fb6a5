// SPDX-License-Identifier: MIT OR Apache-2.0
// The blank that is machined where no mesh is given.
#ifndef CSG_PART_HPP
#define CSG_PART_HPP

#include <embound.hpp>

// A pillow-shaped block of 90 x 50 x 24 mm around the origin, closed: where (x/a)^6 + (y/b)^6 + (z/c)^6 = 1.
embound::Mesh make_blank();

#endif
