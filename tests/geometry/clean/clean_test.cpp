#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/clean/clean.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "mesh/topology.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

CleanSettings nothing() {
    CleanSettings s;
    s.weld = s.t_junctions = Nearness::off;
    s.degenerate = s.duplicates = s.non_manifold = s.isolated = false;
    return s;
}

Mesh triangles(std::vector<Vec3> positions, std::vector<Index> corners) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.corners = std::move(corners);
    return mesh;
}

Mesh without_face(Mesh mesh, Index f) {
    mesh.corners.erase(mesh.corners.begin() + 3 * f, mesh.corners.begin() + 3 * f + 3);
    return mesh;
}

Mesh two_cubes(const Vec3& offset, double scale = 1) {
    Mesh mesh = shapes::cube(), other = shapes::cube();
    for (Vec3& p : other.positions) p = p * scale + offset;
    append(mesh, other);
    return mesh;
}

CleanResult cleaned(const Mesh& mesh, const CleanSettings& s = {}) {
    CleanResult r = clean(mesh, s);
    CHECK(broken_invariants(r.mesh).empty());
    return r;
}

bool is_sound_solid(const Mesh& mesh) {
    const Properties p = inspect(mesh);
    return p.closed && p.edge_manifold && p.vertex_manifold && p.oriented && p.degenerate_faces == 0 &&
           p.duplicate_faces == 0;
}

} // namespace

TEST_CASE("clean welds what is at one place", "[geometry]") {
    const auto r = cleaned(test::torn_apart(shapes::cube()));
    CHECK(r.counts.welded_vertices == 28);
    CHECK(r.mesh.vertex_count() == 8);
    CHECK(is_sound_solid(r.mesh));
}

TEST_CASE("clean with every step off changes nothing", "[geometry]") {
    const Mesh soup = test::torn_apart(shapes::cube());
    const auto r = cleaned(soup, nothing());
    CHECK(r.counts.total() == 0);
    CHECK(r.mesh.positions == soup.positions);
    CHECK(r.rounds == 1);
}

TEST_CASE("clean welds near ends of open edges only", "[geometry]") {
    Mesh mesh = test::torn_apart(shapes::cube());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.positions[v].x += 1e-4 * static_cast<double>(v % 3);
    CleanSettings s;
    s.weld = Nearness::near;
    s.tolerance = 1e-3;
    CHECK(is_sound_solid(cleaned(mesh, s).mesh));
    Mesh thin = shapes::cube(); // opposite walls nearer than the length stay apart
    for (Vec3& p : thin.positions) p.z *= 1e-4;
    CHECK(cleaned(thin, s).counts.total() == 0);
}

TEST_CASE("clean keeps seams when it welds", "[geometry]") {
    const Mesh mesh = shapes::uv_cube();
    CHECK(cleaned(mesh).mesh.wedge_count() == 24);
    CHECK(cleaned(mesh).counts.total() == 0);
}

TEST_CASE("clean stitches open edges whose ends are near", "[geometry]") {
    Mesh mesh = test::torn_apart(shapes::cube());
    weld_exact(mesh);
    const auto stray = static_cast<Index>(mesh.positions.size()); // one corner of one face is off
    mesh.positions.push_back(mesh.positions[mesh.corners[0]] + Vec3{0.01, 0.01, 0});
    mesh.corners[0] = stray;
    CleanSettings s = nothing();
    s.stitch = Nearness::near;
    s.tolerance = 0.05;
    const auto r = cleaned(mesh, s);
    CHECK(r.counts.stitched_edges == 2);
    CHECK(is_sound_solid(r.mesh));
    s.tolerance = 0.001;
    CHECK(cleaned(mesh, s).counts.total() == 0);
}

