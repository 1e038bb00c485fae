#include "geometry/tile/tile.hpp"

#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/measure.hpp"

#include <set>

using namespace facetmill;

namespace {

TileSettings grid_of(std::vector<TileAxis> axes, bool cap = true) {
    TileSettings settings;
    settings.axes = std::move(axes);
    settings.clip.cap = cap;
    return settings;
}

using Points = std::set<std::array<double, 3>>;

Points at_level(const Mesh& mesh, std::size_t axis, double level) {
    Points points;
    for (const Vec3& p : mesh.positions)
        if (p[axis] == level) points.insert({p.x, p.y, p.z});
    return points;
}

/// The triangles in a plane, each from its lowest point, optionally reversed.
std::multiset<std::array<std::array<double, 3>, 3>> faces_at_level(const Mesh& mesh, std::size_t axis,
                                                                   double level, bool turned) {
    std::multiset<std::array<std::array<double, 3>, 3>> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<std::array<double, 3>> p;
        for (const Index w : mesh.face_wedges(f)) {
            const Vec3& q = mesh.positions[mesh.vertex_of_wedge(w)];
            if (q[axis] == level) p.push_back({q.x, q.y, q.z});
        }
        if (p.size() != 3 || mesh.face_size(f) != 3) continue;
        if (turned) std::swap(p[1], p[2]);
        std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
        faces.insert({p[0], p[1], p[2]});
    }
    return faces;
}

} // namespace

TEST_CASE("tiles add up and are closed when they are capped", "[geometry]") {
    const Mesh sphere = shapes::icosphere(3);
    const TileResult r = tile(sphere, grid_of({{0, 0.4, 0.05}, {1, 0.5, 0}, {2, 0.7, 0.1}}));
    double volume = 0;
    std::set<std::array<std::int64_t, 3>> cells;
    for (const Tile& t : r.tiles) {
        CHECK(broken_invariants(t.mesh).empty());
        CHECK(test::closed(t.mesh));
        volume += test::volume(t.mesh);
        cells.insert(t.cell);
        const Box box = t.mesh.bounds();
        for (std::size_t i = 0; i < 3; ++i) {
            const double size[] = {0.4, 0.5, 0.7}, origin[] = {0.05, 0, 0.1};
            CHECK(box.min[i] >= origin[i] + static_cast<double>(t.cell[i]) * size[i]);
            CHECK(box.max[i] <= origin[i] + static_cast<double>(t.cell[i] + 1) * size[i]);
        }
    }
    CHECK(cells.size() == r.tiles.size());
    CHECK(r.tiles.size() > 60);
    CHECK(volume == Approx(test::volume(sphere)).epsilon(1e-12));
    CHECK(r.open.empty());
}

namespace {

/// Compares the borders of neighbouring tiles; returns the number of borders.
std::size_t check_borders(const TileResult& r, double size, const std::array<double, 2>& origin,
                          bool capped) {
    std::size_t borders = 0;
    for (const Tile& a : r.tiles)
        for (const Tile& b : r.tiles)
            for (std::size_t axis = 0; axis < 2; ++axis) {
                auto next = a.cell;
                ++next[axis];
                if (b.cell != next) continue;
                const double level = origin[axis] + size * static_cast<double>(b.cell[axis]);
                CHECK(at_level(a.mesh, axis, level) == at_level(b.mesh, axis, level));
                if (capped)
                    CHECK(faces_at_level(a.mesh, axis, level, false) ==
                          faces_at_level(b.mesh, axis, level, true));
                borders += !at_level(a.mesh, axis, level).empty();
            }
    return borders;
}

} // namespace

TEST_CASE("neighbouring tiles have the same points at their border", "[geometry]") {
    const TileResult r = tile(shapes::torus(40, 30), grid_of({{0, 0.5, 0.01}, {1, 0.5, 0.02}}, false));
    CHECK(check_borders(r, 0.5, {0.01, 0.02}, false) > 20);
}

TEST_CASE("... and the same caps, turned round", "[geometry]") {
    const TileResult r = tile(shapes::torus(40, 30), grid_of({{0, 0.5, 0.03}, {1, 0.5, 0.07}}));
    CHECK(check_borders(r, 0.5, {0.03, 0.07}, true) > 20);
}

TEST_CASE("a tile says which it is", "[geometry]") {
    const TileResult r = tile(shapes::grid(4, 2), grid_of({{0, 1, 0.5}, {1, 2, 0}}, false));
    REQUIRE(r.tiles.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        const Mesh& mesh = r.tiles[i].mesh;
        const Attribute *x = mesh.find("tile_x", Domain::face), *y = mesh.find("tile_y", Domain::face);
        REQUIRE(x);
        REQUIRE(y);
        CHECK_FALSE(mesh.find("tile_z", Domain::face));
        CHECK(x->value(0, 0) == static_cast<double>(i) - 1);
        CHECK(y->value(0, 0) == 0);
        CHECK(test::area(mesh) == Approx(i == 0 || i == 4 ? 1 : 2));
    }
}

