#include "support/catch.hpp"

#include "io/packing.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;
using io::Packing;

TEST_CASE("zstd is decompressed, frames one after another, and its stored bytes are known", "[io]") {
    const TemporaryDirectory dir;
    std::string text;
    for (unsigned i = 0; i < 50000; ++i) text += fmt::format("v {} {} 0\n", i, i * i % 1009);
    const io::Bytes packed = io::packed(bytes_of(text), Packing::zstd);
    CHECK(packed.size() < text.size() / 3);
    CHECK(io::packed(bytes_of(text), Packing::zstd) == packed);
    const std::string frame(io::as_text(packed));
    put(dir / "a.zst", frame + frame);
    const io::Input input = io::Input::open(dir / "a.zst");
    CHECK(io::as_text(input.bytes()) == text + text);
    CHECK(io::as_text(input.stored()) == frame + frame);
    const auto opening = [&](const std::string& bytes, std::size_t most) {
        put(dir / "b.zst", bytes);
        const std::string name = (dir / "b.zst").string();
        std::string message = failure([&] { io::Input::open(dir / "b.zst", most); });
        if (const auto at = message.find(name); at != std::string::npos)
            message.replace(at, name.size(), "b");
        return message;
    };
    CHECK(opening(frame, SIZE_MAX) == "nothing");
    CHECK(opening(frame, text.size()) == "nothing");
    CHECK(opening(frame, text.size() - 1) ==
          fmt::format("limit [E-SIZE] 'b' gives more than {} bytes | write it to a file first, uncompressed",
                      text.size() - 1));
    CHECK(opening(frame.substr(0, frame.size() - 20), SIZE_MAX) ==
          fmt::format("malformed [E-ZSTD] 'b' cannot be decompressed as zstd: it ends early near byte {}",
                      frame.size() - 20));
    std::string changed = frame;
    changed[frame.size() / 2] = static_cast<char>(changed[frame.size() / 2] ^ 0x55);
    CHECK(opening(changed, SIZE_MAX).starts_with("malformed [E-ZSTD] 'b' cannot be decompressed as zstd: "));
    CHECK(opening(frame + "what follows", SIZE_MAX)
              .starts_with("malformed [E-ZSTD] 'b' cannot be decompressed as zstd: "));
}

TEST_CASE("zstd that unpacks as no mesh does, or wants a huge window, ends at a limit", "[io]") {
    const TemporaryDirectory dir;
    const io::Bytes bomb = io::packed(io::Bytes(std::size_t{80} << 20), Packing::zstd);
    put(dir / "bomb.zst", std::string(io::as_text(bomb)));
    CHECK(failure([&] { io::Input::open(dir / "bomb.zst"); }) ==
          fmt::format("limit [E-SIZE] '{}' decompresses to more than 67108864 bytes from {}, which no mesh "
                      "does | if it is a mesh, decompress it first: zstd -d",
                      (dir / "bomb.zst").string(), bomb.size()));
    // A frame header of RFC 8878 without a size: its window descriptor asks for 2 GiB.
    const std::string header{"\x28\xb5\x2f\xfd\x00\xa8\x01\x00\x00\x00\x00\x00", 12};
    put(dir / "window.zst", header);
    CHECK(failure([&] { io::Input::open(dir / "window.zst"); })
              .starts_with(fmt::format(
                  "malformed [E-ZSTD] '{}' cannot be decompressed as zstd: Frame requires too much memory",
                  (dir / "window.zst").string())));
}

TEST_CASE("names say how a file is compressed", "[io]") {
    CHECK(io::packing_named("a/b.ply.gz") == Packing::gzip);
    CHECK(io::packing_named("b.ply.ZST") == Packing::zstd);
    CHECK(io::packing_named("b.zst.ply") == Packing::none);
    CHECK(io::packing_named(".gz") == Packing::none);
    CHECK(io::without_packing("a/b.ply.zst") == "a/b.ply");
    CHECK(io::without_packing("b.ply") == "b.ply");
    const std::string text = "v 0 0 0\n";
    for (const Packing packing : {Packing::none, Packing::gzip, Packing::zstd}) {
        const io::Bytes bytes = io::packed(bytes_of(text), packing);
        CHECK(io::packing_of(bytes) == packing);
        CHECK(io::as_text(io::unpacked(bytes, packing, 1000, "x")) == text);
    }
}
