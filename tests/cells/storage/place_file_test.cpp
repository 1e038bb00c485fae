#include "cells/storage/place_file.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

TEST_CASE("places are read as they were written", "[cells]") {
    const test::TemporaryDirectory folder;
    PlaceFile file(folder.path());
    std::vector<std::size_t> given{0, 0, 63, 64, 0, 2097151, 2097151, 1};
    for (std::uint64_t i = 0; i < 10000; ++i) given.push_back(hashed(1, i) % (i % 7 == 0 ? 2097152 : 200));
    for (const std::size_t place : given) file.add(place);
    PlaceFile::Reader reader = file.finish();
    std::vector<std::size_t> got;
    for (std::size_t i = 0; i < given.size(); ++i) got.push_back(reader.next(2097152));
    CHECK(got == given);
    CHECK(test::failure_id([&] { reader.next(2097152); }) == "E-SCRATCH");
    CHECK(folder.names().empty());

    PlaceFile other(folder.path());
    other.add(500);
    PlaceFile::Reader beyond = other.finish();
    CHECK(test::failure_id([&] { beyond.next(500); }) == "E-SCRATCH");
}
