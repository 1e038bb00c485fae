#include "cells/write/write_tiles.hpp"

#include "base/json.hpp"
#include "base/math/random.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/convert.hpp"
#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/meshes.hpp"
#include "support/temporary.hpp"

#include <functional>
#include <map>
#include <set>

namespace write_tiles_test {

using namespace facetmill;
using namespace facetmill::cells;

namespace {

constexpr std::uint64_t ample = std::uint64_t{1} << 30;

/// The files of a mesh in cells of at most this many faces.
struct Written {
    WrittenTiles tiles;
    std::map<std::string, io::Bytes> files;
    Json tileset;
};

struct Wanted {
    std::uint64_t cell = 5000;
    std::size_t tile = 1500;
    std::uint64_t memory = ample;
    io::WriteSettings settings{};
    Transform transform{};
};

std::filesystem::path ply_of(const test::TemporaryDirectory& folder, const Mesh& mesh) {
    Scene scene;
    scene.parts.emplace_back().mesh = mesh;
    const auto path = folder / "m.ply";
    io::write_now(path, io::codec_for(path)->write(scene, {.double_positions = true}).files.front().bytes);
    return path;
}

Written written(const std::filesystem::path& path, const Wanted& wanted = {}) {
    const CellResources means{path.parent_path(), wanted.memory};
    const Partition partition(open_faces({path}, {}, path.parent_path()), means, wanted.cell);
    io::WriteSettings settings = wanted.settings;
    settings.tiles.faces = wanted.tile;
    Written all;
    all.tiles = write_tiles(partition, wanted.transform, settings, means, [&](const io::OutputFile& file) {
        CHECK(all.files.emplace(file.name.string(), file.bytes).second);
    });
    all.tileset = parse_json(io::as_text(all.tiles.index.front().bytes));
    return all;
}

struct Cut {
    Mesh mesh;
    double error = 0;
    std::size_t tiles = 0;
    std::set<std::size_t> levels;
};

/// Tiles that are refined as chance has it, as one mesh in the world.
class Cuts {
  public:
    explicit Cuts(const Written& written) : written_(written) {
        const Json& root = written.tileset["root"];
        if (root.contains("transform"))
            origin_ = {root["transform"][12].get<double>(), root["transform"][13].get<double>(),
                       root["transform"][14].get<double>()};
        for (const auto& [name, bytes] : written.files) {
            io::ReadLog log;
            Mesh& mesh = meshes_[name];
            for (const Part& part : io::read_scene(io::Input::of(name, bytes), {}, log).parts) {
                mesh = part.mesh;
                apply(mesh, io::turn_up(UpAxis::y, UpAxis::z) * part.transform);
            }
        }
    }

    Cut random(std::uint64_t seed) const {
        Cut cut;
        add(written_.tileset["root"], seed, 0, cut);
        weld_exact(cut.mesh);
        for (Vec3& p : cut.mesh.positions) p = p + origin_;
        return cut;
    }

  private:
    void add(const Json& tile, std::uint64_t seed, std::size_t level, Cut& cut) const {
        const auto name = tile["content"]["uri"].get<std::string>();
        if (tile.contains("children") && uniform(hashed(seed, std::hash<std::string>{}(name))) < 0.7) {
            for (const Json& child : tile["children"]) add(child, seed, level + 1, cut);
            return;
        }
        append(cut.mesh, meshes_.at(name));
        cut.error = std::max(cut.error, tile["geometricError"].get<double>());
        ++cut.tiles;
        cut.levels.insert(level);
    }

    const Written& written_;
    std::map<std::string, Mesh> meshes_;
    Vec3 origin_;
};

/// Checks that cuts of a closed connected mesh are closed and connected. Returns the number of cuts with
/// several levels.
std::size_t closed_cuts(const Cuts& cuts, std::uint64_t count) {
    std::size_t mixed = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        const Cut cut = cuts.random(seed);
        const Properties p = inspect(cut.mesh);
        CAPTURE(seed, cut.tiles, cut.levels.size());
        CHECK(p.closed);
        CHECK(p.edge_manifold);
        CHECK(p.oriented);
        CHECK(p.components == 1);
        mixed += cut.levels.size() > 1;
    }
    return mixed;
}

} // namespace

TEST_CASE("every cut of tiles from cells is closed, and as near as its tiles say", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_torus(320, 128, 0.002, 3);
    const Written all = written(ply_of(folder, mesh));
    CHECK(all.tiles.told.levels >= 4);
    CHECK(all.tiles.told.tiles == all.files.size());
    CHECK(all.tiles.names.size() == all.files.size());
    CHECK(all.tiles.names.front() == "tileset/r.glb");
    const Cuts cuts(all);
    CHECK(closed_cuts(cuts, 50) > 25);
    for (const std::uint64_t seed : {1, 20, 30}) {
        const Cut cut = cuts.random(seed);
        const double measured = deviation(mesh, cut.mesh).maximum();
        CHECK(measured <= cut.error * 1.01 + 1e-6);
        CHECK(cut.error <= 4 * measured);
    }
}

