#include "cells/storage/block_file.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <array>

using namespace facetmill;
using namespace facetmill::cells;

TEST_CASE("a spool gives each list what it was given", "[cells]") {
    const test::TemporaryDirectory folder;
    constexpr std::size_t lists = 7;
    SpillFile spool(folder.path(), lists, 4000);
    std::vector<io::Bytes> given(lists);
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const auto list = static_cast<std::size_t>(hashed(1, i) % (lists - 1)); // the last stays empty
        const auto record = std::as_bytes(std::span(&i, 1));
        spool.add(list, record);
        given[list].insert(given[list].end(), record.begin(), record.end());
    }
    spool.flush();
    for (std::size_t list = 0; list < lists; ++list) {
        CHECK(spool.size(list) == given[list].size());
        CHECK(spool.read(list) == given[list]);
        if (given[list].size() < 1000) continue;
        const auto part = io::Span(given[list]).subspan(600, 300);
        CHECK(spool.read(list, 600, 300) == io::Bytes(part.begin(), part.end()));
    }
    CHECK(folder.names().empty());
}

TEST_CASE("a spool of numbers gives what it was given, in fewer bytes", "[cells]") {
    const test::TemporaryDirectory folder;
    SpillFile spool(folder.path(), 2, 4000, SpillFile::Records::numbers);
    std::vector<io::Bytes> given(2);
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const std::array<std::uint32_t, 3> record{i, i + 1,
                                                  i % 2 ? i + 20 : static_cast<std::uint32_t>(hashed(1, i))};
        const auto bytes = std::as_bytes(std::span(record));
        spool.add(i % 3 == 0, bytes);
        given[i % 3 == 0].insert(given[i % 3 == 0].end(), bytes.begin(), bytes.end());
    }
    spool.flush();
    for (std::size_t list = 0; list < 2; ++list) {
        CHECK(spool.size(list) == given[list].size());
        CHECK(spool.read(list) == given[list]);
        const auto part = io::Span(given[list]).subspan(4800, 12000);
        CHECK(spool.read(list, 4800, 12000) == io::Bytes(part.begin(), part.end()));
    }
    std::vector<Block> blocks;
    const SpillFile stored = spool.stored(folder / "kept", {1, 0}, false, blocks); // copied unchanged
    CHECK(std::filesystem::file_size(folder / "kept") == given[0].size() + given[1].size());
    CHECK(stored.read(0) == given[1]);
    CHECK(stored.read(1) == given[0]);
}

TEST_CASE("a block that is not as it was written is refused", "[cells]") {
    const test::TemporaryDirectory folder;
    BlockFile file(folder.path());
    const io::Bytes bytes(1000, std::byte{5});
    Block block = file.put(bytes);
    CHECK(file.get(block) == bytes);
    block.digest ^= 1;
    CHECK(test::failure_id([&] { file.get(block); }) == "E-SCRATCH");
    block.digest ^= 1;
    block.size += 8; // beyond the end
    CHECK(test::failure_id([&] { file.get(block); }) == "E-SCRATCH");
    CHECK(test::failure_id([&] { BlockFile(folder / "not there"); }) == "E-WRITE");
}