TEST_CASE("clean removes faces without area, and closed stays closed", "[geometry]") {
    // A tetrahedron with an edge 0 1 that one side sees as 0 4 1, joined by the flat triangle 0 4 1.
    const Mesh mesh = triangles({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                                {0, 2, 1, 0, 4, 3, 4, 1, 3, 0, 1, 4, 0, 3, 2, 1, 2, 3});
    REQUIRE(inspect(mesh).closed);
    REQUIRE(inspect(mesh).degenerate_faces == 1);
    const auto r = cleaned(mesh);
    CHECK(r.counts.degenerate_faces == 1);
    CHECK(is_sound_solid(r.mesh));
    CHECK(test::volume(r.mesh) == Approx(test::volume(mesh)));
}

TEST_CASE("clean takes repeated corners out of polygons", "[geometry]") {
    Mesh mesh = shapes::quad_cube();
    mesh.corners.insert(mesh.corners.begin() + 1, mesh.corners[0]);
    for (std::size_t f = 1; f < mesh.face_offsets.size(); ++f) ++mesh.face_offsets[f];
    const auto r = cleaned(mesh);
    CHECK(r.counts.repeated_corners == 1);
    CHECK(r.mesh.corners == shapes::quad_cube().corners);
}

TEST_CASE("clean keeps one of equal faces", "[geometry]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.corners.insert(mesh.corners.end(), {mesh.corners[1], mesh.corners[2], mesh.corners[0]});
    const auto r = cleaned(mesh);
    CHECK(r.counts.duplicate_faces == 1);
    CHECK(r.mesh.corners == shapes::tetrahedron().corners);
}

TEST_CASE("faces that a morph target moves apart are no duplicates", "[geometry]") {
    Mesh m;
    m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    m.wedge_vertex = {0, 1, 2, 0, 1, 2, 0, 1, 2};
    m.corners = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<float> moves(27, 0);
    for (std::size_t i = 9; i < 27; ++i) moves[i] = 2; // of the second and the third face
    m.attributes.push_back({"morph0_POSITION", Domain::wedge, Role::morph_vector, 3, false, moves});
    CHECK(cleaned(m).mesh.face_count() == 2);
}

TEST_CASE("clean removes a wall between two solids", "[geometry]") {
    // Two tetrahedra on the two sides of the triangle 0 1 2.
    const Mesh mesh = triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                                {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 1, 2, 1, 0, 4, 2, 1, 4, 0, 2, 4});
    REQUIRE(inspect(mesh).closed);
    const auto r = cleaned(mesh);
    CHECK(r.counts.duplicate_faces == 2);
    CHECK(is_sound_solid(r.mesh));
    CHECK(inspect(r.mesh).components == 1);
}

TEST_CASE("clean keeps one side of a doubled sheet", "[geometry]") {
    Mesh sheet = shapes::grid(3, 2);
    const auto corners = sheet.corners;
    for (std::size_t c = 0; c < corners.size(); c += 3)
        sheet.corners.insert(sheet.corners.end(), {corners[c + 2], corners[c + 1], corners[c]});
    const auto r = cleaned(sheet);
    CHECK(r.counts.duplicate_faces == 12);
    CHECK(r.mesh.corners == corners);
    CleanSettings both;
    both.walls = both.non_manifold = false;
    CHECK(cleaned(sheet, both).mesh.corners == sheet.corners);
}

TEST_CASE("clean keeps both sides of a fin where they are seen, once each", "[geometry]") {
    // A triangle seen from both sides, which is attached to another, and the front of it once more.
    const Mesh fin =
        triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {0, 1, 2, 0, 2, 1, 1, 0, 3, 1, 2, 0});
    CHECK(cleaned(fin).mesh.face_count() == 2); // the back is a duplicate of the front
    CleanSettings s;
    s.walls = s.non_manifold = false;
    const auto r = cleaned(fin, s);
    CHECK(r.counts.duplicate_faces == 1);
    CHECK(r.mesh.corners == std::vector<Index>{0, 1, 2, 0, 2, 1, 1, 0, 3});
}

TEST_CASE("clean splits a vertex of two fans", "[geometry]") {
    const auto r = cleaned(shapes::hourglass());
    CHECK(r.counts.split_vertices == 1);
    CHECK(is_sound_solid(r.mesh));
    CHECK(inspect(r.mesh).components == 2);
}

TEST_CASE("clean splits an edge between two solids, each whole", "[geometry]") {
    Mesh mesh = two_cubes({1, 1, 0});
    weld_exact(mesh);
    REQUIRE_FALSE(inspect(mesh).edge_manifold);
    const auto r = cleaned(mesh);
    CHECK(r.counts.split_vertices == 2);
    CHECK(is_sound_solid(r.mesh));
    CHECK(inspect(r.mesh).components == 2);
    CHECK(test::volume(r.mesh) == Approx(2));
}

TEST_CASE("clean splits an edge of three faces", "[geometry]") {
    const auto r = cleaned(shapes::fan3());
    CHECK(inspect(r.mesh).edge_manifold);
    CHECK(r.mesh.face_count() == 3);
}

