#include "cells/partition/partition.hpp"

#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"
#include "support/colours.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/surface.hpp"
#include "support/temporary.hpp"

#include <cmath>
#include <cstring>
#include <fstream>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

constexpr std::uint64_t test_memory = std::uint64_t{64} << 20;

/// The mesh as a file of that name, by the codec of its suffix.
std::filesystem::path as_file(const test::TemporaryDirectory& folder, const char* name, const Mesh& mesh,
                              const io::WriteSettings& settings = {.double_positions = true}) {
    Scene scene;
    scene.parts.emplace_back().mesh = mesh;
    const auto path = folder / name;
    io::write_now(path, io::codec_for(path)->write(scene, settings).files.front().bytes);
    return path;
}

std::unique_ptr<Partition> partition_of(const std::filesystem::path& path, std::uint64_t most) {
    return std::make_unique<Partition>(open_faces({path}, {}, path.parent_path()),
                                       CellResources{path.parent_path(), test_memory}, most);
}

/// One triangle 3000 times, and 3000 that share a corner.
std::vector<Mesh> heap_and_star() {
    Mesh heap, star;
    for (Index f = 0; f < 3000; ++f) {
        for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) heap.positions.push_back(p);
        add_face(heap, std::vector<Index>{3 * f, 3 * f + 1, 3 * f + 2});
        const double x = f;
        if (f == 0) star.positions.push_back({0, 0, 0});
        star.positions.push_back({1, x, 0});
        star.positions.push_back({1, x, 1});
        add_face(star, std::vector<Index>{0, 2 * f + 1, 2 * f + 2});
    }
    return {heap, star};
}

/// Bytes that this process has read from files of any kind.
std::uint64_t bytes_read() {
    std::ifstream io("/proc/self/io");
    std::string name;
    std::uint64_t bytes = 0;
    io >> name >> bytes;
    REQUIRE(name == "rchar:");
    return bytes;
}

} // namespace

TEST_CASE("cells are the mesh: whole faces, shared vertices known", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_icosphere(5, 0.01, 7);
    const auto path = as_file(folder, "m.ply", mesh);
    for (const std::uint64_t most : {std::uint64_t{100}, std::uint64_t{1000}, std::uint64_t{100000}}) {
        const auto partition = partition_of(path, most);
        CHECK(partition->faces() == mesh.face_count());
        CHECK(partition->vertices() == mesh.vertex_count());
        CHECK((partition->tree().leaves.size() == 1) == (most >= mesh.face_count()));
        for (std::uint32_t leaf = 0; leaf < partition->tree().leaves.size(); ++leaf)
            CHECK(partition->faces_of(leaf) <= most);
        const Mesh whole = test::rejoined(*partition);
        CHECK(whole.vertex_count() == mesh.vertex_count());
        CHECK(test::triangles_of(whole) == test::triangles_of(mesh));
        CHECK(test::count(whole) == test::count(mesh));
    }
    CHECK(folder.names() == std::vector<std::string>{"m.ply"}); // temporary data has no name
}

TEST_CASE("the vertices of STL are known by their places", "[cells]") {
    const test::TemporaryDirectory folder;
    Mesh mesh = test::noisy_icosphere(4, 0.01, 7);
    for (Vec3& p : mesh.positions) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
    const auto partition = partition_of(as_file(folder, "m.stl", mesh), 200);
    CHECK(partition->vertices() == mesh.vertex_count());
    const Mesh whole = test::rejoined(*partition);
    CHECK(whole.vertex_count() == mesh.vertex_count());
    CHECK(test::triangles_of(whole) == test::triangles_of(mesh));
}

TEST_CASE("vertices of PLY at one place stay apart, as in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    Mesh mesh = shapes::icosphere(3);
    append(mesh, Mesh(mesh)); // the same twice
    const auto partition = partition_of(as_file(folder, "m.ply", mesh), 50);
    const Mesh whole = test::rejoined(*partition);
    CHECK(whole.vertex_count() == mesh.vertex_count());
    CHECK(test::count(whole) == test::count(mesh));
}

TEST_CASE("cells carry the attributes of vertices", "[cells]") {
    const test::TemporaryDirectory folder;
    Mesh mesh = shapes::icosphere(4);
    std::vector<std::uint8_t> colours;
    for (const Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) colours.push_back(static_cast<std::uint8_t>(127 + 100 * p[i]));
    mesh.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 3, true, test::linear_words(colours, 3)});
    const auto path = as_file(folder, "m.ply", mesh);
    const auto partition = partition_of(path, 200);
    const Mesh whole = test::rejoined(*partition);
    const Attribute* got = whole.find("COLOR_0", Domain::wedge);
    REQUIRE(got);
    for (Index v = 0; v < whole.vertex_count(); ++v)
        for (int i = 0; i < 3; ++i)
            CHECK(test::srgb_byte(*got, v, i) ==
                  static_cast<std::uint8_t>(127 + 100 * whole.positions[v][static_cast<std::size_t>(i)]));
}

