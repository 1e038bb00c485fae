// clean's steps for faces that intersect, that are doubled, for holes that touch, and for points that would
// make faces intersect.
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "base/math/numbers.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/inspect.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

CleanSettings untangling() {
    CleanSettings s;
    s.self_intersections = Untangle::local;
    return s;
}

std::size_t intersections(const Mesh& mesh) {
    return inspect(mesh, {.self_intersections = true}).self_intersections.value();
}

/// One vertex pushed through the far side: two small places that intersect.
Mesh pierced() {
    Mesh mesh = shapes::icosphere(3);
    mesh.positions[0] *= -1.5;
    return mesh;
}

/// Two perpendicular rings that pass through each other.
Mesh crossing_tubes() {
    Mesh mesh;
    for (int tube = 0; tube < 2; ++tube) {
        Mesh one = shapes::torus(32, 16, 2, 0.5);
        for (Vec3& p : one.positions) p = tube == 0 ? p : Vec3{p.x + 0.2, p.z, p.y};
        append(mesh, one);
    }
    return mesh;
}

/// A sheet of squares without some of them.
Mesh sheet_without(int columns, int rows, const std::vector<std::pair<int, int>>& gone) {
    Mesh mesh;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) mesh.positions.push_back({double(x), double(y), 0});
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            if (std::find(gone.begin(), gone.end(), std::pair{x, y}) != gone.end()) continue;
            const auto v = static_cast<Index>(y * (columns + 1) + x),
                       up = v + static_cast<Index>(columns + 1);
            add_face(mesh, std::vector<Index>{v, v + 1, up + 1, up});
        }
    return mesh;
}

/// Cubes around a hole that has shrunk to the edge from (1, 1, 1) to (1, 1, 2). Its ends lie inside the
/// surfaces of two slabs.
Mesh closed_ring() {
    Mesh mesh;
    for (int z = 0; z < 3; ++z)
        for (int x = 0; x < 2; ++x)
            for (int y = 0; y < 2; ++y) {
                if (z == 1 && x != y) continue;
                Mesh cube = shapes::cube();
                for (Vec3& p : cube.positions) p += Vec3{double(x), double(y), double(z)};
                append(mesh, cube);
            }
    weld_exact(mesh);
    CleanSettings s; // without the walls between cubes
    s.non_manifold = false;
    return clean(std::move(mesh), s).mesh;
}

CleanSettings to_single() {
    CleanSettings s;
    s.single = true;
    return s;
}

Index vertex_at(const Mesh& mesh, const Vec3& place) {
    const auto at = std::find(mesh.positions.begin(), mesh.positions.end(), place);
    REQUIRE(at != mesh.positions.end());
    return static_cast<Index>(at - mesh.positions.begin());
}

} // namespace

TEST_CASE("clean untangles what it can where other faces cannot be", "[geometry]") {
    Mesh mesh = pierced();
    append(mesh, moved(crossing_tubes(), {10, 0, 0}));
    const std::size_t tubes = intersections(crossing_tubes());
    REQUIRE(tubes > 0);
    REQUIRE(intersections(mesh) > tubes);
    const auto r = clean(mesh, untangling());
    CHECK(r.counts.intersecting_faces > 0);
    CHECK(intersections(r.mesh) == tubes);
    REQUIRE(r.not_done.size() > 0);
    for (const NotDone& n : r.not_done) {
        CHECK(n.step == "self_intersections");
        CHECK(n.at.x > 5); // where the tubes are
    }
}

TEST_CASE("clean does not cut a tube that passes through another", "[geometry]") {
    const Mesh tubes = crossing_tubes();
    const auto r = clean(tubes, untangling());
    CHECK(test::same_mesh(r.mesh, tubes));
}

TEST_CASE("clean does not take a mesh away for its intersections", "[geometry]") {
    CleanSettings s = untangling();
    s.holes = HoleSettings{};
    s.inner_components = true;
    s.stitch = Nearness::exact;
    for (const Mesh& mesh : {shapes::fan3(), shapes::crossing(), shapes::hourglass(),
                             random_triangles(60, 0.3, 7), shapes::folded_quad()}) {
        const auto r = clean(mesh, s);
        CHECK(r.mesh.face_count() >= mesh.face_count());
    }
}

