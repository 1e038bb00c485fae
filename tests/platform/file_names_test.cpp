#include "support/catch.hpp"

#include "platform/descriptor.hpp"
#include "platform/file_bytes.hpp"
#include "platform/file_lock.hpp"
#include "platform/file_names.hpp"
#include "platform/file_status.hpp"
#include "platform/free_space.hpp"
#include "platform/pages.hpp"
#include "platform/temporary_files.hpp"

#include <cerrno>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

using namespace facetmill;
namespace fs = std::filesystem;

namespace file_names_test {

namespace {

constexpr OpenOptions new_file{.what = OpenFor::writing, .create = Create::always};

std::span<const std::byte> bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string contents(const Descriptor& file) {
    std::string text(64, '\0');
    text.resize(read_at(file, 0, std::as_writable_bytes(std::span(text))));
    return text;
}

/// A folder for a test, which must remove its files.
struct Folder {
    fs::path path = temporary_folder("facetmill-platform-");
    Folder() { REQUIRE_FALSE(path.empty()); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { remove_folder(path); }
    fs::path operator/(const char* name) const { return path / fs::path(name); }
};

void write_file(const fs::path& path, std::string_view text) {
    const Descriptor file = open_file(path, new_file);
    REQUIRE(file);
    CHECK(write_some(file, bytes(text)) == text.size());
}

} // namespace

TEST_CASE("Files keep all bytes, whatever their names", "[platform]") {
    const Folder folder;
    const std::string_view text("one\r\ntwo\n\x1a more");
    const fs::path name = folder / "Größe 漢字 𝄞.bin";
    CHECK(name.filename().string() == "Größe 漢字 𝄞.bin");
    write_file(name, text);
    CHECK(contents(open_file(name)) == text);
    CHECK_FALSE(open_file(name, new_file));
    CHECK(errno == EEXIST);
    {
        const Descriptor more = open_file(name, {.what = OpenFor::writing, .appends = true});
        CHECK(write_some(more, bytes("!")) == 1);
        const Descriptor file = open_file(name);
        CHECK(contents(file) == std::string(text) + "!");
        CHECK(status_of(file)->stamp.bytes == text.size() + 1);
        const auto mapped = map_file(file, text.size());
        REQUIRE(mapped);
        CHECK(std::string_view(static_cast<const char*>(mapped.get()), text.size()) == text);
    }
    CHECK(touch_file(name));
    CHECK(std::abs(status_of(name)->stamp.modified - nanoseconds_now()) < 60'000'000'000);
    CHECK(remove_file(name));
    CHECK_FALSE(remove_file(name));
    CHECK(errno == ENOENT);
}

TEST_CASE("A renamed file replaces one that is open", "[platform]") {
    const Folder folder;
    const fs::path older = folder / "older", newer = folder / "newer";
    write_file(older, "old");
    write_file(newer, "newer");
    const Descriptor reader = open_file(older);
    CHECK(rename_file(newer, older));
    CHECK(contents(reader) == "old");
    CHECK(contents(open_file(older)) == "newer");
    CHECK_FALSE(status_of(newer));
    CHECK_FALSE(FileStamp::of(reader)->is_same_file(*FileStamp::of(older)));
    CHECK(remove_file(older));
}

TEST_CASE("A lock holds until its file is closed", "[platform]") {
    const Folder folder;
    const fs::path name = folder / "lock";
    write_file(name, "text");
    {
        Descriptor first = open_file(name);
        const Descriptor second = open_file(name);
        CHECK(try_lock(first));
        CHECK(try_lock(first)); // again
        CHECK_FALSE(try_lock(second, Lock::shared));
        CHECK(errno == EWOULDBLOCK);
        CHECK(contents(second) == "text");
        CHECK(first.close());
        CHECK(try_lock(second, Lock::shared));
        const Descriptor third = open_file(name);
        CHECK(try_lock(third, Lock::shared));
        CHECK_FALSE(try_lock(third));
    }
    CHECK(remove_file(name));
}

TEST_CASE("Folders have a status, and are removed when they are empty", "[platform]") {
    const Folder folder;
    const fs::path inner = folder / "inner";
    CHECK(make_folder(inner));
    CHECK_FALSE(make_folder(inner));
    CHECK(errno == EEXIST);
    CHECK(status_of(inner)->kind == FileKind::folder);
    CHECK(may_write_in(inner));
    CHECK(synced(open_file(inner, {.is_folder = true})));
    write_file(inner / "file", "");
    CHECK_FALSE(remove_folder(inner));
    CHECK(remove_file(inner / "file"));
    CHECK(free_space(inner).value_or(0) > 0);
    CHECK(remove_folder(inner));
    CHECK_FALSE(status_of(inner));
}

TEST_CASE("Paths may have more than 260 characters", "[platform]") {
    const Folder folder;
    std::vector<fs::path> folders{folder.path};
    for (int i = 0; i < 4; ++i) {
        folders.push_back(folders.back() / std::string(100, 'd'));
        CHECK(make_folder(folders.back()));
    }
    const fs::path name = folders.back() / "file", other = folders.back() / "other";
    write_file(name, "far");
    CHECK(fs::exists(name));
    CHECK(rename_file(name, other));
    CHECK(contents(open_file(other)) == "far");
    CHECK(remove_file(other));
    for (std::size_t i = folders.size() - 1; i > 0; --i) CHECK(remove_folder(folders[i]));
}

TEST_CASE("What ended processes left is removed", "[platform]") {
    const Folder folder;
    CHECK(is_running(process_id()));
    CHECK(writer_of(temporary_name("x.glb", 2)) == process_id());
    CHECK(temporary_name("x/" + std::string(300, 'a'), 0).size() <= 255);
    write_file(folder / ".x.glb.facetmill-999999999~", "x");
    remove_abandoned(folder.path);
    CHECK_FALSE(status_of(folder / ".x.glb.facetmill-999999999~"));
    const Descriptor unnamed = unnamed_file(folder.path);
    CHECK(write_at(unnamed, 5, bytes("far")));
    CHECK(status_of(unnamed)->stamp.bytes == 8);
}

TEST_CASE("Names of devices are reserved on Windows only", "[platform]") {
#ifdef _WIN32
    constexpr bool on_windows = true;
#else
    constexpr bool on_windows = false;
#endif
    for (const char* name :
         {"NUL", "nul.txt", "aux.glb", "x/COM1.ply", "ab:c.glb", "a?.b", "end.", "end ", "con .glb", "lpt9"})
        CHECK(is_reserved_name(name) == on_windows);
    for (const char* name : {"null.txt", "com.ply", "com10.ply", "a.b", "-", "..", "aux1.glb", "dir/"})
        CHECK_FALSE(is_reserved_name(name));
    CHECK((comparable_name("ÄB.glb") == comparable_name("äb.GLB")) == on_windows);
}

} // namespace file_names_test
