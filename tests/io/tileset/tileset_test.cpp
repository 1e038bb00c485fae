#include "io/tileset/tileset.hpp"

#include "geometry/inspect/inspect.hpp"
#include "io/convert.hpp"
#include "io/gltf/container.hpp"
#include "io/read_back.hpp"
#include "io/tileset/frame.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/temporary.hpp"

#include <functional>
#include <tuple>

namespace tileset_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

Scene ball(const Vec3& at = {}) {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::z;
    Part& part = scene.parts.emplace_back();
    part.name = "ball";
    part.mesh = shapes::icosphere(4); // 5120 faces
    for (std::size_t axis = 0; axis < 3; ++axis) part.transform.m[axis][3] = at[axis];
    return scene;
}

io::Written written(const Scene& scene, io::WriteSettings settings = {}) {
    settings.title = "tileset";
    settings.tiles.faces = 400;
    return io::codec_named("3d-tiles")->write(scene, settings);
}

Json json_of(const io::Written& all) { return parse_json(io::as_text(all.files.front().bytes)); }

/// A tileset and its files on disk.
struct OnDisk {
    TemporaryDirectory folder;
    std::filesystem::path path;

    explicit OnDisk(const io::Written& all) : path(folder.path() / "tileset.json") {
        for (const io::OutputFile& file : all.files) {
            std::filesystem::create_directories((folder.path() / file.name).parent_path());
            put(folder.path() / file.name, io::as_text(file.bytes));
        }
    }
    Scene read() const {
        io::ReadLog log;
        return io::read_scene(io::Input::open(path), {}, log);
    }
};

/// A box as the tileset has it, in the world.
Box box_of_tile(const Json& tile, const Vec3& at) {
    const Json& b = (tile.contains("content") && tile["content"].contains("boundingVolume")
                         ? tile["content"]
                         : tile)["boundingVolume"]["box"];
    Box box;
    for (const double side : {-1.0, 1.0})
        box.add(at + Vec3{b[0].get<double>() + side * b[3].get<double>(),
                          b[1].get<double>() + side * b[7].get<double>(),
                          b[2].get<double>() + side * b[11].get<double>()});
    return box;
}

/// Tiles that are refined down to a depth of the tree, each other one a level less, as one mesh in the world.
void add_cut(const OnDisk& disk, const Json& tile, const Vec3& at, int depth, Mesh& all) {
    if (depth > 0 && tile.contains("children")) {
        int other = 0;
        for (const Json& child : tile["children"]) add_cut(disk, child, at, depth - 1 - other++ % 2, all);
        return;
    }
    io::ReadLog log;
    const Scene scene = io::read_scene(
        io::Input::open(disk.folder.path() / tile["content"]["uri"].get<std::string>()), {}, log);
    const Box box = box_of_tile(tile, at);
    Box found;
    for (const Part& part : scene.parts) {
        Mesh mesh = part.mesh;
        apply(mesh, io::turn_up(UpAxis::y, UpAxis::z) * part.transform);
        for (Vec3& p : mesh.positions) found.add(p = p + at);
        append(all, mesh);
    }
    CHECK(found.min == box.min);
    CHECK(found.max == box.max);
}

Vec3 origin_of(const Json& tileset) {
    if (!tileset["root"].contains("transform")) return {};
    const Json& t = tileset["root"]["transform"];
    return {t[12].get<double>(), t[13].get<double>(), t[14].get<double>()};
}

} // namespace

TEST_CASE("tiles of several levels fit, far from the origin and under compression", "[io][tileset]") {
    io::WriteSettings plain, draco, meshopt;
    draco.draco.on = true;
    meshopt.meshopt.on = meshopt.quantize.on = true;
    for (const auto& settings : {plain, draco, meshopt})
        for (const Vec3& at : {Vec3{}, Vec3{500000, 5800000, 100}}) {
            const io::Written all = written(ball(at), settings);
            const Json tileset = json_of(all);
            const OnDisk disk(all);
            for (int depth = 0; depth < 4; ++depth) {
                Mesh cut;
                add_cut(disk, tileset["root"], origin_of(tileset), depth, cut);
                weld_exact(cut);
                CAPTURE(depth, settings.draco.on, settings.meshopt.on, at.x);
                CHECK(inspect(cut).closed);
                CHECK(inspect(cut).components == 1);
            }
        }
}

