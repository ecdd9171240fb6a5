// SPDX-License-Identifier: MIT OR Apache-2.0
// Geometries made here, asked elsewhere: the state that carries exceptions is one for the program.
#include "elsewhere.hpp"

namespace elsewhere {

embound::Geometry throws_its_number(int number) {
    return embound::function([number](double, double, double) -> double { throw Number{number}; });
}

void fails() { embound::sphere({0.0, 0.0, 0.0}, -1.0); }

} // namespace elsewhere
