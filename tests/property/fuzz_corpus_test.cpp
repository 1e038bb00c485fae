// Runs the fuzz targets on the seed files and on files that fuzzing found.
#include "support/catch.hpp"
#include "support/fuzz_targets.hpp"

#include <ctime>

using namespace facetmill;

TEST_CASE("what fuzzing has found stays mended", "[property][io]") {
    const std::filesystem::path corpus = std::filesystem::path(FACETMILL_SOURCE_DIR) / "tests/data/fuzz";
    for (const auto& target : test::fuzz_targets) {
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(corpus / target.name)) {
            const std::string text = test::get(entry.path());
            const auto bytes = test::bytes_of(text);
            INFO(entry.path());
            const std::clock_t start = std::clock();
            CHECK(target.trouble({bytes.begin(), bytes.end()}) == "");
            CHECK(std::clock() - start < 2 * CLOCKS_PER_SEC);
            ++files;
        }
        INFO(target.name);
        CHECK(files > 0);
    }
}
