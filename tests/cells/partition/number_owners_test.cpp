#include "cells/partition/number_owners.hpp"

#include "support/catch.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

TEST_CASE("leaves of a vertex are found once each, however often its faces alternate between them",
          "[cells]") {
    const test::TemporaryDirectory folder;
    constexpr std::uint32_t numbers = 3000, lists = 50;
    NumberOwners owners(numbers, folder / "", 1, 1 << 20);
    std::vector<std::uint32_t> leaf_of(lists);
    for (std::uint32_t list = 0; list < lists; ++list) leaf_of[list] = lists - 1 - list;
    leaf_of[7] = NumberOwners::nobody; // divided
    for (std::uint32_t turn = 0; turn < 20000; ++turn)
        for (std::uint32_t list = 0; list < lists; list += 2) owners.add(17, (list + turn) % lists);
    for (const std::uint32_t list : {3, 4, 3, 5}) owners.add(2000, list);
    owners.add(2500, 9); // no other list has it
    owners.finish();

    std::vector<Owned> expected;
    for (std::uint32_t leaf = 0; leaf < lists; ++leaf)
        if (leaf != lists - 1 - 7) expected.push_back({17, leaf});
    for (const std::uint32_t leaf : {lists - 1 - 5, lists - 1 - 4, lists - 1 - 3})
        expected.push_back({2000, leaf});
    CHECK(owners.leaves(0, leaf_of) == expected);
    CHECK(owners.count() == 3);
}

TEST_CASE("numbers fit beside what dividing a leaf takes", "[cells]") {
    constexpr std::uint64_t megabyte = 1 << 20;
    CHECK(NumberOwners::fits(64 * megabyte / 6 / 4, 64 * megabyte));
    CHECK_FALSE(NumberOwners::fits(64 * megabyte / 6 / 4 + 1, 64 * megabyte));
    CHECK(NumberOwners::fits(146'000'000, 2048 * megabyte)); // of 292 million faces
    CHECK_FALSE(NumberOwners::fits(170'000'000, 2048 * megabyte));
}