TEST_CASE("clean puts a point on an edge that its ends hold together", "[geometry]") {
    // A ring of four cubes whose hole has shrunk to an edge. Both ends of the edge lie inside the surface of
    // a slab.
    Mesh mesh;
    const auto cube_at = [&](double x, double y, double z) {
        Mesh cube = shapes::cube();
        for (Vec3& p : cube.positions) p += Vec3{x, y, z};
        append(mesh, cube);
    };
    cube_at(0, 0, 1);
    cube_at(1, 1, 1);
    for (double z : {0.0, 2.0})
        for (double x : {0.0, 1.0})
            for (double y : {0.0, 1.0}) cube_at(x, y, z);
    weld_exact(mesh);
    const auto r = cleaned(mesh);
    CHECK(r.counts.split_edges == 1);
    CHECK(is_sound_solid(r.mesh));
    CHECK(test::volume(r.mesh) == Approx(10));
}

TEST_CASE("clean resolves T-vertices", "[geometry]") {
    // A square whose upper half has the middle of the lower side's edge as a vertex.
    const Mesh mesh =
        triangles({{0, 0, 0}, {2, 0, 0}, {0, -2, 0}, {0, 2, 0}, {1, 0, 0}}, {0, 2, 1, 0, 4, 3, 4, 1, 3});
    const auto r = cleaned(mesh);
    CHECK(r.counts.t_junctions == 1);
    CHECK(r.mesh.face_count() == 4);
    CHECK(inspect(r.mesh).boundary_edges == 4);
    CHECK(inspect(r.mesh).boundary_loops == 1);
}

TEST_CASE("clean resolves T-vertices beside the edge when they are near", "[geometry]") {
    const Mesh mesh =
        triangles({{0, 0, 0}, {2, 0, 0}, {0, -2, 0}, {0, 2, 0}, {1, 1e-4, 0}}, {0, 2, 1, 0, 4, 3, 4, 1, 3});
    CleanSettings s = nothing();
    s.t_junctions = Nearness::exact;
    CHECK(cleaned(mesh, s).counts.total() == 0);
    s.t_junctions = Nearness::near;
    s.tolerance = 1e-3;
    CHECK(inspect(cleaned(mesh, s).mesh).boundary_edges == 4);
}

TEST_CASE("clean fills holes", "[geometry]") {
    const Mesh sphere = shapes::icosphere(2);
    for (const HoleFill method : {HoleFill::minimal, HoleFill::smooth}) {
        CleanSettings s;
        s.holes = HoleSettings{method, 0, 0};
        Mesh holed = sphere; // the faces around a vertex go
        for (Index f = sphere.face_count(); f-- > 0;)
            for (Index c = 3 * f; c < 3 * f + 3; ++c)
                if (sphere.corners[c] == 20) holed = without_face(holed, f);
        const auto r = cleaned(holed, s);
        CHECK(r.counts.filled_holes == 1);
        CHECK(is_sound_solid(r.mesh));
        CHECK(inspect(r.mesh).euler == 2);
        CHECK(test::volume(r.mesh) == Approx(test::volume(sphere)).epsilon(0.02));
    }
}

TEST_CASE("clean fills planar holes with planar patches, and says which are not", "[geometry]") {
    CleanSettings s;
    s.holes = HoleSettings{HoleFill::planar, 0, 0};
    Mesh open = shapes::quad_cube();
    open.face_offsets.pop_back();
    open.corners.resize(20);
    auto r = cleaned(open, s);
    CHECK(is_sound_solid(r.mesh));
    CHECK(test::volume(r.mesh) == Approx(1));
    open.positions[open.corners[0]].z += 0.3;
    open.positions[open.corners[2]].x -= 0.3;
    r = cleaned(open, s);
    CHECK(r.counts.filled_holes == 0);
    REQUIRE(r.not_done.size() == 1);
    CHECK(r.not_done[0].step == "holes");
    CHECK(r.not_done[0].why.starts_with("its boundary loop is not planar: it deviates by "));
}

TEST_CASE("clean fills holes that are planar but for the rounding of their file", "[geometry]") {
    CleanSettings s;
    s.holes = HoleSettings{HoleFill::planar, 0, 0};
    Mesh open = shapes::open_cone(24);
    for (Vec3& p : open.positions) { // on a slant, away from the origin, as 32 bits hold it
        p = Vec3{0.8 * p.x - 0.6 * p.z, p.y, 0.6 * p.x + 0.8 * p.z} + Vec3{21, -7, 3};
        for (std::size_t i = 0; i < 3; ++i) p[i] = static_cast<float>(p[i]);
    }
    auto r = cleaned(open, s);
    CHECK(r.counts.filled_holes == 1);
    CHECK(is_sound_solid(r.mesh));
    open.positions[1] = open.positions[1] + Vec3{0, 0, 1e-4};
    open.positions[9] = open.positions[9] - Vec3{0, 0, 1e-4};
    CHECK(cleaned(open, s).counts.filled_holes == 0);
}

