// Damages mesh files for as long as it is let: fuzz_io SECONDS FILE... Prints the file and seed of everything
// that is neither refused nor sound, and ends with 1 when there was any. Build it with the asan preset.

#include "support/mutations.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

using namespace facetmill;

int main(int count, char** arguments) {
    if (count < 3) {
        std::fprintf(stderr, "fuzz_io SECONDS FILE...\n");
        return 2;
    }
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(arguments[1]));
    std::size_t runs = 0, troubles = 0;
    for (std::uint64_t seed = 0; std::chrono::steady_clock::now() < end; ++seed)
        for (int i = 2; i < count; ++i) {
            const auto input = io::Input::open(arguments[i]);
            const std::string name = std::filesystem::path(arguments[i]).filename().string();
            const std::string trouble = test::trouble_reading(
                name, test::mutated({input.bytes().begin(), input.bytes().end()}, seed));
            ++runs;
            if (trouble.empty()) continue;
            ++troubles;
            std::printf("%s, seed %llu: %s\n", arguments[i], static_cast<unsigned long long>(seed),
                        trouble.c_str());
        }
    std::printf("%zu files, %zu troubles\n", runs, troubles);
    return troubles > 0;
}
