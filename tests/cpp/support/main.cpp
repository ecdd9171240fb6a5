// SPDX-License-Identifier: MIT OR Apache-2.0
// Runs the tests of the file it is linked with. With arguments: only those whose name contains one.
#include "check.hpp"

#include <exception>

int main(int argc, char **argv) {
    int ran = 0;
    for (const check::Test &test : check::tests()) {
        bool chosen = argc < 2;
        for (int i = 1; i < argc; ++i) {
            chosen = chosen || std::strstr(test.name, argv[i]) != nullptr;
        }
        if (!chosen) {
            continue;
        }
        const int before = check::failures();
        try {
            test.run();
        } catch (const std::exception &error) {
            check::that(false, error.what(), test.name, 0);
        } catch (...) {
            check::that(false, "no exception", test.name, 0);
        }
        std::printf("%-4s %s\n", check::failures() == before ? "ok" : "FAIL", test.name);
        std::fflush(stdout);
        ++ran;
    }
    std::printf("%d tests, %d checks failed\n", ran, check::failures());
    return ran > 0 && check::failures() == 0 ? 0 : 1;
}
