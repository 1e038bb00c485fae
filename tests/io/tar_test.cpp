#include "support/catch.hpp"

#include "base/error.hpp"
#include "io/tar.hpp"

#include <map>

using namespace facetmill;
using namespace facetmill::io;

namespace {

Bytes tar_of(const std::vector<std::pair<std::string, std::string>>& files) {
    Bytes out;
    const auto put = [&](Span bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); };
    for (const auto& [path, text] : files) put_tar_file(path, bytes_of_text(text), put);
    put_tar_end(put);
    return out;
}

std::map<std::string, std::string> files_in(Span archive) {
    std::map<std::string, std::string> files;
    read_tar(archive, "a.tar", [&](const std::string& path, Span bytes) { files[path] = as_text(bytes); });
    return files;
}

} // namespace

TEST_CASE("a tar holds files with names of any length", "[tar]") {
    const std::string longer(300, 'x');
    const Bytes tar = tar_of({{"a.obj", "v 0 0 0"}, {"b/" + longer, std::string(513, 'b')}, {"empty", ""}});
    CHECK(tar.size() % 512 == 0);
    const auto files = files_in(tar);
    CHECK(files.size() == 3);
    CHECK(files.at("a.obj") == "v 0 0 0");
    CHECK(files.at("b/" + longer) == std::string(513, 'b'));
    CHECK(files.at("empty").empty());
}

TEST_CASE("a tar that lies about its sizes is refused", "[tar]") {
    Bytes tar = tar_of({{"a.obj", "v 0 0 0"}});
    CHECK_THROWS_AS(files_in(Span(tar).first(515)), Error);
    CHECK_THROWS_AS(files_in(Span(tar).first(100)), Error);
    Bytes size = tar;
    size[124 + 3] = std::byte{'7'}; // the checksum no longer fits
    CHECK_THROWS_AS(files_in(size), Error);
    for (std::size_t i = 0; i < 12; ++i) size[124 + i] = std::byte{'7'};
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < 512; ++i)
        sum += i >= 148 && i < 156 ? ' ' : std::to_integer<std::uint64_t>(size[i]);
    for (std::size_t i = 0; i < 6; ++i)
        size[148 + i] = static_cast<std::byte>('0' + (sum >> (3 * (5 - i)) & 7));
    CHECK_THROWS_AS(files_in(size), Error); // a right checksum, but more bytes than the archive
    CHECK(files_in({}).empty());
}
