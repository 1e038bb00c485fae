// clean's union of closed pieces that pass through each other or through themselves.
#include "oracle/cgal_oracle.hpp"
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "base/math/numbers.hpp"
#include "geometry/boolean/boolean_pass.hpp"
#include "geometry/clean/clean.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/invariants.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

using namespace facetmill;
using namespace facetmill::test;

namespace {

CleanSettings uniting() {
    CleanSettings s;
    s.self_intersections = Untangle::unite;
    return s;
}

/// From min to max.
Mesh box(const Vec3& min, const Vec3& max) {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions)
        for (std::size_t i = 0; i < 3; ++i) p[i] = min[i] + p[i] * (max[i] - min[i]);
    return mesh;
}

Mesh inside_out(Mesh mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin(f), mesh.corners.begin() + mesh.face_end(f));
    return mesh;
}

Mesh together(std::initializer_list<Mesh> all) {
    Mesh mesh;
    for (const Mesh& m : all) append(mesh, m);
    return mesh;
}

/// The union, checked to be closed and without intersections. Faces that touch at a single position do not
/// count.
Mesh united(const Mesh& mesh) {
    const auto r = clean(mesh, uniting());
    CHECK(broken_invariants(r.mesh) == std::vector<std::string>{});
    CHECK(test::closed(r.mesh));
    CHECK(test::edge_manifold(r.mesh));
    CHECK(clean_steps::crossings(r.mesh).count == 0);
    CHECK(r.not_done.empty());
    CHECK(r.counts.united_components > 0);
    CHECK(test::broken_clean_law(mesh, uniting()).empty());
    return r.mesh;
}

bool says(const std::string& text, const char* what) { return text.find(what) != std::string::npos; }

std::string refusal(const Mesh& mesh) {
    const auto r = clean(mesh, uniting());
    CHECK(test::same_mesh(r.mesh, mesh));
    CHECK(r.counts.total() == 0);
    REQUIRE(r.not_done.size() > 0);
    CHECK(r.not_done[0].step == "self_intersections");
    return r.not_done[0].why;
}

} // namespace

TEST_CASE("clean unites boxes that overlap, share faces or touch", "[geometry]") {
    struct Case {
        Vec3 min, max; ///< of the other box
        double volume, area;
        long euler;
    };
    const Case c = GENERATE(Case{{1, 1, 1}, {3, 3, 3}, 15, 42, 2},          // a corner in a corner
                            Case{{1, 0, 0}, {3, 2, 2}, 12, 32, 2},          // coplanar faces overlap
                            Case{{2, 1, 0}, {4, 3, 2}, 16, 44, 2},          // only touch with half a face
                            Case{{0.5, 0.5, 1}, {1.5, 1.5, 3}, 9, 28, 2},   // a chimney
                            Case{{0.5, 0.5, -1}, {1.5, 1.5, 3}, 10, 32, 2}, // a bar right through
                            Case{{0, 0, 0}, {1, 1, 1}, 8, 24, 2},           // inside, in a corner
                            Case{{2, 2, 1}, {4, 4, 3}, 16, 48, 4});         // half an edge
    const Mesh mesh = united(together({box({0, 0, 0}, {2, 2, 2}), box(c.min, c.max)}));
    CHECK(test::volume(mesh) == Approx(c.volume).epsilon(1e-14));
    CHECK(test::area(mesh) == Approx(c.area).epsilon(1e-14));
    CHECK(test::euler(mesh) == c.euler);
}

TEST_CASE("clean counts the edges where united solids touch, unless it separates them", "[geometry]") {
    const Mesh mesh = together({box({0, 0, 0}, {2, 2, 2}), box({2, 2, 1}, {4, 4, 3})});
    CleanSettings s = uniting();
    CHECK(clean(mesh, s).counts.touching_edges == 0);
    s.non_manifold = false;
    const auto r = clean(mesh, s);
    CHECK(r.counts.touching_edges == 1);
    CHECK(test::closed(r.mesh));
    CHECK(!test::edge_manifold(r.mesh));
    CHECK(inspect(r.mesh, {.self_intersections = true}).self_intersections == 0);
    CHECK(test::broken_clean_law(mesh, s).empty());
}

