#include "cells/process/clean_cells.hpp"

#include "geometry/edit/moved.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/split/split.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"
#include "support/catch.hpp"
#include "support/cells.hpp"
#include "support/failure.hpp"

#include <cmath>
#include <string>

using namespace facetmill;
using namespace facetmill::cells;

namespace {

/// Compares clean in cells with clean in memory. The returned counts show whether the test is meaningful.
CleanCounts check_clean(const Mesh& mesh, std::uint64_t most, const CleanSettings& settings = {}) {
    const test::TemporaryDirectory folder;
    const CellResources means{folder.path(), test::cell_memory};
    auto partition = test::cells_of(folder, mesh, most);
    Transform stretch;
    stretch.m[2][2] = 3;
    const CleanedCells cleaned = clean_cells(partition, settings, means, stretch, most);
    const CleanResult &found = cleaned.result, whole = clean(mesh, settings);
    CHECK(cleaned.area_before == Approx(surface_size(mesh, stretch).area).epsilon(1e-12));
    CHECK(cleaned.area_after == Approx(surface_size(whole.mesh, stretch).area).epsilon(1e-12));
    CHECK(found.counts == whole.counts);
    CHECK(found.not_done == whole.not_done);
    CHECK(found.changes == whole.changes);
    CHECK(partition->faces() == whole.mesh.face_count());
    CHECK(partition->vertices() == whole.mesh.vertex_count());
    const Mesh all = test::rejoined(*partition);
    CHECK(all.vertex_count() == whole.mesh.vertex_count());
    CHECK(test::triangles_of(all) == test::triangles_of(whole.mesh));
    const Connectivity a = connectivity_of(all), b = connectivity_of(whole.mesh);
    CHECK(a.edges == b.edges);
    CHECK(a.boundary_edges == b.boundary_edges);
    CHECK(a.boundary_loops == b.boundary_loops);
    CHECK(a.crowded_edges == b.crowded_edges);
    CHECK(a.non_manifold_vertices == b.non_manifold_vertices);
    CHECK(component_count(all) == component_count(whole.mesh));
    const Box box = partition->source().contents().bounds;
    CHECK(box.min == whole.mesh.bounds().min);
    CHECK(box.max == whole.mesh.bounds().max);
    return whole.counts;
}

/// Positions whose midpoints are exact.
Mesh on_a_lattice(Mesh mesh) {
    for (Vec3& p : mesh.positions)
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 0x1p20) * 0x1p-20;
    return mesh;
}

/// Adds a few defects to a closed surface: holes, repeated and reversed faces, faces without area, split
/// edges, separate faces and intersecting faces.
Mesh scarred(unsigned seed, unsigned rarely) {
    const Mesh whole = on_a_lattice(test::noisy_icosphere(4, 0.02, seed));
    Mesh mesh;
    mesh.positions = whole.positions;
    const auto n = static_cast<unsigned>(whole.vertex_count());
    unsigned state = seed;
    const auto random = [&](unsigned below) {
        return (state = state * 1664525 + 1013904223) / 65536 % below;
    };
    const auto copy_of = [&](Index v) {
        mesh.positions.push_back(Vec3(mesh.positions[v]));
        return static_cast<Index>(mesh.positions.size() - 1);
    };
    for (Index f = 0; f < whole.face_count(); ++f) {
        const auto face = whole.face_wedges(f);
        const Index a = face[0], b = face[1], c = face[2];
        switch (random(rarely)) {
        case 0:
            break;
        case 1:
            add_face(mesh, std::array{a, b, c});
            add_face(mesh, std::array{b, c, a});
            break;
        case 2:
            add_face(mesh, std::array{a, b, c});
            add_face(mesh, std::array{a, c, b});
            break;
        case 3:
            add_face(mesh, std::array{a, b, b});
            break;
        case 4: {
            mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
            const auto middle = static_cast<Index>(mesh.positions.size() - 1);
            add_face(mesh, std::array{a, middle, c});
            add_face(mesh, std::array{middle, b, c});
            break;
        }
        case 5:
            add_face(mesh, std::array{copy_of(a), copy_of(b), copy_of(c)});
            break;
        case 6:
            add_face(mesh, std::array{a, b, c});
            add_face(mesh, std::array{a, b, random(n)});
            break;
        case 7:
            add_face(mesh, std::array{a, c, b});
            break;
        default:
            add_face(mesh, std::array{a, b, c});
            break;
        }
    }
    drop_unused(mesh);
    return mesh;
}

