#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "oracle/insides_oracle.hpp"
#include "parallel/parallel.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;
constexpr SelfIntersectionSettings all{.limit = SIZE_MAX},
    apart{.limit = SIZE_MAX, .among = {}, .separate_touching = true};

void add_triangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
        mesh.corners.push_back(static_cast<Index>(mesh.positions.size()));
        mesh.positions.push_back(p);
    }
}

/// Two faces that share the edge from low to high on the z axis, and go out from it towards p and q.
void add_sheet(Mesh& mesh, double low, double high, const Vec3& p, const Vec3& q) {
    const auto first = static_cast<Index>(mesh.positions.size());
    for (const Vec3& point : {Vec3{0, 0, low}, Vec3{0, 0, high}, p, q}) mesh.positions.push_back(point);
    for (const Index v : {0u, 1u, 2u, 1u, 0u, 3u}) mesh.corners.push_back(first + v);
}

/// {running into each other, touching}
std::pair<std::size_t, std::size_t> counts(const Mesh& mesh) {
    const auto found = find_self_intersections(mesh, apart);
    return {found.count, found.touching};
}
using PairCounts = std::pair<std::size_t, std::size_t>;

constexpr Vec3 east{1, 0, 0.5}, north{0, 1, 0.5}, west{-1, 0, 0.5}, south{0, -1, 0.5};

std::array<Vec3, 3> corners(const Mesh& mesh, Index f) {
    return {mesh.point(3 * f), mesh.point(3 * f + 1), mesh.point(3 * f + 2)};
}

Mesh of_boxes(std::initializer_list<Vec3> at) {
    Mesh mesh;
    for (const Vec3& p : at) append(mesh, moved(shapes::cube(), p));
    return mesh;
}

} // namespace

TEST_CASE("two sheets at one edge touch or pass through each other", "[geometry]") {
    Mesh beside, through;
    add_sheet(beside, 0, 1, east, north);
    add_sheet(beside, 0, 1, west, south);
    CHECK(counts(beside) == PairCounts{0, 4});
    add_sheet(through, 0, 1, east, west);
    add_sheet(through, 0, 1, north, south);
    CHECK(counts(through) == PairCounts{4, 0});
    CHECK(find_self_intersections(through, apart).pairs == Pairs{{0, 2}, {0, 3}, {1, 2}, {1, 3}});
    Mesh nested; // both on one side: an angle inside another
    add_sheet(nested, 0, 1, east, north);
    add_sheet(nested, 0, 1, {3, 1, 0.5}, {1, 3, 0.5});
    CHECK(counts(nested) == PairCounts{0, 4});
    Mesh askew;
    add_sheet(askew, 0, 1, east, north);
    add_sheet(askew, 0, 1, {3, 1, 0.5}, {-1, 3, 0.5});
    CHECK(counts(askew) == PairCounts{4, 0});
}

TEST_CASE("edges that overlap in part are edges together, those end to end are not", "[geometry]") {
    Mesh part;
    add_sheet(part, 0, 1, east, west);
    add_sheet(part, 0.5, 2, north, south);
    CHECK(counts(part) == PairCounts{4, 0});
    Mesh beside;
    add_sheet(beside, 0, 1, east, north);
    add_sheet(beside, 0.5, 2, west, south);
    CHECK(counts(beside) == PairCounts{0, 4});
    Mesh ends;
    add_sheet(ends, 0, 1, east, west);
    add_sheet(ends, 1, 2, {0, 1, 1.5}, {0, -1, 1.5});
    CHECK(counts(ends) == PairCounts{0, 4});
}

TEST_CASE("one open face at an edge passes through nothing", "[geometry]") {
    Mesh mesh;
    add_sheet(mesh, 0, 1, east, west);
    add_triangle(mesh, {0, 0, 0}, {0, 0, 1}, north);
    CHECK(counts(mesh) == PairCounts{0, 2});
}

TEST_CASE("where a face beyond the edge has no area, faces do not only touch", "[geometry]") {
    Mesh mesh;
    add_sheet(mesh, 0, 1, east, {0, 0, 0.25});
    add_triangle(mesh, {0, 0, 0}, {0, 0, 1}, north);
    CHECK(counts(mesh) == PairCounts{1, 0});
}