TEST_CASE("clean fills only the holes that are small enough", "[geometry]") {
    Mesh open = without_face(shapes::icosphere(1), 0);
    append(open, shapes::open_cone(8));
    CleanSettings s;
    s.holes = HoleSettings{HoleFill::minimal, 5, 0};
    const auto r = cleaned(open, s);
    CHECK(r.counts.filled_holes == 1);
    CHECK(inspect(r.mesh).boundary_loops == 1);
    CHECK(r.not_done.at(0).why == "its boundary loop has 8 edges, more than 5");
}

TEST_CASE("clean does not fill the outline of one face, nor a Moebius strip's edge", "[geometry]") {
    CleanSettings s;
    s.holes = HoleSettings{};
    auto r = cleaned(triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}), s);
    CHECK(r.not_done.at(0).why == "it is the boundary of a single face");
    CHECK(r.mesh.face_count() == 1);
    r = cleaned(shapes::moebius(9), s);
    CHECK(r.counts.total() == 0);
    CHECK(r.not_done.at(0).why == "neighbouring faces are oriented inconsistently, or the edge has more than "
                                  "two faces: use orient first");
}

TEST_CASE("clean removes small components by faces, size, area or rank", "[geometry]") {
    const Mesh mesh = two_cubes({5, 0, 0}, 0.1);
    Mesh big = mesh;
    append(big, shapes::icosphere(2));
    const auto left = [&](const ComponentSettings& components) {
        CleanSettings s;
        s.components = components;
        return inspect(cleaned(big, s).mesh).components;
    };
    CHECK(left({20, 0, 0, 0}) == 1);
    CHECK(left({0, 1, 0, 0}) == 2);
    CHECK(left({0, 0, 0.4, 0}) == 1);
    CHECK(left({0, 0, 0, 2}) == 2);
    CHECK(left({0, 0, 0, 0}) == 3);
}

TEST_CASE("clean takes a fin off a solid, whichever way it points", "[geometry]") {
    CleanSettings s;
    s.open_components = true;
    const Mesh cube = shapes::cube();
    const Vec3 a = cube.point(0), b = cube.point(1), middle = cube.bounds().centre();
    for (const double outward : {-0.5, 0.5, 3.0})
        for (const bool turned : {false, true}) {
            Mesh mesh = cube;
            const Vec3 tip = mix(a, b, 0.5) + (mix(a, b, 0.5) - middle) * outward;
            append(mesh, triangles({turned ? b : a, turned ? a : b, tip}, {0, 1, 2}));
            const auto r = cleaned(mesh, s);
            INFO(outward << " " << turned);
            CHECK(is_sound_solid(r.mesh));
            CHECK(test::volume(r.mesh) == Approx(test::volume(cube)));
            CHECK(r.counts.open_components == 1);
            CHECK(r.counts.open_component_faces == 1);
        }
}

TEST_CASE("clean keeps open components where no closed one is left", "[geometry]") {
    CleanSettings s;
    s.open_components = true;
    const auto r = cleaned(without_face(shapes::cube(), 0), s);
    CHECK(r.mesh.face_count() == 11);
    CHECK(r.counts.open_components == 0);
}

TEST_CASE("clean rounds to single precision what is finite there", "[geometry]") {
    CleanSettings s = nothing();
    s.single = true;
    const auto r = cleaned(triangles({{0.1, 0.5, 1e300}, {1, 2, 3}, {0, 0, 1}}, {0, 1, 2}), s);
    CHECK(r.mesh.positions[0] == Vec3{0.1, 0.5, 1e300});
    CHECK(r.counts.rounded_vertices == 0);
    const auto near = cleaned(triangles({{0.1, 0.5, 0}, {1, 2, 3}, {0, 0, 1}}, {0, 1, 2}), s);
    CHECK(near.mesh.positions[0] == Vec3{0.100000001490116119384765625, 0.5, 0}); // the float nearest to 0.1
    CHECK(near.counts.rounded_vertices == 1);
}

