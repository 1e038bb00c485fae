#include "support/catch.hpp"

#include "io/packing.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <fstream>
#include <sys/stat.h>
#include <thread>

using namespace facetmill;
using namespace facetmill::test;
using io::Input;

TEST_CASE("a file is read whole", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "a", std::string(100000, 'x'));
    const Input input = Input::open(dir / "a");
    CHECK(input.bytes().size() == 100000);
    CHECK(input.path() == dir / "a");
    put(dir / "empty", "");
    CHECK(Input::open(dir / "empty").bytes().empty());
}

TEST_CASE("gzip is inflated, members one after another, and its stored bytes are known", "[io]") {
    const TemporaryDirectory dir;
    const std::string text(300000, 'y');
    const io::Bytes packed = io::packed(bytes_of(text), io::Packing::gzip);
    std::string two;
    for (int i = 0; i < 2; ++i) two += std::string(io::as_text(packed));
    put(dir / "a.gz", two);
    const Input input = Input::open(dir / "a.gz");
    CHECK(io::as_text(input.bytes()) == text + text);
    CHECK(io::as_text(input.stored()) == two);
    CHECK(
        failure([&] { Input::open(dir / "a.gz", 1000); }) ==
        fmt::format("limit [E-SIZE] '{}' gives more than 1000 bytes | write it to a file first, uncompressed",
                    (dir / "a.gz").string()));
    put(dir / "cut.gz", two.substr(0, packed.size() - 20));
    CHECK(failure([&] { Input::open(dir / "cut.gz"); }) ==
          fmt::format("malformed [E-GZIP] '{}' cannot be decompressed as gzip: it ends early near byte {}",
                      (dir / "cut.gz").string(), packed.size() - 20));
}

TEST_CASE("a file that is mapped and changes is no longer as it was opened", "[io]") {
    const TemporaryDirectory dir;
    put(dir / "small", "x");
    put(dir / "large", "");
    std::filesystem::resize_file(dir / "large", 64 << 20); // no block of it is on the disk
    const Input small = Input::open(dir / "small"), large = Input::open(dir / "large");
    CHECK(large.is_as_opened());
    for (const char* name : {"small", "large"})
        std::filesystem::last_write_time(dir / name, std::filesystem::file_time_type::clock::now() +
                                                         std::chrono::seconds(1));
    CHECK(small.is_as_opened()); // its bytes are a copy
    CHECK_FALSE(large.is_as_opened());
    const Input again = Input::open(dir / "large");
    CHECK(again.is_as_opened());
    std::filesystem::remove(dir / "large");
    CHECK_FALSE(again.is_as_opened());
}

TEST_CASE("what has been read of a mapped file can be given back, and read again", "[io]") {
    const TemporaryDirectory dir;
    const std::string text(std::size_t{20} << 20, 'x');
    put(dir / "large", text);
    put(dir / "small", "x");
    const Input large = Input::open(dir / "large"), small = Input::open(dir / "small");
    const auto resident = [] { // kB of files that this process has in memory
        std::ifstream status("/proc/self/status");
        std::size_t kib = 0;
        for (std::string key; status >> key;)
            if (std::size_t some = 0; (key == "RssFile:" || key == "RssShmem:") && status >> some) // tmpfs
                kib += some;
        return kib;
    };
    CHECK(io::as_text(large.bytes()) == text);
    const std::size_t before = resident();
    large.release(large.bytes().subspan(5));
    small.release(small.bytes()); // a copy
    CHECK(resident() + (std::size_t{19} << 10) < before);
    CHECK(io::as_text(large.bytes()) == text);
    CHECK(io::as_text(small.bytes()) == "x");
    const Input other = Input::of("other", io::Bytes(text.size(), std::byte{'x'}));
    large.release(other.bytes()); // not its own
    CHECK(io::as_text(other.bytes()) == text);
}

TEST_CASE("a pipe is read to its end, within a limit", "[io]") {
    const TemporaryDirectory dir;
    const auto fifo = dir / "fifo";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    for (const std::size_t limit : {std::size_t{1} << 20, std::size_t{10}}) {
        std::thread writer([&] { put(fifo, std::string(1000, 'z')); });
        std::string text;
        const std::string failed = failure([&] { text = io::as_text(Input::open(fifo, limit).bytes()); });
        writer.join();
        if (limit > 10) {
            CHECK(text == std::string(1000, 'z'));
        } else {
            CHECK(failed ==
                  fmt::format("limit [E-SIZE] '{}' gives more than 10 bytes | write it to a file first, "
                              "uncompressed",
                              fifo.string()));
        }
    }
}

TEST_CASE("a long pipe is read in pieces, up to exactly its limit", "[io]") {
    const TemporaryDirectory dir;
    const auto fifo = dir / "fifo";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    std::string text;
    for (int i = 0; text.size() < 700'000; ++i) text += fmt::format("{}\n", i);
    for (const std::size_t limit : {text.size() - 1, text.size(), text.size() + 1}) {
        std::thread writer([&] { put(fifo, text); });
        std::string read;
        const std::string failed = failure([&] { read = io::as_text(Input::open(fifo, limit).bytes()); });
        writer.join();
        CHECK((read == text) == (limit >= text.size()));
        CHECK((failed.find("E-SIZE") != std::string::npos) == (limit < text.size()));
    }
}

TEST_CASE("inputs that are not there are refused", "[io]") {
    const TemporaryDirectory dir;
    CHECK(failure([&] { Input::open(dir / "no"); }) ==
          fmt::format("missing [E-FILE] there is no file '{}'", (dir / "no").string()));
    CHECK(failure([&] { io::Input::open("no.scad"); })
              .starts_with(
                  "missing [E-FILE] there is no file 'no.scad' | its name suggests an OpenSCAD program"));
    CHECK(failure([&] { Input::open(dir.path()); }) ==
          fmt::format("missing [E-DIRECTORY] '{0}' is a directory, expected a file | give a file in it, or "
                      "(load, batch --input) a pattern for many files: '{0}/*.ply'",
                      dir.path().string()));
}

TEST_CASE("a device, and gzip that inflates as no mesh does, end at a limit", "[io]") {
    CHECK(
        failure([] { Input::open("/dev/zero"); }) ==
        "limit [E-SIZE] '/dev/zero' gives more than 67108864 bytes | write it to a file first, uncompressed");
    const TemporaryDirectory dir;
    const io::Bytes bomb = io::packed(io::Bytes(std::size_t{80} << 20), io::Packing::gzip);
    put(dir / "bomb.gz", std::string(io::as_text(bomb)));
    CHECK(failure([&] { Input::open(dir / "bomb.gz"); }) ==
          fmt::format("limit [E-SIZE] '{}' decompresses to more than 67108864 bytes from {}, which no mesh "
                      "does | if it is a mesh, decompress it first: gzip -d",
                      (dir / "bomb.gz").string(), bomb.size()));
}

TEST_CASE("a directory in the place of a file leads to the files in it", "[io]") {
    const test::TemporaryDirectory folder;
    try {
        Input::open(folder.path());
        FAIL("it was opened");
    } catch (const Error& error) {
        CHECK(error.diagnostics().front().id == "E-DIRECTORY");
        CHECK(error.diagnostics().front().hint ==
              "give a file in it, or (load, batch --input) a pattern for many files: '" +
                  (folder.path() / "*.ply").string() + "'");
    }
}
