#include "support/catch.hpp"

#include "io/obj/obj.hpp"
#include "io/text.hpp"

#include <fmt/format.h>
#include <random>

using namespace facetmill;

namespace {

/// A random OBJ in pieces that are parsed separately, with every form of corner, and its expected content.
struct DrawnObj {
    std::string text;
    std::vector<Index> corners;
    std::vector<std::uint64_t> keys; ///< uv << 32 | normal
};

class ObjDrawer {
  public:
    explicit ObjDrawer(unsigned seed) : random_(seed) {}

    DrawnObj run(int plain_faces, int other_faces) {
        for (int v = 0; v < 50; ++v) out_.text += fmt::format("v {} 0 1\nvt 0 {}\nvn 1 0 {}\n", v, v, v);
        faces(plain_faces, true);
        faces(other_faces, false);
        faces(plain_faces, true);
        return std::move(out_);
    }

  private:
    void faces(int count, bool plain) {
        for (int f = 0; f < count; ++f) {
            out_.text += "f";
            for (int c = 0; c < 3; ++c) corner(plain);
            out_.text += f % 7 == 0 ? " \r\n" : "\n";
            if (!plain && f % 5 == 0) out_.text += "f 1/1/1 2\n"; // of two corners: no face
        }
    }

    void corner(bool plain) {
        const Index v = draw(), t = draw(), n = draw();
        const auto from_end = [](Index i) { return static_cast<int>(i) - 50; };
        out_.corners.push_back(v);
        const Index none_of_them = facetmill::none; // of texture points, of normals
        const auto key = [&](Index uv, Index normal) {
            out_.keys.push_back(std::uint64_t{uv} << 32 | normal);
        };
        switch (plain ? 0 : random_() % 5) {
        case 0:
            out_.text += fmt::format(" {}", v + 1);
            return key(none_of_them, none_of_them);
        case 1:
            out_.text += fmt::format(" {}/{}", v + 1, t + 1);
            return key(t, none_of_them);
        case 2:
            out_.text += fmt::format(" {}//{}", v + 1, n + 1);
            return key(none_of_them, n);
        case 3:
            out_.text += fmt::format("\t+{}/{}/{}", v + 1, t + 1, from_end(n));
            return key(t, n);
        default:
            out_.text += fmt::format("  {}/{}/{}", from_end(v), t + 1, n + 1);
            return key(t, n);
        }
    }

    Index draw() { return static_cast<Index>(random_() % 50); }

    std::mt19937 random_;
    DrawnObj out_;
};

io::obj::Statements parsed(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return io::obj::parse(io::Input::of("drawn.obj", {first, first + text.size()}), {});
}

} // namespace

TEST_CASE("Corners of an OBJ are those of its text, in whatever way they are written", "[io][obj]") {
    const DrawnObj mixed = ObjDrawer(1).run(120000, 40000);
    REQUIRE(mixed.text.size() > std::size_t{3} << 20); // several pieces
    const auto found = parsed(mixed.text);
    CHECK(found.corners == mixed.corners);
    CHECK(found.corner_keys == mixed.keys);
    CHECK(found.faces() == mixed.corners.size() / 3);
    CHECK(found.short_faces == 8000);
}

TEST_CASE("An OBJ of positions alone has no keys", "[io][obj]") {
    const DrawnObj plain = ObjDrawer(2).run(60000, 0);
    const auto found = parsed(plain.text + "f 1/1 2/1\n"); // of two corners: no face
    CHECK(found.corners == plain.corners);
    CHECK(found.corner_keys.empty());
    for (const char* wrong : {"f 1 2 51\n", "f 1 2 0\n", "f 1 2 99999999\n", "f 1 2 -51\n", "f 1 2 3x\n"}) {
        INFO(wrong);
        CHECK_THROWS_AS(parsed(plain.text + wrong), Error);
    }
}
