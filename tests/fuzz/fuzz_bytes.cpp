// Runs libFuzzer on the readers (support/fuzz_targets.hpp): FACETMILL_TARGET=ply fuzz_bytes [options]
// CORPUS... `make fuzz TARGET=ply` builds it with clang, AddressSanitizer and UndefinedBehaviorSanitizer. It
// stops at the first fault and writes the bytes to a file. Add that file to tests/data/fuzz/TARGET after the
// fix.

#include "support/fuzz_targets.hpp"

#include <cstdio>
#include <cstdlib>

using namespace facetmill;

namespace {

const test::FuzzTarget* chosen = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    const char* const name = std::getenv("FACETMILL_TARGET");
    for (const auto& target : test::fuzz_targets)
        if (name && target.name == name) chosen = &target;
    if (chosen) return 0;
    std::fputs("FACETMILL_TARGET is to be one of:", stderr);
    for (const auto& target : test::fuzz_targets) std::fprintf(stderr, " %s", target.name.data());
    std::fputs("\n", stderr);
    std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    const auto* const begin = reinterpret_cast<const std::byte*>(data);
    const std::string trouble = chosen->trouble({begin, begin + size});
    if (trouble.empty()) return 0;
    std::fprintf(stderr, "%s: %s\n", chosen->name.data(), trouble.c_str());
    std::abort();
}
