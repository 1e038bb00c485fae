// Tests crumpling that avoids intersections, and correlated noise.
#include "base/math/numbers.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/generate/generate.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "oracle/cgal_oracle.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

#include <algorithm>
#include <numeric>

using namespace facetmill;

namespace {

CrumpleSettings by(double amplitude, std::uint64_t seed = 1) {
    CrumpleSettings s;
    s.amplitude = amplitude;
    s.seed = seed;
    return s;
}

Mesh apart(Mesh mesh, const CrumpleSettings& s, AvoidResult* result = nullptr, bool only_look = false) {
    std::vector<CrumpleSheet> sheets{{&mesh, crumple_moves(mesh, s)}};
    const AvoidResult r = avoid_intersections(sheets, only_look);
    if (result) *result = r;
    return mesh;
}

Mesh sponge() {
    GenerateSettings s;
    s.shape = Shape::menger;
    s.subdivisions = 2;
    s.size = 1;
    return generate(s);
}

} // namespace

TEST_CASE("a crumpled sponge has no faces that meet, in float32 too", "[geometry]") {
    const Mesh mesh = sponge();
    const CrumpleSettings s = by(0.04);
    REQUIRE(find_self_intersections(crumple(mesh, s).mesh).count > 100);
    AvoidResult r;
    const Mesh after = apart(mesh, s, &r);
    CHECK(broken_invariants(after).empty());
    CHECK(after.corners == mesh.corners);
    CHECK(r.found > 100);
    CHECK(r.exempt == 0);
    CHECK(std::accumulate(r.shares.begin(), r.shares.end(), std::size_t{0}) == mesh.vertex_count());
    for (const Vec3& p : after.positions)
        for (std::size_t i = 0; i < 3; ++i) CHECK(p[i] == as_float32(p[i]));
    CHECK(oracle::self_intersections(after).empty());
    CHECK(test::count(after).flat == 0);
}

TEST_CASE("a crumpled sponge of level 3 has no faces that meet", "[geometry]") {
    GenerateSettings s;
    s.shape = Shape::menger;
    s.subdivisions = 3;
    s.size = 1;
    AvoidResult r;
    const Mesh after = apart(generate(s), by(0.015), &r);
    CHECK(r.found > 1000);
    CHECK(oracle::self_intersections(after).empty());
    CHECK(test::count(after).flat == 0);
    CHECK(test::count(after).unbalanced == 0);
}

TEST_CASE("however few pairs are listed, the same comes out", "[geometry]") {
    Mesh mesh = sponge(), listed = mesh;
    std::vector<CrumpleSheet> sheets{{&mesh, crumple_moves(mesh, by(0.04))}};
    std::vector<CrumpleSheet> with_list{{&listed, sheets[0].moves}};
    const AvoidResult r = avoid_intersections(sheets, false, 7), all = avoid_intersections(with_list);
    CHECK(r.found == all.found);
    CHECK(r.rounds == all.rounds);
    CHECK(r.shares == all.shares);
    CHECK(mesh.positions == listed.positions);
    CHECK(oracle::self_intersections(mesh).empty());
    // New pairs are still found if pairs that met before fill the list.
    Mesh crossing = grid_split(shapes::crossing(), 3).mesh;
    const std::size_t before = find_self_intersections(crossing).count;
    std::vector<CrumpleSheet> crossed{{&crossing, crumple_moves(crossing, by(0.4))}};
    avoid_intersections(crossed, false, before);
    CHECK(find_self_intersections(crossing).count <= before);
    Mesh again = grid_split(shapes::crossing(), 3).mesh;
    std::vector<CrumpleSheet> refused{{&again, crumple_moves(again, by(0.4))}};
    CHECK(test::failure([&] {
              avoid_intersections(refused, false, before - 1);
          }).starts_with("limit [E-LIMIT] crumple: "));
}