TEST_CASE("clean leaves the border open where it untangles an open surface", "[geometry]") {
    Mesh mesh = shapes::grid(20, 20);
    for (Vec3& p : mesh.positions)
        if (p.x == 10 && p.y == 10) p = {12.5, 10.25, 0}; // folds over its neighbours
    const auto borders = inspect(mesh).boundary_edges;
    REQUIRE(intersections(mesh) > 0);
    const auto r = clean(mesh, untangling());
    CHECK(r.counts.intersecting_faces > 0);
    CHECK(intersections(r.mesh) == 0);
    CHECK(inspect(r.mesh).boundary_edges == borders);
}

TEST_CASE("clean fills holes that touch at a vertex each for itself", "[geometry]") {
    const Mesh mesh = sheet_without(4, 4, {{1, 1}, {2, 2}});
    for (const HoleFill method : {HoleFill::minimal, HoleFill::planar, HoleFill::smooth}) {
        CleanSettings s;
        s.holes = HoleSettings{method, 10, 0};
        const auto r = clean(mesh, s);
        CHECK(r.counts.filled_holes == 2);
        CHECK(r.counts.split_vertices == 0);
        CHECK(inspect(r.mesh).boundary_loops == 1);
        CHECK(test::area(r.mesh) == Approx(16));
    }
}

TEST_CASE("clean leaves a hole whose patch would run into other faces, and says so", "[geometry]") {
    Mesh mesh = shapes::quad_cube(); // without its top
    Index top = none;
    for (Index f = 0; f < 6; ++f) {
        bool high = true;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) high = high && mesh.point(c).z == 1;
        if (high) top = f;
    }
    REQUIRE(top != none);
    std::vector<Index> others;
    for (Index f = 0; f < 6; ++f)
        if (f != top) others.push_back(f);
    Mesh open = keep_faces(mesh, others);
    append(open, moved(open, {3, 0, 0})); // a second shell, without obstacles
    Mesh spike = shapes::tetrahedron();   // through the first one's opening
    for (Vec3& p : spike.positions) p = p * 0.25 + Vec3{0.3, 0.3, 0.9};
    append(open, spike);
    CleanSettings s;
    s.holes = HoleSettings{};
    for (const HoleFill method : {HoleFill::minimal, HoleFill::planar, HoleFill::smooth}) {
        s.holes->method = method;
        const auto r = clean(open, s);
        CHECK(r.counts.filled_holes == 1);
        CHECK(intersections(r.mesh) == 0);
        REQUIRE(r.not_done.size() == 1);
        CHECK(r.not_done[0].step == "holes");
        CHECK(r.not_done[0].at.x <= 1);
        CHECK(r.not_done[0].why == "a patch would intersect other faces");
        CHECK(test::broken_clean_law(open, s).empty());
    }
    s.self_intersections = Untangle::unite; // then the patch and the spike become one solid
    const auto r = clean(open, s);
    CHECK(r.not_done.empty());
    CHECK(inspect(r.mesh).closed);
    CHECK(intersections(r.mesh) == 0);
    CHECK(test::volume(r.mesh) > 2);
    CHECK(test::volume(r.mesh) < 2 + test::volume(spike));
}

TEST_CASE("clean keeps doubled faces that hold a closed surface closed", "[geometry]") {
    // Two tetrahedra over one triangle, both on the same side, and the triangle twice.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 1}, {0.3, 0.3, 2}};
    mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1, 0, 1, 4, 1, 2, 4, 2, 0, 4};
    REQUIRE(inspect(mesh).closed);
    REQUIRE(inspect(mesh).duplicate_faces == 1);
    CHECK(inspect(clean(mesh, {}).mesh).closed);
    // A second copy of a face of a closed surface is removed.
    Mesh copied = shapes::cube();
    for (const Index c : {0U, 1U, 2U, 0U, 1U, 2U}) copied.corners.push_back(copied.corners[c]);
    CHECK(clean(copied, {}).mesh.corners == shapes::cube().corners);
}

