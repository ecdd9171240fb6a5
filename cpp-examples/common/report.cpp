// SPDX-License-Identifier: MIT OR Apache-2.0
#include "report.hpp"

#include <charconv>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

std::string in_words(double time) {
    char text[32];
    const bool small = time < 1.0;
    std::snprintf(text, sizeof text, "%.3g %s", small ? 1e3 * time : time, small ? "ms" : "s");
    return text;
}

const char *in_words(embound::Kind kind) {
    switch (kind) {
    case embound::Kind::Exact: return "exact";
    case embound::Kind::LowerBound: return "lower bound";
    default: return "sign only";
    }
}

void fail(const std::string &message) { throw std::runtime_error(message); }

std::uint64_t whole_number(const std::string &argument) {
    std::uint64_t number = 0;
    const char *const end = argument.data() + argument.size();
    const auto read = std::from_chars(argument.data(), end, number);
    require(read.ec == std::errc() && read.ptr == end, "\"" + argument + "\" is not a whole number");
    return number;
}

void print_library(const embound::Pool &pool) {
    const std::uint32_t version = emb_version_number();
    std::printf("embound       %u.%u.%u, %s instructions, %zu thread%s\n", version / 10000, version / 100 % 100, version % 100,
                emb_isa(), pool.width(), pool.width() == 1 ? "" : "s");
}

std::string in_demo_out(const std::string &file) {
    const std::filesystem::path out = "demo-out";
    std::filesystem::create_directories(out);
    return (out / file).string();
}

int run_example(const char *name, void (*example)(int argc, char **argv), int argc, char **argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ); // each line as it comes, also into a pipe
    try {
        example(argc, argv);
    } catch (const embound::Error &error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        if (error.status() == EMB_ERROR_TOPOLOGY) {
            std::fprintf(stderr, "%s: the mesh cannot be given a sign: it has no inside but for a guess\n", name);
        }
        return 1;
    } catch (const std::exception &error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return 1;
    }
    return 0;
}