TEST_CASE("places that have no trouble move all the way", "[geometry]") {
    const Mesh mesh = grid_split(shapes::cube(), 4).mesh;
    const CrumpleSettings s = by(0.001);
    AvoidResult r;
    const Mesh after = apart(mesh, s, &r), free = crumple(mesh, s).mesh;
    CHECK(r.found == 0);
    CHECK(r.rounds == 0);
    CHECK(r.shares[0] == mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        CHECK(length(after.positions[v] - free.positions[v]) < 1e-7);
}

TEST_CASE("a flat sheet does not fold over itself", "[geometry]") {
    Mesh mesh = shapes::grid(12, 12);
    std::vector<CrumpleSheet> sheets{{&mesh, crumple_moves(mesh, by(0.6))}};
    for (auto& m : sheets[0].moves.moves) m.z = 0; // in its own plane
    const AvoidResult r = avoid_intersections(sheets);
    CHECK(r.found > 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 n =
            cross(mesh.point(3 * f + 1) - mesh.point(3 * f), mesh.point(3 * f + 2) - mesh.point(3 * f));
        CHECK(n.z > 0);
    }
}

TEST_CASE("pairs that met before are exempt, however large the moves", "[geometry]") {
    Mesh mesh = grid_split(shapes::crossing(), 3).mesh;
    const std::size_t before = find_self_intersections(mesh).count;
    REQUIRE(before > 0);
    AvoidResult r;
    const Mesh after = apart(mesh, by(100), &r);
    CHECK(r.exempt == before);
    const auto all = [](const Mesh& m) { return find_self_intersections(m, {.limit = 100000}).pairs; };
    const auto old = all(mesh);
    for (const auto& pair : all(after)) CHECK(std::find(old.begin(), old.end(), pair) != old.end());
    CHECK(broken_invariants(after).empty());
}

TEST_CASE("unwelded copies of a vertex stay together and count as one", "[geometry]") {
    const Mesh whole = grid_split(shapes::cube(), 3).mesh;
    Mesh loose;
    for (Index c = static_cast<Index>(whole.corner_count()); c-- > 0;) {
        loose.corners.push_back(static_cast<Index>(loose.positions.size()));
        loose.positions.push_back(whole.point(c));
    }
    std::reverse(loose.positions.begin(), loose.positions.end());
    AvoidResult a, b;
    const Mesh one = apart(whole, by(0.2), &a), two = apart(loose, by(0.2), &b);
    CHECK(a.found > 0);
    CHECK(a.found == b.found);
    CHECK(a.rounds == b.rounds);
    for (Index c = 0; c < whole.corner_count(); ++c) CHECK(one.point(c) == two.positions[c]);
}

TEST_CASE("places that sheets share keep their share in all of them", "[geometry]") {
    Mesh a = grid_split(shapes::cube(), 4).mesh, b = shapes::cube();
    for (auto& p : b.positions) p.x += 1;
    b = grid_split(b, 4).mesh;
    const std::vector<Vec3> start_a = a.positions, start_b = b.positions;
    const CrumpleSettings s = by(0.15);
    std::vector<CrumpleSheet> sheets{{&a, crumple_moves(a, s)}, {&b, crumple_moves(b, s)}};
    CHECK(avoid_intersections(sheets).rounds > 0);
    int met = 0;
    for (std::size_t i = 0; i < start_a.size(); ++i)
        for (std::size_t j = 0; j < start_b.size(); ++j)
            if (start_a[i] == start_b[j]) {
                ++met;
                CHECK(a.positions[i] == b.positions[j]);
            }
    CHECK(met == 25);
}

TEST_CASE("sheets that are opened again for each round come out the same, whatever they are beside",
          "[geometry]") {
    std::vector<Mesh> alone, kept, opened;
    std::vector<CrumpleSheet> of_kept, of_opened;
    for (int i = 0; i < 4; ++i) { // all are alike except the second, and they move differently
        Mesh mesh = sponge();
        if (i == 1) mesh.positions[0].x += 1e-3;
        kept.push_back(mesh);
        opened.push_back(mesh);
    }
    std::size_t found = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        CrumpleSettings s = by(0.04);
        s.to_world.m[0][3] = 3 * static_cast<double>(i);
        AvoidResult r;
        alone.push_back(apart(kept[i], s, &r));
        found += r.found;
        of_kept.push_back({&kept[i], crumple_moves(kept[i], s)});
        of_opened.push_back({&opened[i], crumple_moves(opened[i], s)});
    }
    const AvoidResult of_all = avoid_intersections(of_kept);
    const AvoidResult again = avoid_intersections(of_opened, false, std::size_t{8} << 20, 0);
    CHECK(of_all.found == found);
    CHECK(again.found == found);
    CHECK(again.rounds == of_all.rounds);
    CHECK(again.box_pairs == of_all.box_pairs);
    CHECK(again.shares == of_all.shares);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        CHECK(kept[i].positions == alone[i].positions);
        CHECK(opened[i].positions == alone[i].positions);
    }
    CHECK(alone[0].positions != alone[2].positions);
}

TEST_CASE("sheets beside one with too many pairs to look at are kept apart too", "[geometry]") {
    for (const std::size_t tangled : {0U, 1U}) {
        std::vector<Mesh> meshes{sponge(), sponge()};
        const std::vector<Mesh> before = meshes;
        std::vector<CrumpleSheet> sheets;
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            CrumpleSettings s = by(i == tangled ? 0.4 : 0.02);
            s.to_world.m[0][3] = 3 * static_cast<double>(i);
            sheets.push_back({&meshes[i], crumple_moves(meshes[i], s)});
        }
        const AvoidResult r = avoid_intersections(sheets);
        CHECK(r.coarse > 0);
        for (std::size_t i = 0; i < meshes.size(); ++i) {
            CHECK(meshes[i].positions != before[i].positions);
            CHECK(find_self_intersections(meshes[i]).count == 0);
        }
    }
}