TEST_CASE("clean does not open a closed surface by a doubled sheet", "[geometry]") {
    Mesh mesh = shapes::cube(), sheet;
    sheet.positions = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
    sheet.corners = {0, 1, 2, 0, 2, 1};
    Mesh touching = mesh; // at the cube's corner: a fin
    append(touching, sheet);
    weld_exact(touching);
    const auto fin = clean(touching, {});
    CHECK(fin.mesh.corners == mesh.corners);
    Mesh beside = mesh;
    append(beside, moved(sheet, {3, 0, 0}));
    const auto r = clean(beside, {});
    CHECK(inspect(r.mesh).closed);
    CHECK(r.mesh.face_count() == 14);
    REQUIRE(r.not_done.size() == 1);
    CHECK(r.not_done[0].step == "duplicates");
}

TEST_CASE("clean lets no face pass beside the rounded middle of another's edge", "[geometry]") {
    const Mesh ring = closed_ring();
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Mesh mesh = ring;
        double m[9];
        for (std::size_t i = 0; i < 9; ++i)
            m[i] = (i % 4 == 0 ? 1 : 0) + 1e-3 * static_cast<double>(hashed(seed, i) % 700);
        for (Vec3& p : mesh.positions)
            p = as_float32(Vec3{m[0] * p.x + m[1] * p.y + m[2] * p.z, m[3] * p.x + m[4] * p.y + m[5] * p.z,
                                m[6] * p.x + m[7] * p.y + m[8] * p.z});
        INFO(seed);
        REQUIRE(intersections(mesh) == 0);
        const CleanResult r = clean(mesh, to_single());
        CHECK(r.counts.split_edges == 1);
        CHECK(intersections(r.mesh) == 0);
        CHECK(inspect(r.mesh).edge_manifold);
        CHECK(inspect(r.mesh).closed);
        CHECK(broken_clean_law(mesh, to_single()) == "");
    }
}

TEST_CASE("clean adds one point less where the middle of an edge is exact", "[geometry]") {
    const Mesh ring = closed_ring();
    const CleanResult r = clean(ring, to_single());
    CHECK(r.counts.split_edges == 1);
    CHECK(r.mesh.vertex_count() == ring.vertex_count() + 1);
    CHECK(r.not_done.empty());
}

TEST_CASE("clean leaves an edge of more than two faces where its rounded middle would spoil faces",
          "[geometry]") {
    // The midpoint is rounded onto a line through a vertex next to the edge.
    Mesh mesh = closed_ring();
    const double step = std::ldexp(1.0, -23);
    const Index a = vertex_at(mesh, {1, 1, 1}), b = vertex_at(mesh, {1, 1, 2});
    mesh.positions[b].x += step;
    Mesh result;
    result.positions = mesh.positions;
    result.positions.push_back({1, 1, 1.25});
    const auto p = static_cast<Index>(mesh.vertex_count());
    int cut = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face_wedges(f);
        std::vector<Index> corners(face.begin(), face.end());
        const auto third = std::find_if(corners.begin(), corners.end(),
                                        [&](Index v) { return mesh.positions[v].x < 1 && v != a && v != b; });
        const bool holds = std::count(corners.begin(), corners.end(), a) == 1 &&
                           std::count(corners.begin(), corners.end(), b) == 1;
        if (!holds || third == corners.end() || mesh.positions[*third].y != 1) {
            add_face(result, corners);
            continue;
        }
        ++cut;
        for (std::size_t i = 0; i < 3; ++i)
            add_face(result, std::vector<Index>{corners[i], corners[(i + 1) % 3], p});
    }
    REQUIRE(cut == 1);
    REQUIRE(intersections(result) == 0);
    const CleanResult r = clean(result, to_single());
    CHECK(r.counts.split_edges == 0);
    CHECK(intersections(r.mesh) == 0);
    CHECK(inspect(r.mesh).degenerate_faces == 0);
    REQUIRE(r.not_done.size() == 1);
    CHECK(r.not_done[0].step == "non_manifold");
    CHECK(r.not_done[0].at == Vec3{1, 1, 1.5});
    CHECK(broken_clean_law(result, to_single()) == "");
}