TEST_CASE("clean unites grids that overlap and meet in their edges only", "[geometry]") {
    // Voxels: every line where the two cross is an edge of both, so no faces intersect.
    const bool as_quads = GENERATE(true, false);
    const auto block = [&](const Vec3& min) { // of side 2, four squares on every side
        const Mesh cube = moved(shapes::quad_cube(), min * 0.5);
        Mesh mesh;
        for (Index f = 0; f < 6; ++f)
            for (Index k = 0; k < 4; ++k) {
                const Vec3 corner = cube.point(4 * f + k), next = cube.point(4 * f + (k + 1) % 4),
                           last = cube.point(4 * f + (k + 3) % 4);
                const auto first = static_cast<Index>(mesh.positions.size());
                for (const Vec3& p : {corner * 2.0, corner + next, next + last, last + corner})
                    mesh.positions.push_back(p);
                add_face(mesh, std::array{first, first + 1, first + 2, first + 3});
            }
        weld_exact(mesh);
        return as_quads ? mesh : triangulated(mesh);
    };
    const Mesh a = block({0, 0, 0}), mesh = together({a, block({1, 1, 1})});
    REQUIRE(test::volume(a) == 8);
    REQUIRE(a.face_count() == (as_quads ? 24 : 48));
    const Mesh result = united(mesh);
    CHECK(test::volume(result) == 15);
    CHECK(test::area(result) == 42);
    CHECK(test::euler(result) == 2);
    // Neighbours that share an edge do not overlap.
    const auto beside = clean(together({a, block({2, 2, 0})}), uniting());
    CHECK(beside.counts.united_components == 0);
    CHECK(test::volume(beside.mesh) == 16);
}

TEST_CASE("clean unites three boxes as inclusion and exclusion have it", "[geometry]") {
    const Mesh mesh = united(together({box({-1, -1, -1}, {1, 1, 1}), box({0, 0, 0}, {2, 2, 2}),
                                       box({-0.5, -0.5, -1.75}, {1.5, 1.5, 0.25})}));
    CHECK(test::volume(mesh) == 24 - 1 - 1.5 * 1.5 * 1.25 - 1.5 * 1.5 * 0.25 + 0.25);
    CHECK(test::euler(mesh) == 2);
}

TEST_CASE("clean unites equal solids whose faces are cut differently", "[geometry]") {
    const Mesh mesh =
        united(together({shapes::icosphere(2), shapes::icosphere(2), moved(shapes::cube(), {4, 0, 0}),
                         moved(shapes::quad_cube(), {4, 0, 0.5})}));
    CHECK(test::volume(mesh) == Approx(test::volume(shapes::icosphere(2)) + 1.5).epsilon(1e-14));
    CHECK(test::euler(mesh) == 4);
}

TEST_CASE("clean keeps cavities, opens those that a solid runs into, and fills what is filled",
          "[geometry]") {
    const Mesh outer = box({0, 0, 0}, {4, 4, 4}), hole = inside_out(box({1, 1, 1}, {3, 3, 3}));
    const Mesh barred = united(together({outer, hole, box({1.5, 1.5, 0.5}, {2.5, 2.5, 3.5})}));
    CHECK(test::volume(barred) == Approx(64 - 8 + 2).epsilon(1e-14));
    const Mesh through = united(together({outer, hole, box({1.5, 1.5, -1}, {2.5, 2.5, 5})}));
    CHECK(test::volume(through) == Approx(64 - 8 + 2 + 2).epsilon(1e-14));
    const Mesh filled = united(together({outer, hole, box({0.5, 0.5, 0.5}, {5, 3.5, 3.5})}));
    CHECK(test::volume(filled) == Approx(64 + 9).epsilon(1e-14));
    CHECK(test::euler(filled) == 2);
    const Mesh two = united(together({outer, hole, inside_out(box({2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}))}));
    CHECK(test::volume(two) == Approx(64 - 8 - 1 + 0.125).epsilon(1e-14));
    const Mesh beside = united(together({outer, hole, box({3.5, 3.5, 3.5}, {5, 5, 5})}));
    CHECK(test::volume(beside) == Approx(64 - 8 + 3.375 - 0.125).epsilon(1e-14));
}

TEST_CASE("clean opens the inside of a tube that passes through itself", "[geometry]") {
    Mesh tube = shapes::torus(96, 12, 1, 0.2);
    for (Vec3& p : tube.positions) { // a figure of eight that meets itself in the middle
        const double r = std::sqrt(p.x * p.x + p.y * p.y), c = p.x / r, s = p.y / r;
        const Vec3 centre{1.5 * c, 1.5 * s * c, 0}, ahead = normalised(Vec3{-s, c * c - s * s, 0});
        const Vec3 side{ahead.y, -ahead.x, 0};
        p = centre + side * (r - 1) + Vec3{0, 0, p.z};
    }
    REQUIRE(clean_steps::crossings(tube).count > 0);
    const Mesh mesh = united(tube);
    CHECK(test::euler(mesh) == -2);
    CHECK(inspect(mesh).components == 1);
}