TEST_CASE("two large sheets are searched at the same time: the first stays open", "[geometry]") {
    constexpr double large = 2.5 * static_cast<double>(max_open_triangles), all = 2 * large;
    CHECK(avoid_intersections_memory(all, large) == avoid_intersections_memory(all, all));
    CHECK(avoid_intersections_memory(all, large / 100) < avoid_intersections_memory(all, all));
}

TEST_CASE("only looking lowers nothing and says how many pairs there are", "[geometry]") {
    AvoidResult r;
    apart(sponge(), by(0.04), &r, true);
    CHECK(r.left == r.found);
    CHECK(r.left > 100);
    CHECK(r.rounds == 0);
}

TEST_CASE("moves far larger than the faces are cut down before faces are looked for", "[geometry]") {
    AvoidResult r;
    const Mesh mesh = sponge(), after = apart(mesh, by(20), &r);
    CHECK(r.rounds <= 40);
    CHECK(r.found == mesh.face_count());
    CHECK(r.shares[0] == 0);
    CHECK(oracle::self_intersections(after).empty());
    CHECK(test::count(after).flat == 0);
    AvoidResult looked;
    apart(mesh, by(20), &looked, true);
    CHECK(looked.at_least);
    CHECK(looked.left > 0);
    CHECK(looked.left < 64 * mesh.face_count());
}

TEST_CASE("on a terrain with crossings the work is bounded, and no faces come to meet", "[geometry]") {
    const Mesh terrain = grid_split(crumple(shapes::grid(30, 30), by(0.45, 5)).mesh, 3).mesh;
    const auto pairs = [](const Mesh& m) { return find_self_intersections(m, {.limit = 1'000'000}).pairs; };
    const auto before = pairs(terrain);
    REQUIRE(before.size() > 1000);
    for (const double amplitude : {0.5, 2.5}) {
        AvoidResult r;
        const Mesh after = apart(terrain, by(amplitude, 3), &r);
        CHECK(r.exempt >= before.size()); // in float32
        CHECK(r.coarse > 0);
        CHECK(r.box_pairs < 500 * terrain.face_count());
        CHECK(r.shares[0] < terrain.vertex_count());
        const auto old = pairs(apart(terrain, by(0))); // rounded to float32
        for (const auto& pair : pairs(after)) REQUIRE(std::binary_search(old.begin(), old.end(), pair));
        CHECK(test::count(after).flat == 0);
    }
    AvoidResult calm;
    apart(sponge(), by(0.01), &calm);
    CHECK(calm.coarse == 0);
}

TEST_CASE("moves of many edges end after little work, whatever the number of faces", "[geometry]") {
    for (const int n : {40, 80}) {
        const Mesh sheet = shapes::grid(n, n);
        AvoidResult r;
        const Mesh after = apart(sheet, by(12), &r);
        CHECK(r.box_pairs < 50 * sheet.face_count());
        CHECK(r.shares.back() < sheet.vertex_count() / 2); // it is crumpled anyway
        CHECK(find_self_intersections(after).count == 0);
        CHECK(test::count(after).flat == 0);
    }
}

TEST_CASE("where most faces would meet, a sample tells before all are looked at", "[geometry]") {
    const Mesh sheet = shapes::grid(200, 200);
    AvoidResult r;
    const Mesh after = apart(sheet, by(12), &r);
    CHECK(r.coarse > 0);
    CHECK(r.found > sheet.face_count() / 2);
    CHECK(r.box_pairs < 16 * sheet.face_count());
    CHECK(r.shares.back() < sheet.vertex_count() / 100);
    CHECK(find_self_intersections(after).count == 0);
    AvoidResult calm;
    apart(sheet, by(0.04), &calm);
    CHECK(calm.coarse == 0);
}

TEST_CASE("faces that lie close are looked at, however many they are", "[geometry]") {
    Mesh layers; // every box meets the boxes of the next sheets
    for (int i = 0; i < 40; ++i) {
        Mesh sheet = shapes::grid(4, 4);
        for (Vec3& p : sheet.positions) p = {p.x, p.y, p.x / 2 + i * 1e-3};
        const auto first = static_cast<Index>(layers.positions.size());
        layers.positions.insert(layers.positions.end(), sheet.positions.begin(), sheet.positions.end());
        for (Index f = 0; f < sheet.face_count(); ++f) {
            std::vector<Index> corners;
            for (const Index v : sheet.face_wedges(f)) corners.push_back(first + v);
            add_face(layers, corners);
        }
    }
    AvoidResult r;
    const Mesh after = apart(layers, by(0.05), &r);
    CHECK(find_self_intersections(after).count == 0);
}

