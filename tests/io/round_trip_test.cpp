#include "support/catch.hpp"

#include "io/codec.hpp"
#include "io/read_back.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/colours.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

#include <cmath>

using namespace facetmill;
using namespace facetmill::test;

namespace {

Scene named_scene(Mesh mesh, std::string name = "part") {
    Scene scene;
    Part& part = scene.parts.emplace_back();
    part.name = std::move(name);
    part.mesh = std::move(mesh);
    return scene;
}

struct Trip {
    Scene scene;
    io::Written written;
    io::ReadLog log;
};

/// Writes the scene and reads it again.
Trip trip(const Scene& scene, const char* format, io::WriteSettings settings = {}) {
    const io::Codec& codec = *io::codec_named(format);
    settings.title = "mesh";
    Trip t;
    t.written = codec.write(scene, settings);
    const io::Input input = io::Input::of(std::string("mesh.") + format, t.written.files.front().bytes);
    CHECK(io::read_back(input, codec, scene, settings).faces >= scene.face_count());
    t.scene = io::read_scene(input, {}, t.log);
    CHECK(broken_invariants(t.scene).empty());
    return t;
}

std::string changes(const io::Written& written) {
    std::string text;
    for (const auto& f : written.changes)
        text += fmt::format("{} {} {}: {}\n", to_string(f.domain), f.attribute, to_string(f.kind), f.why);
    return text;
}

const std::vector<io::WriteSettings> ply_settings{
    {}, {.ascii = true}, {.big_endian = true}, {.double_positions = true}};

} // namespace

TEST_CASE("PLY holds polygons and shared vertices in every encoding", "[io]") {
    for (const auto& settings : ply_settings)
        for (const Mesh& mesh : {shapes::quad_cube(), shapes::cube(), shapes::fan3(), shapes::moebius(5)}) {
            const Trip t = trip(named_scene(mesh), "ply", settings);
            const Mesh& back = t.scene.parts.at(0).mesh;
            CHECK(back.corners == mesh.corners);
            CHECK(back.face_offsets == mesh.face_offsets);
            CHECK(back.vertex_count() == mesh.vertex_count());
            CHECK(changes(t.written).empty());
        }
}

TEST_CASE("positions beyond float32 are refused by whatever would round them", "[io]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.positions[0].x = 1e39;
    Mesh small = shapes::tetrahedron();
    for (Vec3& p : small.positions) p *= 1e-60;
    for (const char* format : {"ply", "obj", "off", "stl", "gltf", "glb"}) {
        INFO(format);
        const io::Codec& codec = *io::codec_named(format);
        const std::string told = failure([&] { codec.write(named_scene(mesh), {.title = "mesh"}); });
        CHECK(told.starts_with("stage [E-RANGE]"));
        CHECK(told.find("float32 cannot hold, up to 1e+39") != std::string::npos);
        CHECK(failure([&] {
                  codec.write(named_scene(small), {.title = "mesh"});
              }).starts_with("stage [E-RANGE]"));
        if (codec.can.full_precision)
            CHECK(failure([&] {
                      codec.write(named_scene(mesh), {.double_positions = true, .title = "mesh"});
                  }) == "nothing");
    }
}

TEST_CASE("PLY holds positions with all their digits on request", "[io]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.positions[0] = {1.0 / 3, std::nextafter(2.0, 3.0), 1e-300};
    for (const bool ascii : {false, true}) {
        const Trip t = trip(named_scene(mesh), "ply", {.ascii = ascii, .double_positions = true});
        CHECK(t.scene.parts.at(0).mesh.positions == mesh.positions);
    }
}