TEST_CASE("clean removes isolated vertices", "[geometry]") {
    Mesh mesh = shapes::cube();
    mesh.positions.push_back({7, 7, 7});
    CHECK(cleaned(mesh).counts.isolated_vertices == 1);
    CHECK(cleaned(mesh).mesh.vertex_count() == 8);
}

TEST_CASE("clean takes an empty mesh, and leaves a cloud of points its points", "[geometry]") {
    CleanSettings s;
    s.holes = HoleSettings{};
    s.components = ComponentSettings{2, 0, 0, 0};
    s.inner_components = true;
    s.self_intersections = Untangle::all;
    s.weld = s.stitch = s.t_junctions = Nearness::near;
    s.tolerance = 1;
    CHECK(cleaned({}, s).counts.total() == 0);
    Mesh points;
    points.positions = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    CHECK(cleaned(points, s).mesh.vertex_count() == 2);
    CHECK(cleaned(points, s).counts.isolated_vertices == 0);
    points.corners = {0, 1, 2}; // a face, though one without area, makes a surface
    CHECK(cleaned(points, s).mesh.vertex_count() == 0);
}

TEST_CASE("clean drops closed components inside others, and keeps those that touch or stand beside",
          "[geometry]") {
    Mesh mesh = shapes::icosphere(2);
    const auto add = [&](double scale, const Vec3& offset) {
        Mesh other = shapes::icosphere(1);
        for (Vec3& p : other.positions) p = p * scale + offset;
        append(mesh, other);
    };
    add(0.3, {0.2, 0, 0});
    add(0.3, {3, 0, 0});
    add(0.3, {0.9, 0, 0});
    CleanSettings s;
    s.inner_components = true;
    const auto r = cleaned(mesh, s);
    CHECK(r.counts.inner_components == 1);
    CHECK(r.counts.inner_component_faces == 80);
    CHECK(inspect(r.mesh).components == 3);
}

TEST_CASE("clean replaces faces that intersect", "[geometry]") {
    Mesh mesh = shapes::icosphere(3); // one vertex pushed through the far side
    mesh.positions[0] *= -1.5;
    REQUIRE(inspect(mesh, {.self_intersections = true}).self_intersections.value() > 0);
    CleanSettings s;
    s.self_intersections = Untangle::local;
    const auto r = cleaned(mesh, s);
    CHECK(r.counts.intersecting_faces > 0);
    CHECK(is_sound_solid(r.mesh));
    CHECK(inspect(r.mesh, {.self_intersections = true}).self_intersections.value() == 0);
}

TEST_CASE("clean leaves intersections that it cannot end, and says so", "[geometry]") {
    const Mesh mesh = shapes::crossing();
    CleanSettings s;
    s.self_intersections = Untangle::local;
    s.isolated = false;
    const auto r = cleaned(mesh, s);
    if (r.counts.intersecting_faces == 0) CHECK(r.not_done.at(0).step == "self_intersections");
}

TEST_CASE("the end of a flat sheet is no hole", "[geometry]") {
    CleanSettings s;
    s.holes = HoleSettings{};
    s.self_intersections = Untangle::all;
    for (const HoleFill method : {HoleFill::minimal, HoleFill::smooth, HoleFill::planar})
        for (const double tilt : {0.0, 0.3}) {
            s.holes->method = method;
            Mesh sheet = shapes::grid(6, 4);
            for (Vec3& p : sheet.positions) p.z = tilt * p.x; // with rounding, not quite flat
            const double area = test::area(sheet);
            CleanResult r = clean(sheet, s);
            CHECK(test::area(r.mesh) == area);
            CHECK(r.counts.filled_holes == 0);
            REQUIRE(r.not_done.size() == 1);
            CHECK(r.not_done[0].step == "holes");
            // With a hole: that is filled, the sheet ends where it ended.
            Mesh frame = sheet;
            frame.corners.erase(frame.corners.begin() + 6 * 8, frame.corners.begin() + 6 * 9);
            r = clean(frame, s);
            CHECK(r.counts.filled_holes == 1);
            CHECK(test::area(r.mesh) == Approx(area));
            CHECK(boundary_edges(r.mesh).size() == 20);
        }
    // Holes that are not flat are closed as before, even between flat walls.
    Mesh box = shapes::cube();
    box.corners.resize(box.corners.size() - 6);
    s.holes->method = HoleFill::minimal;
    const CleanResult r = clean(box, s);
    CHECK(r.counts.filled_holes == 1);
    CHECK(inspect(r.mesh).closed);
    CHECK(std::abs(test::volume(r.mesh)) == Approx(1));
}