TEST_CASE("a tileset is explicit, refined by REPLACE, with errors that fall to 0", "[io][tileset]") {
    const io::Written all = written(ball());
    const Json tileset = json_of(all);
    CHECK(tileset["asset"]["version"] == "1.1");
    CHECK(tileset["root"]["refine"] == "REPLACE");
    std::size_t tiles = 0;
    const std::function<void(const Json&, double)> visit = [&](const Json& tile, double above) {
        ++tiles;
        const double error = tile["geometricError"];
        CHECK(error <= above);
        CHECK((error == 0) == !tile.contains("children"));
        if (tile.contains("children"))
            for (const Json& child : tile["children"]) visit(child, error);
    };
    visit(tileset["root"], tileset["geometricError"]);
    REQUIRE(all.tiles);
    CHECK(all.tiles->tiles == tiles);
    CHECK(all.files.size() == tiles + 1);
    CHECK(all.tiles->error == tileset["root"]["geometricError"]);
}

TEST_CASE("a tileset is read as its finest tiles, one closed part", "[io][tileset]") {
    const Scene scene = ball({500000, 5800000, 100});
    const io::Written all = written(scene);
    const OnDisk disk(all);
    const Scene back = disk.read();
    REQUIRE(back.parts.size() == 1);
    CHECK(back.up == UpAxis::z);
    CHECK(back.face_count() == scene.face_count());
    CHECK(back.parts[0].mesh.vertex_count() == scene.parts[0].mesh.vertex_count());
    CHECK(inspect(back.parts[0].mesh).closed);
    const io::ReadBack result =
        io::read_back(io::Input::open(disk.path), *io::codec_named("3d-tiles"), scene, {});
    CHECK(result.position_error < 1e-6);
    CHECK(result.losses.empty());
}

TEST_CASE("what is not read of a tileset is refused by name", "[io][tileset]") {
    const TemporaryDirectory folder;
    const auto refused = [&](const std::string& root) {
        const auto path = folder.path() / "tileset.json";
        put(path, R"({"asset": {"version": "1.1"}, "geometricError": 1, "root": )" + root + "}");
        return failure([&] {
            io::ReadLog log;
            io::read_scene(io::Input::open(path), {}, log);
        });
    };
    CHECK(refused(R"({"implicitTiling": {}})").find("E-TILESET") != std::string::npos);
    CHECK(refused(R"({"content": {"uri": "../a.glb"}})").find("E-URI") != std::string::npos);
    CHECK(refused(R"({"content": {"uri": "none.glb"}})").find("E-FILE") != std::string::npos);
    CHECK(refused(R"({"content": {}})").find("E-GLTF") != std::string::npos);
    CHECK(refused(R"({"refine": "MAYBE"})").find("E-TILESET") != std::string::npos);
    CHECK(refused(R"({"transform": [1]})").find("E-GLTF") != std::string::npos);
    CHECK(refused("{}").find("E-EMPTY") != std::string::npos);
    put(folder.path() / "a.b3dm", "b3dm and more");
    CHECK(refused(R"({"content": {"uri": "a.b3dm"}})").find("E-TILESET") != std::string::npos);
}

TEST_CASE("a tileset holds a mesh at one place far away, and says what float32 cannot hold",
          "[io][tileset]") {
    Scene scene = ball();
    for (Vec3& p : scene.parts[0].mesh.positions) p = {5e5, 5e6, 1};
    const OnDisk disk(written(scene));
    CHECK(disk.read().bounds().min == Vec3{5e5, 5e6, 1});
    CHECK(disk.read().bounds().max == Vec3{5e5, 5e6, 1});
    for (Vec3& p : scene.parts[0].mesh.positions)
        p = {5e5, 5e6, 1e300 * (&p == scene.parts[0].mesh.positions.data())};
    CHECK(failure([&] { written(scene); }).find("E-RANGE") != std::string::npos);
}

TEST_CASE("faces that cross themselves are filled in tiles as in other files", "[io][tileset]") {
    Scene scene = ball();
    Mesh& mesh = scene.parts[0].mesh;
    mesh = {};
    mesh.positions = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2, 3};
    mesh.face_offsets = {0, 4};
    const OnDisk disk(written(scene));
    CHECK(inspect(disk.read().parts[0].mesh).area == 0.5);
}

TEST_CASE("the frame of a tileset keeps vertices apart, unless the bits are given", "[io][tileset]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    settings.draco.position_bits = 4;
    const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {1, 1e-4, 0}, {0.3, 0.7, 0.1}};
    const auto places = [&] {
        std::vector<Vec3> moved = points;
        io::put_into_frame(moved, io::tileset_frame(points, settings));
        std::sort(moved.begin(), moved.end(), [](const Vec3& a, const Vec3& b) {
            return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        return std::unique(moved.begin(), moved.end()) - moved.begin();
    };
    CHECK(places() == 4);
    settings.tiles.given_bits = true;
    CHECK(places() == 3);
}

} // namespace tileset_test