TEST_CASE("PLY holds attributes of every type and domain", "[io]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.attributes = {
        {"NORMAL", Domain::wedge, Role::normal, 3, false,
         std::vector<float>{0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, -1}},
        {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>{0, 0, 0.5, 0.25, 1, 0.75, 1, 1}},
        {"COLOR_0", Domain::wedge, Role::colour, 4, true,
         linear_words({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 255}, 4)},
        {"quality", Domain::wedge, Role::generic, 1, false, std::vector<double>{0.1, 0.2, 1e300, -4}},
        {"flags", Domain::wedge, Role::index, 1, false,
         std::vector<std::int32_t>{-1, 2, INT32_MAX, INT32_MIN}},
        {"WEIGHTS_0", Domain::wedge, Role::weights, 4, false, std::vector<float>(16, 0.25F)},
        {"COLOR_0", Domain::face, Role::colour, 3, true,
         linear_words({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 3)},
        {"group", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{0, 1, 2, UINT32_MAX}},
    };
    for (const auto& settings : ply_settings) {
        const Trip t = trip(named_scene(mesh), "ply", settings);
        const auto& back = t.scene.parts.at(0).mesh.attributes;
        REQUIRE(back.size() == mesh.attributes.size());
        for (const auto& a : mesh.attributes) {
            INFO(a.name);
            const Attribute* b = t.scene.parts[0].mesh.find(a.name, a.domain);
            REQUIRE(b);
            CHECK(b->data == a.data);
            CHECK(b->role == a.role);
            CHECK(b->components == a.components);
            CHECK(b->normalised == a.normalised);
        }
    }
}

TEST_CASE("PLY keeps a surface whole over texture seams, and splits it at others", "[io]") {
    Mesh mesh = shapes::uv_cube();
    const Trip split = trip(named_scene(mesh), "ply");
    CHECK(split.scene.parts.at(0).mesh.vertex_count() == mesh.wedge_count());
    CHECK(changes(split.written) == "vertex vertices recomputed: 8 vertices became 24: PLY has one set of "
                                    "attributes at a vertex, so vertices on seams were split\n");
    mesh.drop("NORMAL", Domain::wedge);
    for (const auto& settings : ply_settings) {
        const Trip whole = trip(named_scene(mesh), "ply", settings);
        const Mesh& back = whole.scene.parts.at(0).mesh;
        CHECK(back.vertex_count() == 8);
        CHECK(changes(whole.written).empty());
        for (Index c = 0; c < mesh.corner_count(); ++c) {
            CHECK(back.vertex(c) == mesh.vertex(c));
            for (int k = 0; k < 2; ++k)
                CHECK(back.find("TEXCOORD_0", Domain::wedge)->value(back.corners[c], k) ==
                      mesh.find("TEXCOORD_0", Domain::wedge)->value(mesh.corners[c], k));
        }
    }
}

TEST_CASE("PLY holds a face of many corners and a cloud of points", "[io]") {
    Mesh disc, cloud;
    std::vector<Index> rim;
    for (Index i = 0; i < 300; ++i) {
        disc.positions.push_back({static_cast<double>(i), static_cast<double>(i * i), 0});
        rim.push_back(i);
    }
    add_face(disc, rim);
    cloud.positions = disc.positions;
    for (const auto& settings : ply_settings) {
        CHECK(trip(named_scene(disc), "ply", settings).scene.parts.at(0).mesh.corners == disc.corners);
        CHECK(trip(named_scene(cloud), "ply", settings).scene.parts.at(0).mesh.vertex_count() == 300);
    }
}

TEST_CASE("STL holds triangles, welded again on reading", "[io]") {
    for (const bool ascii : {false, true}) {
        const Trip t = trip(named_scene(shapes::icosphere(1)), "stl", {.ascii = ascii});
        CHECK(t.scene.parts.at(0).mesh.vertex_count() == shapes::icosphere(1).vertex_count());
        const Trip quads = trip(named_scene(shapes::quad_cube()), "stl", {.ascii = ascii});
        CHECK(quads.scene.face_count() == 12);
        CHECK(changes(quads.written) ==
              "face polygons recomputed: cut into triangles, because STL stores only triangles\n");
    }
    CHECK(changes(trip(named_scene(shapes::uv_cube()), "stl").written).find("STL stores only positions") !=
          std::string::npos);
}

