#include "cells/storage/cell_folder.hpp"

#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

using Found = CellFolder::Found;

const std::string some_key(64, 'a'), another_key(64, 'b');

} // namespace

TEST_CASE("a file of a cell folder is whole, and known by its key", "[cells]") {
    const test::TemporaryDirectory folder;
    const CellFolder cells({folder / "deep" / "k"});
    io::Bytes bytes(1000, std::byte{5});
    Found found{};
    CHECK_FALSE(cells.get("x.1", some_key, found));
    CHECK(found == Found::nothing);
    cells.put("x.1", some_key, bytes);
    CHECK(cells.get("x.1", some_key, found) == bytes);
    CHECK(found == Found::as_written);
    CHECK_FALSE(cells.get("x.1", another_key, found));
    CHECK(found == Found::damaged);
    cells.put("x.1", another_key, {}); // replaces it
    CHECK(cells.get("x.1", another_key, found) == io::Bytes{});
    cells.put("x.2", some_key, bytes);
    CHECK(cells.names("x.") == std::vector<std::string>{"x.1", "x.2"});
    cells.remove("x.1");
    CHECK(cells.names("x.") == std::vector<std::string>{"x.2"});
    std::filesystem::copy_file(cells.file("x.2"), cells.file("x.3")); // of another place
    CHECK_FALSE(cells.get("x.3", some_key, found));
    const std::size_t size = std::filesystem::file_size(cells.file("x.2"));
    for (std::size_t left = 0; left < size; left += 37) {
        std::filesystem::resize_file(cells.file("x.2"), left);
        CHECK_FALSE(cells.get("x.2", some_key, found));
        CHECK(found == Found::damaged);
        cells.put("x.2", some_key, bytes);
    }
}

TEST_CASE("a cell folder is for one run at a time", "[cells]") {
    const test::TemporaryDirectory folder;
    {
        const CellFolder first({folder.path()});
        CHECK(test::failure_id([&] { CellFolder({folder.path()}); }) == "E-BUSY");
    }
    const CellFolder then({folder.path()});
    test::TemporaryDirectory other;
    std::ofstream(other / "file") << "x";
    CHECK(test::failure_id([&] { CellFolder({other / "file"}); }) == "E-WRITE");
}