TEST_CASE("clean parts solids that touch at a point", "[geometry]") {
    const Mesh mesh =
        united(together({box({-1, -1, -1}, {1, 1, 1}), moved(shapes::octahedron(), {0, 0, 2})}));
    CHECK(test::volume(mesh) == Approx(8 + 4.0 / 3).epsilon(1e-14));
    CHECK(inspect(mesh).components == 2);
}

TEST_CASE("clean cuts off what is inside out where a solid is turned over", "[geometry]") {
    Mesh mesh = shapes::icosphere(3);
    mesh.positions[0] *= -1.5; // through the far side
    const Mesh result = united(mesh);
    CHECK(test::volume(result) < test::volume(shapes::icosphere(3)));
    CHECK(test::volume(result) > 0.95 * test::volume(shapes::icosphere(3)));
}

TEST_CASE("clean refuses to unite what has no inside, and leaves it as it was", "[geometry]") {
    const Mesh solid = box({0, 0, 0}, {2, 2, 2}), other = box({1, 1, 1}, {3, 3, 3});
    CHECK(says(refusal(together({solid, inside_out(other)})), "inside out"));
    CHECK(says(refusal(together({inside_out(solid), inside_out(other)})), "inside out"));
    CHECK(says(refusal(together({solid, moved(shapes::grid(4, 4), {-1, -1, 1})})), "is open"));
    Mesh unsure = other;
    std::swap(unsure.corners[0], unsure.corners[1]);
    CHECK(says(refusal(together({solid, unsure})), "inconsistently oriented"));
    // Components that can be united are united, even if others cannot.
    const Mesh far = moved(together({solid, other}), {10, 0, 0});
    const auto r = clean(together({solid, inside_out(other), far}), uniting());
    CHECK(r.not_done.size() == 1);
    CHECK(r.counts.united_components == 2);
    CHECK(test::volume(r.mesh) == Approx(8 - 8 + 15));
}

TEST_CASE("clean leaves faces outside of the crossings as they were", "[geometry]") {
    Mesh mesh =
        together({with_uv_seams(noisy_icosphere(3, 0.02, 7)), moved(shapes::quad_cube(), {0.2, 0.1, 0.3})});
    const auto before = test::sound_faces(mesh);
    const auto r = clean(mesh, uniting());
    std::size_t same = 0, quads = 0;
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        same += std::binary_search(before.begin(), before.end(), test::shape_of(r.mesh, f));
        quads += r.mesh.face_size(f) == 4;
    }
    CHECK(same + r.counts.refined_faces + r.counts.covered_faces == mesh.face_count());
    CHECK(same > 100);
}

TEST_CASE("clean carries texture coordinates to where solids are cut", "[geometry]") {
    // Coordinates that are linear in space stay so, on every wedge.
    const auto linear = [](const Vec3& p) { return std::array{0.5 * p.x - 0.25 * p.y, p.z + 0.125 * p.x}; };
    Mesh mesh = together({shapes::icosphere(3), moved(shapes::icosphere(3), {0.7, 0.2, 0.1})});
    std::vector<double> uv, heat;
    for (const Vec3& p : mesh.positions) {
        const auto at = linear(p);
        uv.insert(uv.end(), at.begin(), at.end());
        heat.push_back(p.x);
    }
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, AttributeData(uv)});
    mesh.attributes.push_back({"heat", Domain::vertex, Role::generic, 1, false, AttributeData(heat)});
    std::vector<std::uint32_t> group(mesh.face_count());
    for (std::size_t f = group.size() / 2; f < group.size(); ++f) group[f] = 1;
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false, AttributeData(group)});
    const auto r = clean(mesh, uniting());
    REQUIRE(r.not_done.empty());
    const Attribute* out = r.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(out);
    for (Index w = 0; w < r.mesh.wedge_count(); ++w) {
        const Vec3& p = r.mesh.positions[r.mesh.vertex_of_wedge(w)];
        const auto wanted = linear(p);
        CHECK(out->value(w, 0) == Approx(wanted[0]).margin(1e-13));
        CHECK(out->value(w, 1) == Approx(wanted[1]).margin(1e-13));
    }
    for (Index v = 0; v < r.mesh.vertex_count(); ++v)
        CHECK(r.mesh.find("heat", Domain::vertex)->value(v, 0) ==
              Approx(r.mesh.positions[v].x).margin(1e-13));
    const Attribute* side = r.mesh.find("group", Domain::face);
    for (Index f = 0; f < r.mesh.face_count(); ++f) { // nearer to its original sphere
        Vec3 middle;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) middle += r.mesh.point(c) / 3;
        const double a = std::abs(length(middle) - 1), b = std::abs(length(middle - Vec3{0.7, 0.2, 0.1}) - 1);
        if (std::abs(a - b) > 0.02) CHECK((side->value(f, 0) == 1) == (b < a));
    }
    // A wedge on each side of the line where they meet, and no more elsewhere.
    std::vector<int> wedges(r.mesh.vertex_count(), 0);
    for (Index w = 0; w < r.mesh.wedge_count(); ++w) ++wedges[r.mesh.vertex_of_wedge(w)];
    for (Index v = 0; v < wedges.size(); ++v) {
        const Vec3& p = r.mesh.positions[v];
        const bool given = std::find(mesh.positions.begin(), mesh.positions.end(), p) != mesh.positions.end();
        CHECK(wedges[v] == (given ? 1 : 2));
    }
    CHECK(std::none_of(r.mesh.attributes.begin(), r.mesh.attributes.end(),
                       [](const Attribute& a) { return a.name.starts_with("facetmill:"); }));
}