TEST_CASE("a binary STL of many triangles is welded the same by any number of threads", "[io]") {
    Mesh mesh = shapes::icosphere(5);
    for (Vec3& p : mesh.positions) p = {p.x, p.y, std::abs(p.z) < 0.01 ? -0.0 : p.z};
    io::Written written = io::codec_named("stl")->write(named_scene(mesh), {});
    io::Bytes& bytes = written.files.front().bytes;
    const std::size_t faces = mesh.face_count(), first_zero = [&] {
        std::size_t c = 0;
        while (mesh.point(static_cast<Index>(c)).z != 0) ++c;
        return c;
    }();
    bytes.at(84 + 50 * (faces - 1) + 48) = std::byte{7}; // two bytes after the last triangle
    const auto sign = [&](std::size_t c) -> std::byte& {
        return bytes.at(84 + c / 3 * 50 + 12 * (c % 3 + 1) + 11);
    };
    for (std::size_t c = 0; c < 3 * faces; ++c)
        if (mesh.point(static_cast<Index>(c)).z == 0)
            sign(c) = c == first_zero ? std::byte{0x80} : std::byte{0};
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        io::ReadLog log;
        const Mesh read = io::read_scene(io::Input::of("mesh.stl", bytes), {}, log).parts.at(0).mesh;
        REQUIRE(read.vertex_count() == mesh.vertex_count());
        Index next = 0; // positions are numbered in order of appearance
        bool same = true;
        for (Index c = 0; c < 3 * faces; ++c) {
            same &= read.corners[c] <= next && read.point(c).z == static_cast<float>(mesh.point(c).z);
            next = std::max(next, read.corners[c] + 1);
        }
        CHECK(same);
        CHECK(std::signbit(
            read.point(static_cast<Index>(first_zero)).z)); // the sign of the first corner at this position
        const Attribute* extra = read.find("attribute", Domain::face);
        REQUIRE(extra);
        CHECK(extra->value(faces - 1, 0) == 7);
    }
    set_threads(0);
}

TEST_CASE("parts are placed in the world, and are solids in STL text and objects in OBJ", "[io]") {
    Scene scene = named_scene(shapes::cube(), "one");
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "the other";
    scene.parts[1].transform.m[0][3] = 5;
    for (const auto& [format, ascii] : {std::pair{"stl", true}, std::pair{"obj", false}}) {
        const Trip t = trip(scene, format, {.ascii = ascii});
        REQUIRE(t.scene.parts.size() == 2);
        CHECK(t.scene.parts[1].name == "the other");
        CHECK(t.scene.parts[1].mesh.bounds().min == Vec3{5, 0, 0});
        CHECK(t.scene.parts[1].mesh.vertex_count() == 8);
    }
    for (const char* format : {"ply", "off", "stl"}) {
        const Trip t = trip(scene, format);
        CHECK(t.scene.parts.size() == 1);
        CHECK(t.scene.bounds().max == Vec3{6, 1, 1});
    }
}