/// A cube with a wall on its top. Three faces meet at edges of sheets, far from the borders of these sheets.
Mesh cube_with_fin() {
    Mesh mesh = shapes::cube();
    for (int pass = 0; pass < 4; ++pass) mesh = split(mesh, {.method = SplitMethod::midpoint}).mesh;
    mesh.attributes.clear();
    constexpr Index n = 16;
    const auto first = static_cast<Index>(mesh.positions.size());
    for (Index z = 0; z <= n; ++z)
        for (Index y = 0; y <= n; ++y) mesh.positions.push_back({0.5, y / 16.0, 1 + z / 16.0});
    for (Index z = 0; z < n; ++z)
        for (Index y = 0; y < n; ++y) {
            const Index a = first + z * (n + 1) + y, b = a + 1, c = a + n + 1, d = c + 1;
            add_face(mesh, std::array{a, b, c});
            add_face(mesh, std::array{b, d, c});
        }
    weld_exact(mesh);
    return mesh;
}

} // namespace

TEST_CASE("cells are cleaned as the mesh is", "[cells]") {
    for (unsigned seed = 1; seed <= 12; ++seed)
        for (const unsigned rarely : {60U, 900U}) {
            CAPTURE(seed, rarely);
            CHECK(check_clean(scarred(seed, rarely), 300).total() > 0);
        }
    check_clean(test::nasty(3), 300);
    check_clean(test::nasty(4), 5000);
}

TEST_CASE("cells of sheets that meet at edges are taken apart as the mesh is", "[cells]") {
    CHECK(check_clean(cube_with_fin(), 300).split_vertices > 0);
    Mesh two = cube_with_fin();
    append(two, test::moved(shapes::cube(), {1, 1, 0})); // solids that touch at an edge
    check_clean(two, 200);
}

TEST_CASE("cells of triangles that stand alone are welded", "[cells]") {
    const Mesh sphere = test::torn_apart(on_a_lattice(test::noisy_icosphere(4, 0.02, 5)));
    const CleanCounts counts = check_clean(sphere, 400);
    CHECK(counts.welded_vertices == sphere.vertex_count() - 2562);
    check_clean(test::torn_apart(scarred(3, 300)), 300);
}

TEST_CASE("what is sound stays in cells as it is", "[cells]") {
    CHECK(check_clean(test::noisy_icosphere(3, 0.01, 7), 100).total() == 0);
    CHECK(check_clean(test::with_noise(shapes::grid(20, 20), 0.2, 5), 100).total() ==
          0); // a border is no flaw
}

TEST_CASE("steps of clean are off in cells as they are in memory", "[cells]") {
    const Mesh mesh = scarred(9, 100);
    CleanSettings off;
    off.weld = off.t_junctions = Nearness::off;
    off.degenerate = off.duplicates = off.non_manifold = off.isolated = false;
    CHECK(check_clean(mesh, 300, off).total() == 0);
    for (auto step : {&CleanSettings::degenerate, &CleanSettings::duplicates, &CleanSettings::non_manifold}) {
        CleanSettings one = off;
        one.*step = true;
        CHECK(check_clean(mesh, 300, one).total() > 0);
        one.weld = one.t_junctions = one.stitch = Nearness::exact;
        check_clean(mesh, 300, one);
        CleanSettings others;
        others.*step = false;
        check_clean(mesh, 300, others);
    }
}

TEST_CASE("clean in cells says what it cannot do", "[cells]") {
    const auto why_not = [](auto&& change) {
        CleanSettings settings;
        change(settings);
        return cells::why_not_in_cells(settings).value_or("");
    };
    CHECK(why_not([](CleanSettings&) {}).empty());
    CHECK(why_not([](CleanSettings& s) { s.stitch = Nearness::exact; }).empty());
    CHECK(why_not([](CleanSettings& s) { s.weld = Nearness::near; }).find("weld: near") == 0);
    CHECK(why_not([](CleanSettings& s) { s.holes.emplace(); }).find("holes:") == 0);
    CHECK(why_not([](CleanSettings& s) { s.components.emplace(); }).find("components:") == 0);
    CHECK(why_not([](CleanSettings& s) {
              s.self_intersections = Untangle::local;
          }).find("self_intersections") == 0);
    CHECK(why_not([](CleanSettings& s) { s.single = true; }).find("precision") == 0);
    const test::TemporaryDirectory folder;
    auto many = test::cells_of(folder, test::nasty(3), 100);
    const CellResources little{folder.path(), std::uint64_t{1} << 20};
    CHECK(test::failure([&] { clean_cells(many, {}, little, {}, 100); }).find("E-MEMORY") !=
          std::string::npos);
}