TEST_CASE("a corner inside a face, an edge in a face and a chord across are no mere touching", "[geometry]") {
    Mesh corner;
    add_triangle(corner, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    add_triangle(corner, {1, 1, 0}, {1, 1, 1}, {2, 1, 1});
    CHECK(counts(corner) == PairCounts{1, 0});
    Mesh edge;
    add_triangle(edge, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    add_triangle(edge, {1, 1, 0}, {2, 1, 0}, {2, 1, 1});
    CHECK(counts(edge) == PairCounts{1, 0});
    Mesh chord; // the two meet in a chord of both, whose ends are on edges of both
    add_triangle(chord, {0, -1, 0}, {0, 1, 0}, {2, 0, 0});
    add_triangle(chord, {0, 0, -1}, {0, 0, 1}, {2, 0, 0});
    CHECK(counts(chord) == PairCounts{1, 0});
    Mesh tips;
    add_triangle(tips, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(tips, {0, 0, 0}, {-1, 0, 1}, {0, -1, 1});
    CHECK(counts(tips) == PairCounts{0, 1});
    Mesh middle; // the tip of one in the middle of an edge of the other
    add_triangle(middle, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(middle, {0, 0, 0}, {-1, -1, 1}, {1, -1, 1});
    CHECK(counts(middle) == PairCounts{0, 1});
    Mesh cross; // edge across edge in one point
    add_triangle(cross, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(cross, {0, 0, -1}, {0, 0, 1}, {0, -1, 0});
    CHECK(counts(cross) == PairCounts{0, 1});
    Mesh flat; // in one plane, along an edge and overlapping
    add_triangle(flat, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(flat, {0, 0, 0}, {1, 0, 0}, {0, -1, 0});
    CHECK(counts(flat) == PairCounts{0, 1});
    flat.positions.back().y = 0.25;
    CHECK(counts(flat) == PairCounts{1, 0});
}

TEST_CASE("solids that stand edge to edge or corner to corner touch; overlapping ones do not", "[geometry]") {
    CHECK(counts(of_boxes({{0, 0, 0}, {2, 0, 0}})) == PairCounts{0, 0});
    const auto [edge, at_edge] = counts(of_boxes({{0, 0, 0}, {1, 1, 0}}));
    CHECK(edge == 0);
    CHECK(at_edge > 0);
    const auto [shifted, at_part] = counts(of_boxes({{0, 0, 0}, {1, 1, 0.5}}));
    CHECK(shifted == 0);
    CHECK(at_part > 0);
    const auto [corner, at_corner] = counts(of_boxes({{0, 0, 0}, {1, 1, 1}}));
    CHECK(corner == 0);
    CHECK(at_corner > 0);
    CHECK(counts(of_boxes({{0, 0, 0}, {1, 0, 0}})).first > 0); // a whole side in common
    CHECK(counts(of_boxes({{0, 0, 0}, {0.5, 0.5, 0.5}})).first > 0);
}

TEST_CASE("columns whose walls cross at their edges only run into each other", "[geometry]") {
    Mesh mesh;
    const auto add_column = [&](const std::vector<Vec3>& ring) {
        const auto n = static_cast<Index>(ring.size()), first = static_cast<Index>(mesh.positions.size());
        for (const double z : {0.0, 1.0})
            for (const Vec3& p : ring) mesh.positions.push_back({p.x, p.y, z});
        for (Index i = 0; i < n; ++i) {
            const Index a = first + i, b = first + (i + 1) % n;
            for (const Index v : {a, b, b + n, a, b + n, a + n}) mesh.corners.push_back(v);
        }
    };
    add_column({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}});
    add_column({{1, 1, 0}, {2, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}, {1, 2, 0}});
    CHECK(counts(mesh).first == 8); // two triangles by two, at two edges
    mesh = {};
    add_column({{0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
    add_column({{1, 0, 0}, {2, -1, 0}, {2, 1, 0}});
    CHECK(counts(mesh).first == 0);
    CHECK(counts(mesh).second > 4);
}

TEST_CASE("what runs into and what touches are all pairs, and local touching agrees with exact arithmetic",
          "[geometry]") {
    std::size_t touching = 0, real = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        for (const Mesh& mesh :
             {snapped(random_triangles(300, 0.3, seed), 0.125),
              torn_apart(snapped(test::with_noise(shapes::icosphere(2), 0.2, seed), 0.125))}) {
            const auto found = find_self_intersections(mesh, apart);
            Pairs both = found.pairs;
            both.insert(both.end(), found.touching_pairs.begin(), found.touching_pairs.end());
            std::sort(both.begin(), both.end());
            CHECK(both == find_self_intersections(mesh, all).pairs);
            CHECK(found.count == found.pairs.size());
            CHECK(found.touching == found.touching_pairs.size());
            for (const auto& [f, g] : found.pairs)
                CHECK(oracle::insides_meet(corners(mesh, f), corners(mesh, g)));
            for (const auto& [f, g] : found.touching_pairs)
                CHECK_FALSE(oracle::insides_meet(corners(mesh, f), corners(mesh, g)));
            real += found.count;
            touching += found.touching;
        }
    CHECK(real > 1000);
    CHECK(touching > 1000);
}

TEST_CASE("a surface torn apart along all its edges touches itself and nothing more", "[geometry]") {
    for (const Mesh& mesh : {shapes::icosphere(3), shapes::torus(20, 12), shapes::cube()})
        CHECK(find_self_intersections(torn_apart(mesh), apart).count == 0);
}

TEST_CASE("polygons that touch in one triangle and overlap in another run into each other once",
          "[geometry]") {
    Mesh mesh = shapes::quad_cube();
    append(mesh, moved(shapes::quad_cube(), {1, 0.25, 0}));
    const auto found = find_self_intersections(mesh, apart);
    for (const auto& pair : found.touching_pairs)
        CHECK(std::find(found.pairs.begin(), found.pairs.end(), pair) == found.pairs.end());
    CHECK(found.count > 0);
    CHECK(found.count + found.touching == find_self_intersections(mesh, all).count);
}

TEST_CASE("touching is the same for any number of threads", "[geometry]") {
    const Mesh mesh = torn_apart(snapped(test::with_noise(shapes::icosphere(3), 0.2, 3), 0.0625));
    set_threads(1);
    const auto one = find_self_intersections(mesh, apart);
    set_threads(0);
    const auto many = find_self_intersections(mesh, apart);
    CHECK(one.pairs == many.pairs);
    CHECK(one.touching_pairs == many.touching_pairs);
}