TEST_CASE("polygons become the triangles that they are in memory", "[cells]") {
    const test::TemporaryDirectory folder;
    constexpr Index n = 20;
    Mesh mesh;
    for (Index y = 0; y <= n; ++y)
        for (Index x = 0; x <= n; ++x) mesh.positions.push_back({double(x), double(y), 0});
    for (Index y = 0; y < n; ++y)
        for (Index x = 0; x < n; ++x) {
            const Index at = y * (n + 1) + x;
            add_face(mesh, std::vector<Index>{at, at + 1, at + n + 2, at + n + 1});
        }
    mesh = test::with_noise(std::move(mesh), 0.3, 1);
    add_face(mesh, std::vector<Index>{0, n, (n + 1) * (n + 1) - 1, n * (n + 1), n * (n / 2)}); // five corners
    const Mesh whole = test::rejoined(*partition_of(as_file(folder, "m.ply", mesh), 100));
    CHECK(test::triangles_of(whole) == test::triangles_of(triangulated(mesh)));
}

TEST_CASE("many faces at one place, or at one vertex, are divided all the same", "[cells]") {
    const test::TemporaryDirectory folder;
    for (const Mesh& mesh : heap_and_star()) {
        const auto partition = partition_of(as_file(folder, "m.ply", mesh), 100);
        for (std::uint32_t leaf = 0; leaf < partition->tree().leaves.size(); ++leaf)
            CHECK(partition->faces_of(leaf) <= 100);
        const Mesh whole = test::rejoined(*partition);
        CHECK(whole.vertex_count() == mesh.vertex_count());
        CHECK(test::triangles_of(whole) == test::triangles_of(mesh));
    }
}

TEST_CASE("cells do not depend on memory", "[cells]") {
    const test::TemporaryDirectory folder;
    std::vector<Mesh> meshes = heap_and_star();
    meshes.push_back(test::noisy_torus(120, 60, 0.001, 3));
    for (std::size_t i = 0; i < 3; ++i) meshes.back().positions.push_back({0, 0, double(i)}); // no face's
    for (const Mesh& mesh : meshes) {
        const auto path = as_file(folder, "m.ply", mesh);
        const Partition small(open_faces({path}, {}, path.parent_path()), {folder.path(), 1 << 12}, 500);
        const Partition large(open_faces({path}, {}, path.parent_path()), {folder.path(), 1 << 28}, 500);
        REQUIRE(small.tree().leaves.size() == large.tree().leaves.size());
        CHECK(small.vertices() == large.vertices());
        for (std::uint32_t leaf = 0; leaf < small.tree().leaves.size(); ++leaf) {
            const Cell a = small.cell(leaf), b = large.cell(leaf);
            CHECK(a.names == b.names);
            CHECK(a.home == b.home);
            CHECK(a.mesh.positions == b.mesh.positions);
            CHECK(a.mesh.corners == b.mesh.corners);
        }
    }
}

TEST_CASE("a PLY is read once and its faces once more", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = as_file(folder, "m.ply", test::noisy_torus(600, 300, 0.001, 3), {});
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    const std::shared_ptr<FaceSource> source = open_faces({path}, {}, folder.path());
    const std::uint64_t before = bytes_read();
    const Partition partition(source, {folder.path(), test_memory}, 20000);
    CHECK(static_cast<double>(bytes_read() - before) < 1.85 * size); // temporary data with it
    CHECK(source->contents().files.front().sha256 == sha256(io::Input::open(path).bytes()));
}

TEST_CASE("a malformed file is refused as elsewhere", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = shapes::icosphere(2);
    const auto path = as_file(folder, "m.ply", mesh, {});
    const std::string whole = test::get(path);
    const auto failure = [&](const std::string& text, const char* name = "bad.ply") {
        test::put(folder / name, text);
        return test::failure_id([&] { partition_of(folder / name, 100); });
    };
    CHECK(failure(whole.substr(0, whole.size() - 3)) == "E-PLY");
    CHECK(failure(whole.substr(0, whole.size() / 3)) == "E-PLY");
    std::string bad = whole;
    const float nan = NAN;
    std::memcpy(bad.data() + whole.find("end_header\n") + 11, &nan, sizeof nan);
    CHECK(failure(bad) == "E-NAN");
    try {
        partition_of(folder / "bad.ply", 100);
    } catch (const Error& error) {
        CHECK(error.diagnostics().front().hint.find("load: {not_finite: drop}") != std::string::npos);
        CHECK(error.diagnostics().front().hint.find("the file is read whole then") != std::string::npos);
    }
    bad = whole;
    std::memset(bad.data() + whole.size() - 4, 0x7f, 4); // a missing vertex
    CHECK(failure(bad) == "E-PLY");
    const std::string stl = test::get(as_file(folder, "m.stl", mesh, {}));
    CHECK(failure(stl.substr(0, stl.size() - 10), "bad.stl") == "E-STL");
}
