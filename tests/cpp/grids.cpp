// SPDX-License-Identifier: MIT OR Apache-2.0
// Values over a lattice written to files through the C++ layer.
#include "support/check.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

#include <unistd.h>

namespace {

static_assert(std::is_convertible_v<std::vector<float>, embound::ConstArray>);
static_assert(std::is_convertible_v<std::vector<std::int8_t>, embound::ConstArrayOfAnyType>);

std::string temporary(const char *name) {
    const char *folder = std::getenv("TMPDIR");
    return std::string(folder == nullptr ? "/tmp" : folder) + "/embound-" + std::to_string(getpid()) + "-" + name;
}

std::string content(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The values of type T that begin `at` bytes into the data.
template <class T> std::vector<T> values(const std::string &bytes, std::size_t at, std::size_t count) {
    const std::string mark = "<AppendedData encoding=\"raw\">\n_";
    std::vector<T> found(count);
    at += bytes.find(mark) + mark.size() + sizeof(std::uint64_t);
    if (at + count * sizeof(T) <= bytes.size()) {
        std::memcpy(found.data(), bytes.data() + at, count * sizeof(T));
    }
    return found;
}

} // namespace

TEST(a_fill_and_its_signs_are_written_and_found) {
    const std::vector<double> x = check::axis(-1.0, 1.0, 9), y = check::axis(-1.5, 1.5, 7);
    const embound::Lattice lattice(x, y, x);
    const embound::Geometry ball = embound::sphere({0.1, 0.0, 0.0}, 0.7);
    const std::vector<double> distance = ball.fill(lattice);
    const std::vector<std::int8_t> sign = ball.fill<std::int8_t>(lattice, embound::FillMode::Sign);
    const std::string path = temporary("ball.vti");
    embound::write_grid(path, lattice, {{"distance", distance}, {"sign", sign}});
    const std::string bytes = content(path);
    CHECK(bytes.find("<ImageData WholeExtent=\"0 8 0 6 0 8\" Origin=\"-1.0 -1.5 -1.0\"") != std::string::npos);
    CHECK(values<double>(bytes, 0, distance.size()) == distance);
    CHECK(values<std::int8_t>(bytes, 8 + 8 * distance.size(), sign.size()) == sign);
    // Every second point along x, through strides.
    const std::vector<double> half = check::axis(-1.0, 1.0, 5);
    const embound::Lattice coarse(half, y, x);
    embound::write_grid(path, coarse, {{"distance", {distance.data(), {2, 9, 63}}}});
    const std::vector<double> thinned = values<double>(content(path), 0, coarse.points());
    for (std::size_t i = 0; i < thinned.size(); ++i) {
        CHECK(thinned[i] == distance[2 * (i % 5) + 9 * (i / 5)]);
    }
    std::remove(path.c_str());
}

TEST(what_cannot_be_written_is_an_error) {
    const std::vector<double> x = check::axis(0.0, 1.0, 3), bent{0.0, 1.0, 3.0};
    const std::vector<double> few(8), enough(27);
    const std::string path = temporary("bent.vti");
    const auto status = [&](const embound::Lattice &lattice, const std::vector<embound::GridField> &fields) {
        try {
            embound::write_grid(path, lattice, fields);
        } catch (const embound::Error &error) {
            return error.status();
        }
        return emb_status{EMB_OK};
    };
    CHECK(status({x, x, x}, {{"few", few}}) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(status({x, bent, x}, {{"v", enough}}) == EMB_ERROR_UNSUPPORTED);
    CHECK(status({x, x, x}, {{"", enough}}) == EMB_ERROR_INVALID_ARGUMENT);
    CHECK(content(path).empty());
    CHECK(status({x, x, x}, {{"v", enough}}) == EMB_OK);
    std::remove(path.c_str());
}