TEST_CASE("clean keeps polygons that are not cut, and cuts those that are", "[geometry]") {
    const Mesh a = shapes::quad_cube(), b = moved(shapes::quad_cube(), {0.5, 0.25, 0.25});
    const Mesh mesh = united(together({a, moved(b, {0, 0.5, 0.5})}));
    CHECK(test::volume(mesh) == Approx(2 - 0.5 * 0.25 * 0.25).epsilon(1e-14));
    std::size_t quads = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) quads += mesh.face_size(f) == 4;
    CHECK(quads == 6); // three of each
}

TEST_CASE("the union of turned spheres is CGAL's", "[geometry]") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Mesh a = noisy_icosphere(3, 0.05, seed);
        const Mesh b = moved(noisy_icosphere(3, 0.05, seed + 100), {0.9 - 0.1 * seed, 0.07 * seed, 0.3});
        const Mesh mesh = united(together({a, b}));
        const auto oracle = oracle::union_of(a, b);
        CHECK(test::volume(mesh) == Approx(test::volume(oracle)).epsilon(1e-12));
        CHECK(test::area(mesh) == Approx(test::area(oracle)).epsilon(1e-12));
        CHECK(test::euler(mesh) == test::euler(oracle));
    }
}

TEST_CASE("a union in single precision is sound in a file of single precision", "[geometry]") {
    CleanSettings s = uniting();
    s.single = true;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Mesh a = noisy_icosphere(3, 0.05, seed);
        const Mesh b = moved(noisy_icosphere(3, 0.05, seed + 100), {0.9 - 0.1 * seed, 0.07 * seed, 0.3});
        const Mesh mesh = clean(together({a, b}), s).mesh;
        CHECK(std::all_of(mesh.positions.begin(), mesh.positions.end(),
                          [](const Vec3& p) { return as_float32(p) == p; }));
        const Properties properties = inspect(mesh, {.self_intersections = true});
        CHECK(properties.closed);
        CHECK(properties.self_intersections == 0);
        CHECK(test::volume(mesh) == Approx(test::volume(oracle::union_of(a, b))).epsilon(1e-6));
    }
}

TEST_CASE("clean unites solids whose walls nearly run along each other", "[geometry]") {
    // Their slits are so narrow that rounding closes and crosses many of them.
    for (int i = 1; i <= 8; ++i) {
        const Mesh a = shapes::torus(16, 8, 0.6, 0.2), b = moved(a, {0.061 * i, 0, 0});
        const Mesh c = moved(shapes::torus(24, 6, 0.6, 0.2), {-0.037 * i, 0, 0});
        const Mesh mesh = united(together({a, b, c}));
        CHECK(test::volume(mesh) ==
              Approx(test::volume(oracle::union_of(oracle::union_of(a, b), c))).epsilon(1e-9));
    }
}

