// SPDX-License-Identifier: MIT OR Apache-2.0
// A test is a block of code with a name; CHECK says what does not hold and carries on.
#ifndef EMBOUND_TESTS_CHECK_HPP
#define EMBOUND_TESTS_CHECK_HPP

#include <embound.hpp>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace check {

struct Test {
    const char *name;
    void (*run)();
};

inline std::vector<Test> &tests() {
    static std::vector<Test> all;
    return all;
}

inline int &failures() {
    static int count = 0;
    return count;
}

inline bool add(const char *name, void (*run)()) {
    tests().push_back({name, run});
    return true;
}

inline void that(bool holds, const char *what, const char *file, int line) {
    if (!holds) {
        std::printf("%s:%d: does not hold: %s\n", file, line, what);
        ++failures();
    }
}

// The same 64 bits, NaN included.
inline bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

template <class T> bool same_bits(const std::vector<T> &a, const std::vector<T> &b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

// What `work` throws: the status of an embound::Error, EMB_OK where it throws nothing. The message
// must name `word`.
template <class Work> emb_status status_of(Work &&work, const std::string &word = "") {
    try {
        work();
    } catch (const embound::Error &error) {
        const bool named = std::string(error.what()).find(word) != std::string::npos;
        that(named, (std::string("message names ") + word + ": " + error.what()).c_str(), __FILE__, __LINE__);
        return error.status();
    }
    return EMB_OK;
}

// What `work` throws as a T, or `none`.
template <class T, class Work> T thrown(Work &&work, T none) {
    try {
        work();
    } catch (const T &value) {
        return value;
    }
    return none;
}

// `n` coordinates from lo to hi.
inline std::vector<double> axis(double lo, double hi, std::size_t n) {
    std::vector<double> coordinates(n);
    for (std::size_t i = 0; i < n; ++i) {
        coordinates[i] = lo + (hi - lo) * static_cast<double>(i) / static_cast<double>(n - 1);
    }
    return coordinates;
}

} // namespace check

#define CHECK(condition) check::that((condition), #condition, __FILE__, __LINE__)
#define TEST(name)                                                                                                               \
    static void name();                                                                                                          \
    [[maybe_unused]] static const bool name##_added = check::add(#name, name);                                                   \
    static void name()

#endif
