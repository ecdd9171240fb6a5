// SPDX-License-Identifier: MIT OR Apache-2.0
// Geometries made in another translation unit.
#ifndef EMBOUND_TESTS_ELSEWHERE_HPP
#define EMBOUND_TESTS_ELSEWHERE_HPP

#include <embound.hpp>

namespace elsewhere {

struct Number {
    int value;
};

embound::Geometry throws_its_number(int number);
void fails();

} // namespace elsewhere

#endif