TEST_CASE("triangles without area are taken out of a closed surface", "[geometry]") {
    clean_steps::Work work;
    work.mesh = shapes::tetrahedron(); // faces 0 2 1, 0 1 3, 1 2 3, 2 0 3
    work.mesh.positions.push_back({0.5, 0, 0});
    work.mesh.positions.push_back({0.25, 0, 0});
    // The first face ends at 4. Flat faces on 0 1 and on 0 4 connect it with the second.
    work.mesh.corners = {0, 2, 4, 4, 2, 1, 0, 4, 5, 5, 4, 0, 0, 4, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    REQUIRE(test::closed(work.mesh));
    REQUIRE(inspect(work.mesh).degenerate_faces == 3);
    clean_steps::take_out_flat(work);
    CHECK(test::closed(work.mesh));
    CHECK(inspect(work.mesh).degenerate_faces == 0);
    CHECK(test::volume(work.mesh) == Approx(1.0 / 6));
}

TEST_CASE("clean unites solids to the same bytes for any number of threads", "[geometry]") {
    const Mesh mesh = together({shapes::torus(64, 32), moved(shapes::icosphere(4), {0.9, 0.1, 0.2})});
    set_threads(1);
    const Mesh one = clean(mesh, uniting()).mesh;
    set_threads(3);
    CHECK(test::same_mesh(clean(mesh, uniting()).mesh, one));
    set_threads(0);
}

namespace {

/// This many bars along x, and the same number along y through them.
Mesh crossing_bars(int n) {
    Mesh bars;
    for (int i = 0; i < n; ++i) {
        append(bars, box({-1, i + 0.25, 0}, {n + 1.0, i + 0.75, 0.5}));
        append(bars, box({i + 0.3, -1, 0.1}, {i + 0.7, n + 1.0, 0.4}));
    }
    return bars;
}

} // namespace

TEST_CASE("clean looks for crossings only where few boxes meet, and says so", "[geometry]") {
    const Mesh bars = crossing_bars(40);
    CleanSettings s = uniting();
    s.budget.box_pairs = 0;
    std::vector<NotDone> told;
    for (const int threads : {1, 3}) {
        set_threads(threads);
        const CleanResult r = clean(bars, s);
        CHECK(test::same_mesh(r.mesh, bars));
        REQUIRE(r.not_done.size() == 1);
        CHECK(says(r.not_done[0].why, "the bounding boxes of more than 30720 pairs of its 960 faces meet"));
        if (threads == 1) told = r.not_done;
        CHECK(r.not_done == told);
    }
    set_threads(0);
    s.budget = {};
    const CleanResult united = clean(bars, s);
    CHECK(united.not_done.empty());
    CHECK(united.budget.vain_pairs == UntangleBudget{}.vain_pairs);
    CHECK(united.budget.box_pairs < UntangleBudget{}.box_pairs);
    CHECK(inspect(united.mesh).components == 1);
}

TEST_CASE("once much was tried in vain, clean leaves meshes of more crossings than faces", "[geometry]") {
    const Mesh bars = crossing_bars(8);
    CleanSettings s = uniting();
    s.budget.vain_pairs = 0;
    const CleanResult r = clean(bars, s);
    CHECK(test::same_mesh(r.mesh, bars));
    REQUIRE(r.not_done.size() == 1);
    CHECK(says(r.not_done[0].why, "reasonable time"));
    // A failed union uses up the budget only once per mesh, because the second round finds the same mesh.
    const Mesh turned = together({box({0, 0, 0}, {2, 2, 2}), inside_out(box({1, 1, 1}, {3, 3, 3}))});
    const CleanResult vain = clean(turned, uniting());
    CHECK_FALSE(vain.not_done.empty());
    CHECK(vain.budget.vain_pairs == UntangleBudget{}.vain_pairs - clean_steps::crossings(turned).count);
    const CleanResult few = clean(crossing_bars(1), s); // fewer pairs than faces, or as many
    CHECK(few.not_done.empty());
    CHECK(inspect(few.mesh).components == 1);
}

TEST_CASE("clean refuses solids that cross far too often", "[geometry]") {
    Mesh needles; // all lie on a plane, and each crosses each other there
    for (int i = 0; i < 800; ++i) {
        Mesh needle = shapes::tetrahedron();
        for (std::size_t k = 0; k < 3; ++k) {
            const double turn = 0.37 * i + 2.0944 * static_cast<double>(k);
            needle.positions[k] = {std::cos(turn), std::sin(turn), 0};
        }
        needle.positions[3] = {0, 0, 1 + 0.001 * i};
        append(needles, needle);
    }
    REQUIRE(clean_steps::crossings(needles).count > 1'000'000);
    CHECK(says(refusal(needles), "reasonable time"));
}