TEST_CASE("faces at short edges may be drawn out, as long as they do not meet", "[geometry]") {
    // A short edge among long edges, and a smooth move many times as long.
    Mesh mesh = shapes::grid(4, 4);
    mesh.positions[12].x = mesh.positions[11].x + 1e-3;
    std::vector<CrumpleSheet> sheets{{&mesh, crumple_moves(mesh, by(0.01))}};
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        sheets[0].moves.moves[v] = {0, 0, mesh.positions[v].x > mesh.positions[11].x ? 0.5 : 0.0};
    CHECK(avoid_intersections(sheets).shares[0] == mesh.vertex_count());
}

TEST_CASE("keeping apart gives the same for any number of threads", "[geometry]") {
    const Mesh mesh = sponge();
    CHECK(test::same_for_any_threads([&] { return apart(mesh, by(0.04)); }));
}

TEST_CASE("split points of unwelded copies of an edge are the same to the last bit", "[geometry]") {
    Mesh mesh;
    mesh.positions = {{0.1, 0.7, 0.3}, {0.9, 0.2, 0.6}, {0, 0, 0},
                      {0.9, 0.2, 0.6}, {0.1, 0.7, 0.3}, {1, 1, 1}};
    mesh.corners = {0, 1, 2, 3, 4, 5};
    const Mesh finer = grid_split(mesh, 7).mesh;
    std::size_t copies = 0;
    for (std::size_t i = 6; i < finer.vertex_count(); ++i)
        for (std::size_t j = i + 1; j < finer.vertex_count(); ++j)
            copies += finer.positions[i] == finer.positions[j];
    CHECK(copies == 6);
}

TEST_CASE("correlated noise: deviation 1 everywhere, near places alike, far ones not", "[geometry]") {
    CorrelatedNoise noise;
    double sum = 0, squares = 0, near = 0, far = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const Vec3 p{i * 0.617, i * 0.331 - 50, i * 0.173};
        const double a = noise.at(3, p);
        sum += a;
        squares += a * a;
        near += a * noise.at(3, p + Vec3{0.02, 0.01, -0.01});
        far += a * noise.at(3, p + Vec3{5.5, 0, 0});
    }
    CHECK(std::abs(sum / n) < 0.05);
    CHECK(std::sqrt(squares / n) == Approx(0.987).epsilon(0.05));
    CHECK(near / n > 0.9);
    CHECK(std::abs(far / n) < 0.05);
    CHECK(noise.at(3, {0.5, 0, -0.0}) == noise.at(3, {0.5, -0.0, 0}));
    CHECK(noise.at(3, {0.5, 0, 0}) != noise.at(4, {0.5, 0, 0}));
    CHECK(std::abs(noise.at(3, {1e300, -1e300, 1e30})) <= 3);
    noise.octaves = 8;
    CHECK(std::abs(noise.at(3, {0.3, 0.4, 0.5}) - noise.at(3, {0.302, 0.4, 0.5})) > 1e-4);
}

TEST_CASE("crumpling with a frequency bends the sheet, vertices side by side move alike", "[geometry]") {
    const Mesh mesh = grid_split(shapes::grid(1, 1), 40).mesh;
    CrumpleSettings s = by(0.1);
    s.direction = CrumpleSettings::Direction::normal;
    s.frequency = 3;
    const auto step = [&](const Mesh& m) {
        double most = 0;
        for (Index c = 0; c < m.corner_count(); c += 3)
            most = std::max(most, std::abs(m.point(c).z - m.point(c + 1).z));
        return most;
    };
    const Mesh smooth = crumple(mesh, s).mesh;
    CHECK(smooth.bounds().extent().z > 0.1);
    CHECK(step(smooth) < 0.1);
    s.frequency = 0;
    CHECK(step(crumple(mesh, s).mesh) > 0.3);
}

TEST_CASE("crumpling by a mask moves what it says", "[geometry]") {
    const Mesh mesh = shapes::grid(3, 3);
    CrumpleSettings s = by(0.1);
    const Mesh all = crumple(mesh, s).mesh;
    s.mask.assign(16, 0);
    s.mask[5] = 0.5;
    const CrumpleResult r = crumple(mesh, s);
    CHECK(r.moved == 1);
    CHECK(length(r.mesh.positions[5] - mesh.positions[5]) ==
          Approx(length(all.positions[5] - mesh.positions[5]) / 2));
}
