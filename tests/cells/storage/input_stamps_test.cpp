#include "cells/storage/input_stamps.hpp"

#include "support/catch.hpp"
#include "support/file_time.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using namespace facetmill::cells;

namespace {

constexpr std::int64_t long_since = 10000000000; // 10 s

/// The file as a run opens it, with a digest.
std::vector<FaceSource::File> opened(const std::filesystem::path& path) {
    std::vector<FaceSource::File> files{open_input(path)};
    files.front().sha256 = std::string(64, 'd');
    return files;
}

/// The digest that the next run finds.
std::vector<std::string> known(const CellFolder& folder, const std::filesystem::path& path) {
    return InputStamps(opened(path)).digests(folder);
}

/// The digest that is stored if the file is 10 s old and unchanged.
std::vector<std::string> stamped(const CellFolder& folder, const std::filesystem::path& path) {
    const auto files = opened(path);
    InputStamps(files, InputStamps::now() + long_since).store(folder, files);
    return known(folder, path);
}

} // namespace

TEST_CASE("a digest is taken from a stamp as long as the file is as it was", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = folder / "m.ply";
    const CellFolder kept({folder / "kept", false});
    test::put(path, "contents");
    const std::vector<std::string> digests{std::string(64, 'd')};
    CHECK(stamped(kept, path) == digests);

    const auto modified = std::filesystem::last_write_time(path);
    test::let_file_time_pass(folder.path());
    test::put(path, "CONTENTS"); // as long, and as old as far as one sees
    std::filesystem::last_write_time(path, modified);
    CHECK(known(kept, path).empty());

    CHECK(stamped(kept, path) == digests);
    test::put(folder / "other", "CONTENTS");
    std::filesystem::rename(folder / "other", path); // another file of that name
    CHECK(known(kept, path).empty());

    CHECK(stamped(kept, path) == digests);
    const io::Bytes stored = *kept.read("facetmill-cells.inputs");
    std::string text(reinterpret_cast<const char*>(stored.data()), stored.size());
    text[text.find("dddd")] = 'e';
    test::put(folder / "kept/facetmill-cells.inputs", text);
    CHECK(known(kept, path).empty());
}

TEST_CASE("a file that was just written, or is written to, gets no stamp", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = folder / "m.ply";
    const CellFolder kept({folder / "kept", false});
    test::put(path, "contents");
    CHECK(stamped(kept, path).size() == 1);
    const auto files = opened(path);
    InputStamps(files).store(kept, files); // at once
    CHECK_FALSE(std::filesystem::exists(folder / "kept/facetmill-cells.inputs"));

    const InputStamps before(files, InputStamps::now() + long_since);
    test::put(path, "more contents");
    before.store(kept, files);
    CHECK_FALSE(std::filesystem::exists(folder / "kept/facetmill-cells.inputs"));
}

TEST_CASE("a stamp that cannot be written is no error", "[cells]") {
    const test::TemporaryDirectory folder;
    const CellFolder kept({folder / "kept", false});
    test::put(folder / "m.ply", "contents");
    CHECK(stamped(kept, folder / "m.ply").size() == 1);
    std::filesystem::create_directories(folder / "kept/facetmill-cells.inputs.part/in the way");
    CHECK(stamped(kept, folder / "m.ply").empty());
    CHECK_FALSE(std::filesystem::exists(folder / "kept/facetmill-cells.inputs"));
}

TEST_CASE("a stamp is that of the file that was read, whatever its name means since then", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto link = folder / "link.ply";
    const CellFolder kept({folder / "kept", false});
    test::put(folder / "a.ply", "contents");
    test::put(folder / "b.ply", "CONTENTS");
    std::filesystem::create_symlink("a.ply", link);
    const auto files = opened(link);
    std::filesystem::remove(link);
    std::filesystem::create_symlink("b.ply", link);
    InputStamps(files, InputStamps::now() + long_since).store(kept, files);
    CHECK(known(kept, link).empty());
    CHECK(known(kept, folder / "a.ply").size() == 1);
}