TEST_CASE("a tile of a cloud says which it is at each point", "[geometry]") {
    Mesh cloud;
    cloud.positions = {{0.5, 0, 0}, {1.5, 0, 0}, {1, 0, 0}, {-3.5, 2.5, 0}};
    const TileResult r = tile(cloud, grid_of({{0, 1, 0}, {1, 1, 0}}, false));
    REQUIRE(r.tiles.size() == 3);
    for (const Tile& t : r.tiles) {
        for (const char* name : {"tile_x", "tile_y"}) {
            const Attribute* at = t.mesh.find(name, Domain::wedge);
            REQUIRE(at);
            CHECK(at->role == Role::index);
            REQUIRE(at->size() == t.mesh.wedge_count());
            for (std::size_t i = 0; i < at->size(); ++i)
                CHECK(at->value(i, 0) == static_cast<double>(t.cell[name == std::string("tile_y")]));
        }
        CHECK_FALSE(t.mesh.find("tile_z", Domain::wedge));
        CHECK_FALSE(t.mesh.find("tile_x", Domain::face));
    }
    CHECK(r.tiles.back().cell == std::array<std::int64_t, 3>{-4, 2, 0});
}

TEST_CASE("a mesh within one cell stays as it is, also with its faces on the border", "[geometry]") {
    const TileResult r = tile(shapes::cube(), grid_of({{0, 1, 0}, {1, 1, 0}, {2, 1, 0}}));
    REQUIRE(r.tiles.size() == 1);
    CHECK(r.tiles[0].cell == std::array<std::int64_t, 3>{0, 0, 0});
    CHECK(r.tiles[0].mesh.corners == shapes::cube().corners);
    CHECK(r.cut_faces == 0);
    CHECK(tile(Mesh{}, grid_of({{0, 1, 0}})).tiles.empty());
}

TEST_CASE("tiles of a turned part stand in the world", "[geometry]") {
    TileSettings settings = grid_of({{0, 0.3, 0}, {1, 0.3, 0}});
    settings.to_world.m[0][0] = 0.8;
    settings.to_world.m[0][1] = -0.6;
    settings.to_world.m[1][0] = 0.6;
    settings.to_world.m[1][1] = 0.8;
    settings.to_world.m[0][3] = 5;
    double volume = 0;
    for (const Tile& t : tile(shapes::icosphere(2), settings).tiles) {
        CHECK(test::closed(t.mesh));
        volume += test::volume(t.mesh);
        for (const Vec3& p : t.mesh.positions) {
            const Vec3 q = settings.to_world.point(p);
            CHECK(q.x > 0.3 * static_cast<double>(t.cell[0]) - 1e-12);
            CHECK(q.x < 0.3 * static_cast<double>(t.cell[0] + 1) + 1e-12);
        }
    }
    CHECK(volume == Approx(test::volume(shapes::icosphere(2))).epsilon(1e-12));
}

TEST_CASE("too many tiles, and none, are refused", "[geometry]") {
    CHECK(test::failure([] {
              tile(shapes::cube(), grid_of({{0, 1e-12, 0}}));
          }) == "limit [E-TILE] a part would be cut into about 1e+12 rows of tiles along one axis | choose a "
                "larger size");
    TileSettings few = grid_of({{0, 0.01, 0}});
    few.axes.push_back({1, 0.01, 0});
    few.limit = 1000;
    CHECK(test::failure([&] { tile(shapes::cube(), few); }) ==
          "limit [E-TILE] there would be more than 1000 tiles | choose a larger size");
    CHECK(test::failure([] {
              tile(shapes::cube(), grid_of({{0, 0, 0}}));
          }) == "usage [E-TILE] a tile's size must be above zero");
}

TEST_CASE("tiles: points that rounding puts beyond their plane do not cut a half again and again",
          "[geometry]") {
    Mesh mesh;
    mesh.positions = {{0.39350000023841858, 0, 0},
                      {-2.8605707484530285e-05, -1.635079231437138e-18, -0.12084858119487762},
                      {0.2496829479932785, 0, -0.3660675585269928},
                      {0.24921877682209015, -1.1647414400073425e-17, -0.37906917649929353},
                      {-5.3308293159412759e-17, 0.72183173894882202, -0.31369361281394958},
                      {0.033971618860960007, -8.537025045333154e-18, -0.12268006801605225}};
    mesh.corners = {0, 2, 3, 1, 4, 5};
    const TileResult r = tile(mesh, grid_of({{0, 0.9, 0}, {1, 0.9, 0}, {2, 0.9, 0}}));
    double area = 0;
    for (const Tile& t : r.tiles) area += test::area(t.mesh);
    CHECK(r.tiles.size() <= 16);
    CHECK(area >= test::area(mesh) * (1 - 1e-12));
}
