#include "geometry/pyramid/pyramid.hpp"

#include "base/math/random.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "parallel/parallel.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

using namespace facetmill;

namespace pyramid_test {

namespace {

/// A mesh on steps of 2^-20, as the pyramid keeps it.
Mesh on_steps(Mesh mesh) {
    for (Vec3& p : mesh.positions)
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = std::round(std::ldexp(p[axis], 20)) / (1 << 20);
    return mesh;
}

constexpr double step = 1.0 / (1 << 20);

struct Cut {
    Mesh mesh;
    double error = 0; ///< the largest of its tiles
    std::size_t tiles = 0, levels = 0;
};

/// Tiles that are refined as chance has it, as one mesh.
Cut random_cut(const std::vector<PyramidTile>& tiles, std::uint64_t seed) {
    Cut cut;
    std::vector<std::size_t> waiting{0};
    std::vector<std::size_t> depths;
    while (!waiting.empty()) {
        const std::size_t t = waiting.back();
        waiting.pop_back();
        const PyramidTile& tile = tiles[t];
        if (!tile.children.empty() && uniform(hashed(seed, t)) < 0.6) {
            waiting.insert(waiting.end(), tile.children.begin(), tile.children.end());
            continue;
        }
        append(cut.mesh, tile.mesh);
        cut.error = std::max(cut.error, tile.error);
        ++cut.tiles;
        depths.push_back(tile.name.size());
    }
    std::sort(depths.begin(), depths.end());
    cut.levels = static_cast<std::size_t>(std::unique(depths.begin(), depths.end()) - depths.begin());
    weld_exact(cut.mesh);
    return cut;
}

/// A bumpy sphere with texture coordinates and colours.
Mesh bumpy() {
    Mesh mesh = shapes::icosphere(5);
    Attribute uv{"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>{}};
    uv.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
        Vec3& p = mesh.positions[v];
        uv.set_value(v, 0, p.x);
        uv.set_value(v, 1, p.y);
        p = p * (1 + 0.1 * uniform(hashed(1, v)));
    }
    mesh.attributes.push_back(std::move(uv));
    return on_steps(std::move(mesh));
}

} // namespace

TEST_CASE("every cut of a pyramid of a closed mesh is closed, and as near as its tiles say", "[pyramid]") {
    const Mesh mesh = bumpy();
    const auto tiles = make_pyramid(mesh, {400, step});
    REQUIRE(tiles.size() > 40);
    bool mixed = false;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const Cut cut = random_cut(tiles, seed);
        const Properties p = inspect(cut.mesh);
        CAPTURE(seed, cut.tiles, cut.levels);
        CHECK(p.closed);
        CHECK(p.edge_manifold);
        CHECK(p.oriented);
        CHECK(p.components == 1);
        mixed |= cut.levels > 2;
        if (seed % 10 == 0) CHECK(deviation(mesh, cut.mesh).maximum() <= cut.error * 1.01 + 1e-9);
    }
    CHECK(mixed);
}

TEST_CASE("errors fall from the root to 0 at the leaves, which have all faces", "[pyramid]") {
    const Mesh mesh = bumpy();
    const auto tiles = make_pyramid(mesh, {1000, step});
    std::size_t faces = 0;
    for (const PyramidTile& tile : tiles) {
        CHECK(tile.mesh.find("TEXCOORD_0", Domain::wedge));
        for (const Vec3& p : tile.mesh.positions)
            CHECK(std::ldexp(p.x, 20) == std::round(std::ldexp(p.x, 20)));
        if (tile.children.empty()) {
            faces += tile.mesh.face_count();
            CHECK(tile.error == 0);
            CHECK(tile.mesh.face_count() <= 1000);
        }
        for (const std::size_t child : tile.children) CHECK(tiles[child].error < tile.error);
    }
    CHECK(faces == mesh.face_count());
    CHECK(tiles[0].mesh.face_count() <= 1000);
    CHECK_FALSE(tiles[0].mesh.has_seams()); // common borders of tiles are not seams in the parent
}

TEST_CASE("a pyramid has as few tiles as its faces need, and as even ones", "[pyramid]") {
    const Mesh mesh = on_steps(shapes::icosphere(4));
    const std::size_t faces = mesh.face_count();
    REQUIRE(faces == 5120);
    for (const std::size_t most : {5120, 5119, 2000, 1100, 1000, 800, 640, 400, 300, 100}) {
        const auto tiles = make_pyramid(mesh, {most, step});
        std::size_t leaves = 0, fewest = faces, deepest = 0, room = 1;
        for (const PyramidTile& tile : tiles) {
            deepest = std::max(deepest, tile.name.size());
            CHECK(tile.children.size() <= 4);
            CHECK(tile.children.size() != 1);
            if (!tile.children.empty()) continue;
            ++leaves;
            CHECK(tile.mesh.face_count() <= most);
            fewest = std::min(fewest, tile.mesh.face_count());
        }
        CAPTURE(most, leaves);
        CHECK(leaves == (faces + most - 1) / most);
        CHECK(tiles.size() == leaves + (leaves + 1) / 3); // four below each but perhaps one
        CHECK(fewest + 8 >= faces / leaves);
        for (std::size_t level = 0; level < deepest; ++level) room *= 4;
        CHECK((leaves <= room && 4 * leaves > room));
    }
}

TEST_CASE("borders are held by place, whoever has the vertices", "[pyramid]") {
    const Mesh mesh = test::touching_sides(16);
    REQUIRE_FALSE(inspect(mesh).closed);
    Mesh welded = mesh;
    weld_exact(welded);
    REQUIRE(inspect(welded).closed);
    const auto tiles = make_pyramid(mesh, {200, 1.0 / 1024});
    for (std::uint64_t seed = 0; seed < 10; ++seed) CHECK(inspect(random_cut(tiles, seed).mesh).closed);
}

TEST_CASE("small, broken and scattered meshes are pyramids, too", "[pyramid]") {
    CHECK(make_pyramid(shapes::tetrahedron(), {100, 0}).size() == 1);
    for (const Mesh& mesh : {shapes::fan3(), shapes::hourglass(), shapes::crossing()}) {
        const auto tiles = make_pyramid(mesh, {1, 0});
        CHECK(tiles.size() > 1);
        for (const PyramidTile& tile : tiles) CHECK(broken_invariants(tile.mesh).empty());
    }
    Mesh many; // 300 tetrahedra, which can only have fewer faces if some vanish
    for (int i = 0; i < 300; ++i) {
        Mesh one = shapes::tetrahedron();
        Transform t;
        t.m[0][3] = 3 * (i % 20);
        t.m[1][3] = 3 * (i / 20);
        apply(one, t);
        append(many, one);
    }
    const auto tiles = make_pyramid(many, {200, 0});
    CHECK(tiles[0].mesh.face_count() <= 400);
    CHECK(tiles[0].error > 1);
    CHECK(inspect(tiles[0].mesh).closed);
}

} // namespace pyramid_test
