#include "cells/storage/stream.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/file_time.hpp"
#include "support/temporary.hpp"

#include <cstring>
#include <fstream>
#include <numeric>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

constexpr std::uint32_t stream_numbers = 300000;

/// A file of the numbers 0, 1, 2 ... after four bytes.
std::filesystem::path file_of_numbers(const test::TemporaryDirectory& folder) {
    std::vector<std::uint32_t> all(stream_numbers + 1);
    std::iota(all.begin(), all.end(), UINT32_MAX);
    const auto path = folder / "numbers";
    test::put(path, {reinterpret_cast<const char*>(all.data()), all.size() * sizeof all[0]});
    return path;
}

std::uint32_t number_of(const std::byte* at) {
    std::uint32_t n = 0;
    std::memcpy(&n, at, sizeof n);
    return n;
}

} // namespace

TEST_CASE("a stream gives a file piece by piece", "[cells]") {
    const test::TemporaryDirectory folder;
    const ReadFile file(file_of_numbers(folder));
    Sha256 sum;
    Stream stream(file, 4, 4 + 4 * stream_numbers, &sum);
    std::uint32_t expected = 0;
    bool equal = true;
    for (std::size_t size = 1; stream.left() > 0; size = size % 997 + 1) {
        const auto n = std::min<std::uint64_t>(size, stream.left() / 4);
        const std::byte* at = stream.take(static_cast<std::size_t>(4 * n));
        for (std::uint64_t i = 0; i < n; ++i) equal &= number_of(at + 4 * i) == expected++;
    }
    CHECK(equal);
    CHECK(expected == stream_numbers);
    const std::string whole = test::get(folder / "numbers").substr(4);
    CHECK(sum.digest() == sha256(test::bytes_of(whole)));
}

TEST_CASE("records are looked up in any order with little memory", "[cells]") {
    const test::TemporaryDirectory folder;
    const ReadFile file(file_of_numbers(folder));
    for (const std::size_t memory : {std::size_t{0}, std::size_t{400000}, std::size_t{1} << 24}) {
        RecordCache cache(file, 4, 4, stream_numbers, memory);
        bool equal = true;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            const std::uint64_t n = (i % 2 ? i : hashed(3, i)) % stream_numbers;
            equal &= number_of(cache.at(n)) == n;
        }
        CHECK(equal);
        CHECK(number_of(cache.at(stream_numbers - 1)) == stream_numbers - 1);
    }
    const std::vector<std::uint32_t> some{0, 1, 5, 6, 5000, 299998, 299999};
    const io::Bytes read = read_records(file, 4, 4, some);
    for (std::size_t i = 0; i < some.size(); ++i) CHECK(number_of(read.data() + 4 * i) == some[i]);
}

TEST_CASE("a file that got shorter is refused", "[cells]") {
    const test::TemporaryDirectory folder;
    const ReadFile file(file_of_numbers(folder));
    io::Bytes bytes(100);
    CHECK(test::failure_id([&] { file.read(4 * stream_numbers, bytes); }) == "E-CHANGED");
    CHECK(test::failure_id([&] { ReadFile(folder / "none"); }) == "E-FILE");
}

TEST_CASE("records that somebody has read are not read again", "[cells]") {
    const test::TemporaryDirectory folder;
    const ReadFile file(file_of_numbers(folder));
    CHECK_FALSE(RecordCache(file, 4, 4, stream_numbers, 4 * stream_numbers / 2).holds_all());
    RecordCache records(file, 4, 4, stream_numbers, 8 * stream_numbers);
    REQUIRE(records.holds_all());
    for (std::uint32_t i = 0; i < stream_numbers; ++i) {
        const std::uint32_t other = 3 * i; // which the file has not
        records.append(reinterpret_cast<const std::byte*>(&other));
    }
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < stream_numbers; ++i) wrong += number_of(records.at(i)) != 3 * i;
    CHECK(wrong == 0);
}

TEST_CASE("an open file tells whether it is as it was", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = folder / "numbers";
    test::put(path, "12345678");
    const ReadFile file(path);
    REQUIRE(file.stamp());
    CHECK(file.stamp()->bytes == 8);
    CHECK(file.stamp() == FileStamp::of(path));
    CHECK(file.is_as_opened());
    std::filesystem::rename(path, folder / "others"); // it is open
    test::put(path, "12");
    CHECK(file.has_same_contents());
    CHECK(file.stamp() != FileStamp::of(path));
    test::let_file_time_pass(folder.path());
    std::filesystem::create_hard_link(folder / "others", folder / "again");
    CHECK(file.has_same_contents());
    CHECK_FALSE(file.is_as_opened());
    std::ofstream(folder / "again", std::ios::app) << "90";
    CHECK_FALSE(file.has_same_contents());
    CHECK_FALSE(FileStamp::of(folder / "none"));
}