TEST_CASE("OBJ holds seams, polygons, groups and materials", "[io]") {
    Scene scene = named_scene(shapes::uv_cube());
    Mesh& mesh = scene.parts[0].mesh;
    scene.materials.resize(2);
    scene.materials[0].name = "red";
    scene.materials[0].base_colour[1] = 0.25;
    scene.materials[1].name = "blue sky";
    mesh.primitives = {{0, {}, {}}, {1, {}, {}}};
    std::vector<std::uint32_t> primitive(12, 0), group(12, 0);
    for (std::size_t f = 6; f < 12; ++f) primitive[f] = 1;
    for (std::size_t f = 3; f < 12; ++f) group[f] = 1;
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, primitive});
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false, group});

    const TemporaryDirectory dir;
    const io::Written written = io::codec_named("obj")->write(scene, {.title = "a"});
    REQUIRE(written.files.size() == 2);
    for (const auto& file : written.files) put(dir / file.name.string(), io::as_text(file.bytes));
    io::ReadLog log;
    const Scene back = io::read_scene(io::Input::open(dir / "a.obj"), {}, log);
    REQUIRE(back.parts.size() == 1);
    const Mesh& m = back.parts[0].mesh;
    CHECK(broken_invariants(back).empty());
    CHECK(m.vertex_count() == 8);
    CHECK(m.wedge_count() == 24);
    CHECK(m.find("NORMAL", Domain::wedge));
    CHECK(std::get<std::vector<std::uint32_t>>(m.find("group", Domain::face)->data) == group);
    CHECK(std::get<std::vector<std::uint32_t>>(m.find("primitive", Domain::face)->data) == primitive);
    REQUIRE(back.materials.size() == 2);
    CHECK(back.materials[0].name == "red");
    CHECK(back.materials[0].base_colour[1] == 0.25);
    CHECK(back.materials[1].name == "blue sky");
    REQUIRE(log.files.size() == 1);
    CHECK(log.files[0].path == dir / "a.mtl");

    const auto library_of = [&] {
        return std::string(
            io::as_text(io::codec_named("obj")->write(scene, {.title = "a"}).files.back().bytes));
    };
    CHECK(library_of().find("newmtl red\n") != std::string::npos);
    primitive.assign(12, 1); // no face is red now: its material stays out of the library
    std::get<std::vector<std::uint32_t>>(mesh.find(primitive_attribute, Domain::face)->data) = primitive;
    CHECK(library_of().find("newmtl red\n") == std::string::npos);
    CHECK(library_of().find("newmtl blue_sky\n") != std::string::npos);
}

TEST_CASE("PLY and OFF tell that materials have colours, which they do not hold", "[io]") {
    Scene scene = named_scene(shapes::cube());
    scene.materials = {{.name = "white"}, {.name = "blue sky"}, {.name = "unused"}};
    scene.materials[1].base_colour[0] = scene.materials[2].base_colour[0] = 0.25;
    scene.parts[0].mesh.primitives = {{0, {}, {}}};
    for (const char* format : {"ply", "off"}) {
        INFO(format);
        scene.parts[0].mesh.primitives[0].material = 0;
        CHECK(written(scene, format).warnings.empty());
        scene.parts[0].mesh.primitives[0].material = 1;
        const auto warnings = written(scene, format).warnings;
        REQUIRE(warnings.size() == 1);
        CHECK(warnings[0].id == "W-MATERIAL");
        CHECK(warnings[0].message.find("the colours of 1 material are not written to") == 0);
        CHECK(warnings[0].message.ends_with(": blue sky"));
    }
}

TEST_CASE("OFF holds polygons and colours", "[io]") {
    Mesh mesh = shapes::quad_cube();
    mesh.attributes.push_back({"COLOR_0", Domain::face, Role::colour, 3, true,
                               linear_words(std::vector<std::uint8_t>(18, 200), 3)});
    mesh.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 4, false, std::vector<float>(32, 0.5F)});
    const Trip t = trip(named_scene(mesh), "off");
    const Mesh& back = t.scene.parts.at(0).mesh;
    CHECK(back.corners == mesh.corners);
    CHECK(back.find("COLOR_0", Domain::face)->data == mesh.attributes[0].data);
    for (Index w = 0; w < 8; ++w)
        for (int c = 0; c < 4; ++c)
            CHECK(back.find("COLOR_0", Domain::wedge)->value(w, c) == Approx(0.5).epsilon(1e-6));
    CHECK(trip(named_scene(shapes::torus(8, 5)), "off").scene.parts.at(0).mesh.corners ==
          shapes::torus(8, 5).corners);
}