TEST_CASE("cells of fewer faces than four tiles are tiled together", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_torus(320, 128, 0.002, 3)); // 81,920 faces
    // All three cell sizes give 64 leaves of 1,280 faces, with four below each tile. They make 32 cells of
    // 2,560, 16 of 5,120 or 64 of 1,280.
    for (const std::uint64_t cell : {2600, 5200, 1300}) {
        const Written all = written(path, {.cell = cell, .tile = 1500});
        CAPTURE(cell);
        CHECK(all.tiles.told.leaves == 64);
        CHECK(all.tiles.told.tiles == 64 + 16 + 4 + 1);
        CHECK(all.tiles.told.levels == 4);
    }
    // 128 cells of 640: two at the root, four below the others.
    const Written odd = written(path, {.cell = 700, .tile = 700});
    CHECK(odd.tiles.told.leaves == 128);
    CHECK(odd.tiles.told.tiles == 128 + 32 + 8 + 2 + 1);
    CHECK(odd.tileset["root"]["children"].size() == 2);
}

TEST_CASE("tiles from cells: errors fall to 0 at the leaves, which have all faces", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_icosphere(5, 0.02, 7);
    const Written all = written(ply_of(folder, mesh), {.cell = 3000, .tile = 800});
    const std::function<void(const Json&, double)> visit = [&](const Json& tile, double above) {
        const double error = tile["geometricError"];
        CHECK(error < above);
        CHECK((error == 0) == !tile.contains("children"));
        if (tile.contains("children"))
            for (const Json& child : tile["children"]) visit(child, error);
    };
    visit(all.tileset["root"], all.tileset["geometricError"]);
    CHECK(all.tiles.told.error == all.tileset["root"]["geometricError"]);
    for (auto& [name, bytes] : all.files) CHECK(all.tileset.dump().find(name) != std::string::npos);
    std::map<std::string, io::Bytes> files = all.files;
    files["tileset.json"] = all.tiles.index.front().bytes;
    for (const auto& [name, bytes] : files) {
        std::filesystem::create_directories((folder / name).parent_path());
        io::write_now(folder / name, bytes);
    }
    io::ReadLog log;
    const Scene back = io::read_scene(io::Input::open(folder / "tileset.json"), {}, log);
    CHECK(back.face_count() == mesh.face_count());
    CHECK(back.parts.front().mesh.vertex_count() == mesh.vertex_count());
    CHECK(deviation(mesh, back.parts.front().mesh).maximum() < 1e-6);
}

TEST_CASE("tiles from cells fit under compression and far from the origin", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_torus(150, 60, 0.002, 3));
    Wanted draco, meshopt, far;
    for (Wanted* one : {&draco, &meshopt, &far}) *one = {.cell = 1500, .tile = 500};
    draco.settings.draco.on = true;
    meshopt.settings.meshopt.on = meshopt.settings.quantize.on = true;
    far.transform = io::turn_up(UpAxis::y, UpAxis::z);
    far.transform.m[0][3] = 500000;
    far.transform.m[1][3] = 5800000;
    for (const Wanted& wanted : {draco, meshopt, far}) {
        const Written all = written(path, wanted);
        const Cuts cuts(all);
        CHECK(closed_cuts(cuts, 10) > 4);
        const Box box = cuts.random(0).mesh.bounds();
        CHECK(length(box.centre() - wanted.transform.point({})) < 0.1);
    }
}

TEST_CASE("borders of tiles from cells are held by place, whoever has the vertices", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::touching_sides(32);
    REQUIRE_FALSE(inspect(mesh).closed);
    const Written all = written(ply_of(folder, mesh), {.cell = 1500, .tile = 400});
    const Cuts cuts(all);
    CHECK(closed_cuts(cuts, 10) > 4);
}

TEST_CASE("tiles from cells depend on the mesh and the settings alone", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_torus(150, 60, 0.002, 3));
    const Written one = written(path, {.cell = 1500, .tile = 500});
    const auto same = [&](const Written& other) {
        return one.files == other.files && one.tiles.index.front().bytes == other.tiles.index.front().bytes &&
               one.tiles.names == other.tiles.names;
    };
    CHECK(same(written(path, {.cell = 1500, .tile = 500, .memory = std::uint64_t{48} << 20})));
    const int before = threads();
    for (const int count : {1, 2, 5}) {
        set_threads(count);
        CHECK(same(written(path, {.cell = 1500, .tile = 500})));
    }
    set_threads(before);
}

TEST_CASE("a single cell gives the tiles that memory gives", "[cells]") {
    const test::TemporaryDirectory folder;
    const Mesh mesh = test::noisy_torus(60, 40, 0.002, 3);
    const Written cells = written(ply_of(folder, mesh), {.cell = 100000, .tile = 500});
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::z;
    scene.parts.emplace_back().mesh = mesh;
    io::WriteSettings settings;
    settings.tiles.faces = 500;
    settings.title = "tileset";
    const io::Written whole = io::codec_named("3d-tiles")->write(scene, settings);
    REQUIRE(whole.files.size() == cells.files.size() + 1);
    CHECK(parse_json(io::as_text(whole.files.front().bytes))["geometricError"] ==
          cells.tileset["geometricError"]);
    CHECK(whole.tiles->error == cells.tiles.told.error);
}

TEST_CASE("tiles that memory does not hold are refused by name", "[cells]") {
    const test::TemporaryDirectory folder;
    const auto path = ply_of(folder, test::noisy_icosphere(5, 0.02, 7));
    CHECK(test::failure_id([&] { written(path, {.memory = std::uint64_t{20} << 20}); }) == "E-MEMORY");
    Wanted huge;
    for (std::size_t axis = 0; axis < 3; ++axis) huge.transform.m[axis][axis] = 1e300;
    CHECK(test::failure_id([&] { written(path, huge); }) == "E-RANGE");
}

} // namespace write_tiles_test
