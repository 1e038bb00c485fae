// The parts of an OBJ, and their names.
#include "support/catch.hpp"
#include "support/colours.hpp"
#include "support/gltf.hpp"

#include <array>
#include <fmt/format.h>

using namespace facetmill;
using namespace facetmill::test;

namespace read_obj_test {

namespace {

const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\n";

std::vector<std::string> names_of(const Scene& scene) {
    std::vector<std::string> names;
    for (const Part& part : scene.parts) names.push_back(part.name);
    return names;
}

struct Loaded {
    io::ReadLog log;
    Scene scene;
    explicit Loaded(const std::string& text) : scene(read_bytes(to_bytes(text), "obj", &log)) {
        CHECK(broken_invariants(scene).empty());
    }
};

using Names = std::vector<std::string>;

} // namespace

TEST_CASE("groups of an OBJ without objects are parts, as objects are", "[io][obj]") {
    for (const std::string word : {"o", "g"}) {
        INFO(word);
        const Loaded two(
            fmt::format("{0}{1} left hand\nf 1 2 3\n{1} right\nf 4 5 6\nf 6 5 4\n", points, word));
        REQUIRE(names_of(two.scene) == Names{"left hand", "right"});
        CHECK(two.scene.parts[0].mesh.face_count() == 1);
        CHECK(two.scene.parts[1].mesh.face_count() == 2);
        CHECK(two.scene.parts[1].mesh.vertex_count() == 3);
        CHECK_FALSE(two.scene.parts[1].mesh.find("group", Domain::face));
        CHECK(two.log.warnings.empty());
        // And again, whatever they were.
        const Scene again = read_bytes(written(two.scene, "obj").files.at(0).bytes, "obj");
        CHECK(names_of(again) == Names{"left hand", "right"});
    }
}

TEST_CASE("a part without colours gets none because another one has some", "[io][obj]") {
    const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", red = "v 5 0 0 1 0 0\nv 6 0 0 1 0 0\nv 5 1 0\n";
    const auto colours = [](const Part& part) { return part.mesh.find("COLOR_0", Domain::wedge); };
    for (const bool red_first : {true, false}) {
        INFO(red_first);
        const Loaded two("usemtl m\n" + (red_first ? "o b\n" + red + "f 1 2 3\no a\n" + plain + "f 4 5 6\n"
                                                   : "o a\n" + plain + "f 1 2 3\no b\n" + red + "f 4 5 6\n"));
        REQUIRE(two.scene.parts.size() == 2);
        const Part &a = two.scene.parts[red_first], &b = two.scene.parts[!red_first];
        CHECK(a.name == "a");
        CHECK(colours(a) == nullptr);
        REQUIRE(colours(b) != nullptr);
        const std::vector<float> wanted{1, 0, 0, 1, 0,
                                        0, 1, 1, 1}; // white for vertices without a colour in a coloured part
        CHECK(std::get<std::vector<float>>(colours(b)->data) == wanted);
    }
    const Loaded lines("o a\n" + plain + "l 1 2\no b\n" + red + "f 4 5 6\n");
    REQUIRE(lines.scene.parts.size() == 2);
    for (const Part& part : lines.scene.parts)
        CHECK((colours(part) != nullptr) == (part.mesh.face_count() > 0));
}

TEST_CASE("colours of an OBJ count to 1 or to 255", "[io][obj]") {
    const auto colour = [](const std::string& vertices, std::size_t v) {
        const Loaded loaded(vertices + "f 1 2 3\n");
        const Attribute* a = loaded.scene.parts.at(0).mesh.find("COLOR_0", Domain::wedge);
        REQUIRE(a);
        return std::array{a->value(v, 0), a->value(v, 1), a->value(v, 2)};
    };
    const std::string bytes = "v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 1 0 0\n";
    CHECK(colour(bytes, 0) == std::array{1.0, 0.0, 0.0});
    CHECK(colour(bytes, 1)[1] == Approx(test::linear_light(0.2)));
    CHECK(colour(bytes, 2)[0] == Approx(test::linear_light(1.0 / 255)));
    const std::string fractions = "v 0 0 0 1 0 0\nv 1 0 0 0 0.2 0\nv 0 1 0 1 0 0\n";
    CHECK(colour(fractions, 0) == std::array{1.0, 0.0, 0.0});
    CHECK(colour(fractions, 1)[1] == Approx(test::linear_light(0.2)));
    CHECK(colour("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\n", 1)[1] == 1);
}

TEST_CASE("groups that share vertices, and those within an object, are numbers of faces", "[io][obj]") {
    for (const std::string& text :
         {points + "g a\nf 1 2 3\ng b\nf 3 2 4\n", points + "o one\ng a\nf 1 2 3\ng b\nf 4 5 6\n"}) {
        INFO(text);
        const Loaded one(text);
        REQUIRE(one.scene.parts.size() == 1);
        const Attribute* group = one.scene.parts[0].mesh.find("group", Domain::face);
        REQUIRE(group);
        CHECK(group->value(0, 0) == 0);
        CHECK(group->value(1, 0) == 1);
        REQUIRE(one.log.warnings.size() == 1);
        CHECK(one.log.warnings[0].id == "W-GROUPS");
        // A part stays one part, named or not, though its groups would be parts without an object.
        const Scene again = read_bytes(written(one.scene, "obj").files.at(0).bytes, "obj");
        REQUIRE(again.parts.size() == 1);
        CHECK(again.parts[0].mesh.find("group", Domain::face)->value(1, 0) == 1);
    }
    Scene unnamed = read_bytes(to_bytes(points + "o one\ng a\nf 1 2 3\ng b\nf 4 5 6\n"), "obj");
    unnamed.parts[0].name.clear();
    CHECK(read_bytes(written(unnamed, "obj").files.at(0).bytes, "obj").parts.size() == 1);
}

TEST_CASE("objects that share vertices are parts with copies of them", "[io][obj]") {
    const std::string uvs = "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n";
    // The corner 3/3 is of all three objects, the corner 2/2 of the first and the third, 2/4 of the second
    // and the third.
    for (const std::string& faces :
         {std::string("o a\nf 1 2 3\no b\nf 3 2 4\no c\nf 3 4 2\n"),
          std::string("o a\nf 1/1 2/2 3/3\no b\nf 3/3 2/4 4/1\no c\nf 3/3 4/1 2/4\nf 3/3 4/1 2/2\n")}) {
        INFO(faces);
        const Loaded read(points + uvs + faces);
        REQUIRE(read.scene.parts.size() == 3);
        const Loaded alone(points + uvs + "o a\nf 3 2 4\n");
        for (std::size_t p = 0; p < 3; ++p)
            CHECK(read.scene.parts[p].name == std::string(1, static_cast<char>('a' + p)));
        const auto corner = [&](std::size_t part, Index face, Index place) {
            const Mesh& mesh = read.scene.parts[part].mesh;
            return mesh.positions[mesh.vertex(mesh.face_begin(face) + place)];
        };
        const Mesh all = alone.scene.parts.at(0).mesh;
        for (Index c = 0; c < 3; ++c) {
            CHECK(corner(1, 0, c) == all.positions[all.vertex(c)]);
            CHECK(corner(2, 0, (3 - c) % 3) == all.positions[all.vertex(c)]);
        }
        REQUIRE(read.log.warnings.size() == 1);
        CHECK(read.log.warnings[0].id == "W-OBJECTS");
        CHECK(read.scene.parts[1].mesh.vertex_count() == 3);
    }
}

TEST_CASE("objects share vertices, but no texture points", "[io][obj]") {
    const Loaded two(
        points + "vt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\nvt 2 1\nvt 1 2\no a\nf 1/1 2/2 3/3\no b\nf 1/4 2/5 3/6\n");
    REQUIRE(two.scene.parts.size() == 2);
    const Mesh& b = two.scene.parts[1].mesh;
    REQUIRE(b.vertex_count() == 3);
    const Attribute* uv = b.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    for (Index c = 0; c < 3; ++c) {
        CHECK(b.positions[b.vertex(c)] == two.scene.parts[0].mesh.positions[c]);
        CHECK(uv->value(b.corners[c], 0) == (c == 1 ? 2 : 1));
    }
}

TEST_CASE("a vertex without faces is of the group that it stands in", "[io][obj]") {
    const Loaded two(
        "g a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\ng b\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n");
    REQUIRE(two.scene.parts.size() == 2);
    CHECK(two.scene.parts[0].mesh.vertex_count() == 4);
    CHECK(two.scene.parts[1].mesh.vertex_count() == 3);
}

} // namespace read_obj_test
