// Random meshes through random chains of stages. FACETMILL_CHAINS=FIRST:COUNT selects the seeds.
// tests/fuzz/fuzz_stages.cpp runs them for a given time.
#include "support/catch.hpp"
#include "support/stage_chains.hpp"

#include <cstdlib>

using namespace facetmill;

namespace {

/// Which seeds to run.
std::pair<std::uint64_t, std::uint64_t> seeds_to_run() {
    const char* text = std::getenv("FACETMILL_CHAINS");
    if (!text) return {1, 40};
    char* colon = nullptr;
    const std::uint64_t first = std::strtoull(text, &colon, 10);
    return {first, *colon == ':' ? std::strtoull(colon + 1, nullptr, 10) : 1};
}

} // namespace

TEST_CASE("law: a chain of stages ends in a sound scene or in an error that tells why", "[property]") {
    const test::TemporaryDirectory folder;
    test::put_files(folder.path());
    const auto [first, count] = seeds_to_run();
    std::size_t stages = 0, done = 0;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        test::Draw draw(seed);
        const test::Chain chain = test::random_chain(draw);
        INFO("seed " << seed << ": " << chain.described());
        const test::Verdict verdict =
            test::judge(chain, folder.path(), draw.word({"glb", "ply", "obj", "off", "stl"}));
        CHECK(verdict.wrong == "");
        stages += chain.links.size();
        done += verdict.stages_done;
    }
    CHECK((count < 40 || 2 * done > stages)); // a test of refusals only would be meaningless
}