TEST_CASE("colours of vertices under the plain keyword OFF are read", "[io]") {
    const auto read = [](const std::string& text) {
        io::ReadLog log;
        return io::read_scene(io::Input::of("a.off", test::to_bytes(text)), {}, log).parts.at(0).mesh;
    };
    for (const char* counts : {"4 1 0", "4 1"}) {
        const Mesh mesh = read(fmt::format("OFF\n\n{}\n\n0 0 0 255 0 0\n1 0 0 0 255 0 # green\n"
                                           "1 1 0 0 0 255\n\n0 1 0 255 0 0\n\n4 0 1 2 3\n",
                                           counts));
        REQUIRE(mesh.vertex_count() == 4);
        CHECK(mesh.positions[2] == Vec3{1, 1, 0});
        REQUIRE(mesh.face_count() == 1);
        CHECK(mesh.find("COLOR_0", Domain::wedge)->data ==
              linear_words({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 0, 0}, 3));
    }
    // Two vertices on a line, as the format allows.
    const Mesh two = read("OFF\n4 2 0\n0 0 0 1 0 0\n0 1 0 0 0 1\n3 0 1 2\n3 0 2 3\n");
    CHECK(two.positions[3] == Vec3{0, 0, 1});
    CHECK(two.attributes.empty());
    CHECK(failure([&] { read("OFF\n3 1 0\n0 0 0 0 0 -1\n1 0 0 0 0 -1\n0 1 0 0 0 -1\n3 0 1 2\n"); }) ==
          "malformed [E-OFF] a.off:2: each vertex has 6 numbers, but OFF has three | begin the file with "
          "NOFF if normals follow the coordinates, or COFF for colours");
}

TEST_CASE("a file that does not hold what was written is found out", "[io]") {
    const Scene scene = named_scene(shapes::cube());
    Scene moved = scene, fewer = scene;
    moved.parts[0].mesh.positions[3].x += 1e-3;
    fewer.parts[0].mesh.corners.resize(33);
    for (const char* format : {"ply", "stl", "obj", "off"}) {
        const io::Codec& codec = *io::codec_named(format);
        const auto back = [&](const Scene& other) {
            return failure([&] {
                io::read_back(io::Input::of("out", codec.write(other, {.title = "a"}).files[0].bytes), codec,
                              scene, {});
            });
        };
        CHECK(back(scene) == "nothing");
        CHECK(back(moved).starts_with("output [E-READBACK] 'out' differs from the data that was written: a "
                                      "vertex moved farther than "));
        CHECK(back(fewer).starts_with(
            "output [E-READBACK] 'out' differs from the data that was written: 11 faces, expected 12"));
    }
}

TEST_CASE("what a file says to have moved is the distance to the nearest point, either way", "[io]") {
    // The file's faces are in another order, so the numbers of its points differ from the written numbers.
    Scene scene = scene_in_metres(noisy_icosphere(4, 0.02, 3));
    for (Vec3& p : scene.parts[0].mesh.positions) p += Vec3{100, 0, 0};
    const io::Codec& codec = *io::codec_named("glb");
    const auto bytes = codec.write(scene, {.title = "a"}).files[0].bytes;
    io::ReadLog log;
    const Scene read = io::read_scene(io::Input::of("out", bytes), {}, log, &codec);
    const auto& here = scene.parts[0].mesh.positions;
    const auto& there = read.parts.at(0).mesh.positions;
    double farthest = 0;
    for (const auto& [from, to] : {std::pair(&here, &there), std::pair(&there, &here)})
        for (const Vec3& p : *from) {
            double nearest = HUGE_VAL;
            for (const Vec3& q : *to) nearest = std::min(nearest, length(q - p));
            farthest = std::max(farthest, nearest);
        }
    CHECK(farthest > 1e-6);
    CHECK(io::read_back(io::Input::of("out", bytes), codec, scene, {}).position_error == farthest);
    // One point of 2,562 that is elsewhere is found, in either.
    const double far = 1e-3;
    scene.parts[0].mesh.positions[1234] *= 1 + far;
    CHECK(failure([&] {
              io::read_back(io::Input::of("out", bytes), codec, scene, {});
          }).find("a vertex moved farther than") != std::string::npos);
}
