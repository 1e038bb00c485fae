// Boolean operations, against voxels, inclusion and exclusion, and CGAL's corefinement.
#include "oracle/cgal_oracle.hpp"
#include "support/catch.hpp"
#include "support/clean_laws.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "geometry/boolean/boolean_pass.hpp"
#include "geometry/boolean/combine.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/orient/orient.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

using Operation = CombineOperation;
constexpr std::array operations{Operation::unite, Operation::subtract, Operation::intersect};

/// The result, checked to be closed, edge-manifold and without intersections.
Mesh combined(const Mesh& a, const Mesh& b, Operation operation) {
    const auto r = combine({a, b}, {operation, 1});
    INFO(r.failure.value_or(CombineFailure{}).why);
    REQUIRE(!r.failure);
    check_solid(r.mesh);
    CHECK(r.mesh_of_face.size() == r.mesh.face_count());
    return r.mesh;
}

/// Cubes of a lattice, [i][j][k].
constexpr int side = 4;
using Voxels = std::array<std::array<std::array<bool, side>, side>, side>;

bool at(const Voxels& v, int i, int j, int k) {
    const auto within = [](int x) { return x >= 0 && x < side; };
    return within(i) && within(j) && within(k) &&
           v[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][static_cast<std::size_t>(k)];
}

Voxels random_voxels(std::uint64_t seed, double share) {
    Voxels v{};
    std::uint64_t key = 0;
    for (auto& plane : v)
        for (auto& row : plane)
            for (bool& cube : row) cube = between(0, 1, seed, key++) < share;
    return v;
}

/// Their surface, of squares or of triangles: crowded edges and vertices wherever cubes touch.
Mesh surface_of_voxels(const Voxels& v, bool squares) {
    Mesh mesh;
    const Mesh cube = shapes::quad_cube();
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < side; ++k)
                for (Index f = 0; at(v, i, j, k) && f < cube.face_count(); ++f) {
                    Vec3 middle;
                    for (Index c = 4 * f; c < 4 * f + 4; ++c) middle += cube.point(c) / 4;
                    const Vec3 out = (middle - Vec3{0.5, 0.5, 0.5}) * 2.0;
                    if (at(v, i + int(out.x), j + int(out.y), k + int(out.z))) continue;
                    std::array<Index, 4> face{};
                    for (Index c = 0; c < 4; ++c) {
                        face[c] = static_cast<Index>(mesh.positions.size());
                        mesh.positions.push_back(cube.point(4 * f + c) +
                                                 Vec3{double(i), double(j), double(k)});
                    }
                    add_face(mesh, face);
                }
    weld_exact(mesh);
    return squares ? mesh : triangulated(mesh);
}

bool expected(Operation operation, bool a, bool b) {
    switch (operation) {
    case Operation::unite:
        return a || b;
    case Operation::subtract:
        return a && !b;
    case Operation::intersect:
        break;
    }
    return a && b;
}

/// The volume of the result if b is moved by this many half cubes.
double volume_of_voxels(const Voxels& a, const Voxels& b, int moved_by, Operation operation) {
    double eighths = 0;
    const auto cell = [](int x) { return x >= 0 ? x / 2 : -1; };
    for (int i = 0; i < 2 * side + moved_by; ++i)
        for (int j = 0; j < 2 * side + moved_by; ++j)
            for (int k = 0; k < 2 * side + moved_by; ++k)
                eighths += expected(operation, at(a, cell(i), cell(j), cell(k)),
                                    at(b, cell(i - moved_by), cell(j - moved_by), cell(k - moved_by)));
    return eighths / 8;
}

} // namespace

TEST_CASE("combine makes of voxels what counting says", "[geometry][combine]") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        const Voxels a = random_voxels(seed, 0.4), b = random_voxels(seed + 50, 0.3);
        const Mesh mesh = surface_of_voxels(a, seed % 2 == 0);
        for (const int by : {0, 1, 2}) { // whole cubes on whole cubes, half ones across, shifted
            const Mesh other = test::moved(surface_of_voxels(b, seed % 3 == 0), Vec3{1, 1, 1} * (0.5 * by));
            for (const Operation operation : operations) {
                INFO("seed " << seed << ", moved by " << by << ", operation " << int(operation));
                CHECK(test::volume(combined(mesh, other, operation)) ==
                      Approx(volume_of_voxels(a, b, by, operation)));
            }
        }
    }
}

TEST_CASE("combine of a solid with itself leaves it, or nothing", "[geometry][combine]") {
    const Mesh solid = noisy_icosphere(2, 0.1, 3);
    CHECK(test::volume(combined(solid, solid, Operation::unite)) ==
          Approx(test::volume(solid)).epsilon(1e-14));
    CHECK(test::volume(combined(solid, solid, Operation::intersect)) ==
          Approx(test::volume(solid)).epsilon(1e-14));
    CHECK(combined(solid, solid, Operation::subtract).face_count() == 0);
    CHECK(combined(solid, test::moved(solid, {5, 0, 0}), Operation::intersect).face_count() == 0);
    CHECK(combined(solid, test::moved(solid, {5, 0, 0}), Operation::subtract).face_count() == 320);
}

TEST_CASE("combine obeys inclusion and exclusion, also of solids that pass through themselves",
          "[geometry][combine]") {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Mesh a = seed % 2 == 0 ? noisy_torus(24, 12, 0.05, seed) : noisy_icosphere(3, 0.05, seed);
        Mesh b = test::moved(noisy_icosphere(3, 0.1, seed + 9), random_point(0.8, seed, 77));
        if (seed % 3 == 0) append(a, test::moved(shapes::cube(), {0.3, -0.2, 0.1})); // overlaps it
        if (seed % 4 == 0) append(b, test::moved(noisy_torus(16, 8, 0, 1), {0.1, 0.3, 0}));
        const double alone_a = test::volume(combined(a, Mesh(a), Operation::unite)),
                     alone_b = test::volume(combined(b, Mesh(b), Operation::unite));
        const double both = test::volume(combined(a, b, Operation::intersect));
        INFO("seed " << seed);
        CHECK(both > 0);
        CHECK(test::volume(combined(a, b, Operation::unite)) ==
              Approx(alone_a + alone_b - both).epsilon(1e-11));
        CHECK(test::volume(combined(a, b, Operation::subtract)) == Approx(alone_a - both).epsilon(1e-11));
        CHECK(test::volume(combined(b, a, Operation::subtract)) == Approx(alone_b - both).epsilon(1e-11));
    }
}

TEST_CASE("combine hollows solids and opens cavities", "[geometry][combine]") {
    const Mesh ball = shapes::icosphere(3);
    Mesh core = ball;
    for (Vec3& p : core.positions) p *= 0.5;
    const Mesh hollow = combined(ball, core, Operation::subtract);
    CHECK(test::volume(hollow) == Approx(test::volume(ball) * 7 / 8));
    CHECK(hollow.face_count() == 2 * ball.face_count());
    Mesh bar = shapes::cube();
    for (Vec3& p : bar.positions) p = {p.x * 4 - 2, p.y * 0.2 - 0.13, p.z * 0.2 - 0.07};
    const double inside = test::volume(combined(bar, hollow, Operation::intersect));
    CHECK(test::volume(combined(hollow, bar, Operation::subtract)) == Approx(test::volume(hollow) - inside));
    CHECK(test::euler(combined(hollow, bar, Operation::subtract)) == 0); // two openings: a torus
    // A subtracted solid may have a cavity, whose contents stay.
    CHECK(test::volume(combined(ball, hollow, Operation::subtract)) == Approx(test::volume(core)));
}

TEST_CASE("combine is CGAL's corefinement on turned spheres", "[geometry][combine]") {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Mesh a = noisy_icosphere(3, 0.05, seed);
        const Mesh b =
            test::moved(noisy_icosphere(3, 0.05, seed + 100), {0.9 - 0.1 * seed, 0.07 * seed, 0.3});
        const Mesh mesh = combined(a, b, Operation::subtract), peer = oracle::difference_of(a, b);
        CHECK(test::volume(mesh) == Approx(test::volume(peer)).epsilon(1e-12));
        CHECK(test::area(mesh) == Approx(test::area(peer)).epsilon(1e-12));
        CHECK(test::euler(mesh) == test::euler(peer));
    }
}

TEST_CASE("combine turns the normals of what is taken away, and keeps attributes on both",
          "[geometry][combine]") {
    Mesh a = shapes::uv_cube(), b = test::moved(shapes::uv_cube(), {0.5, 0.25, 0.25});
    const auto r = combine({a, b}, {Operation::subtract, 1});
    REQUIRE(!r.failure);
    const Attribute* normal = r.mesh.find("NORMAL", Domain::wedge);
    REQUIRE(normal);
    std::size_t of_second = 0;
    for (Index f = 0; f < r.mesh.face_count(); ++f) {
        of_second += r.mesh_of_face[f] == 1;
        const Index begin = r.mesh.face_begin(f);
        const Vec3 out = normalised(cross(r.mesh.point(begin + 1) - r.mesh.point(begin),
                                          r.mesh.point(begin + 2) - r.mesh.point(begin)));
        for (const Index w : r.mesh.face_wedges(f))
            CHECK(dot(out, {normal->value(w, 0), normal->value(w, 1), normal->value(w, 2)}) == Approx(1));
    }
    CHECK(of_second > 0);
    CHECK(r.mesh.find("TEXCOORD_0", Domain::wedge));
    CHECK(std::none_of(r.mesh.attributes.begin(), r.mesh.attributes.end(),
                       [](const Attribute& x) { return x.name.starts_with("facetmill:"); }));
}

TEST_CASE("combine refuses what is no solid, and says which it is", "[geometry][combine]") {
    const Mesh solid = shapes::icosphere(2);
    const auto why = [&](const Mesh& other) {
        const auto r = combine({solid, other}, {Operation::subtract, 1});
        CHECK(r.mesh.face_count() == 0);
        REQUIRE(r.failure);
        return std::pair{r.failure->mesh, r.failure->why};
    };
    const auto names = [](const std::pair<Index, std::string>& told, Index mesh, const char* what) {
        return told.first == mesh && told.second.find(what) != std::string::npos;
    };
    CHECK(names(why(shapes::grid(2, 2)), 1, "is open"));
    Mesh unsure = solid;
    std::swap(unsure.corners[0], unsure.corners[1]);
    CHECK(names(why(unsure), 1, "inconsistently oriented"));
    const Mesh turned = orient(test::moved(solid, {0.5, 0, 0}), {OrientMethod::flip, {}}).mesh;
    CHECK(names(why(turned), 1, "is inside out"));
    const Mesh within = orient(solid, {OrientMethod::flip, {}}).mesh; // a cavity of its own mesh only
    Mesh around = solid;
    for (Vec3& p : around.positions) p *= 2.0;
    CHECK(combine({around, within}, {}).failure);
    append(around, within);
    CHECK(!combine({around}, {}).failure);
}

TEST_CASE("combine gives the same bytes for any number of threads", "[geometry][combine]") {
    const Mesh a = shapes::torus(64, 32), b = test::moved(shapes::icosphere(4), {0.9, 0.1, 0.2});
    set_threads(1);
    const Mesh one = combined(a, b, Operation::subtract);
    set_threads(3);
    CHECK(test::same_mesh(combined(a, b, Operation::subtract), one));
    set_threads(0);
}

TEST_CASE("combine says when rounding is why solids cannot be combined", "[geometry][combine]") {
    const auto off = [](double x, int by) { return by == 0 ? x : std::nextafter(x, by > 0 ? 9.0 : -9.0); };
    const auto tetrahedron = [&](const std::array<int, 12>& by) { // each coordinate off by a bit, or not
        Mesh mesh;
        for (std::size_t v = 0; v < 4; ++v) {
            Vec3 p{0.1, 0.1, 0.1};
            if (v > 0) p[v - 1] = 1.1;
            for (std::size_t k = 0; k < 3; ++k) p[k] = off(p[k], by[3 * v + k]);
            mesh.positions.push_back(p);
        }
        mesh.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        return mesh;
    };
    const auto r = combine({tetrahedron({-1, 1, 0, 1, 0, 0, -1, -1, -1, 1, 0, -1}),
                            tetrahedron({1, -1, 0, 1, -1, 0, 0, -1, -1, 1, 1, 1}),
                            tetrahedron({1, 0, 1, 1, -1, 0, -1, 0, -1, -1, 0, 1})},
                           {});
    REQUIRE(r.failure);
    CHECK(r.failure->why.find("rounding the coordinates") != std::string::npos);
}

TEST_CASE("combine takes no more memory than the run may", "[geometry][combine]") {
    const Mesh a = shapes::icosphere(3), b = test::moved(a, {0.5, 0.1, 0.2});
    const auto why_within = [&](std::uint64_t bytes) { // above the memory in use
        std::uint64_t limit = std::uint64_t{1} << 20;
        for (set_memory_limit(limit); *memory_left() == 0; set_memory_limit(limit)) limit *= 2;
        set_memory_limit(limit - *memory_left() + bytes);
        const auto r = combine({a, b}, {});
        set_memory_limit(0);
        CHECK(r.short_of_memory == r.failure.has_value());
        return r.failure ? r.failure->why : "";
    };
    CHECK(why_within(1) == "there is not enough memory to combine 2560 faces");
    CHECK(why_within(500 * 1000).starts_with("there is not enough memory to "));
    CHECK(why_within(std::uint64_t{1} << 30).empty());
}

TEST_CASE("uniting refuses what is more than the effort allows", "[geometry][combine]") {
    using namespace clean_steps;
    Mesh mesh = shapes::icosphere(2);
    append(mesh, test::moved(mesh, {0.5, 0.1, 0.2}));
    const SelfIntersections found = crossings(mesh);
    const Solids solids = find_solids(mesh, found);
    const United all = unite(mesh, solids, found, {});
    CHECK(all.refused.empty());
    CHECK(all.pairs == found.pairs.size());
    PassBudget effort{{}, all.pairs - 1};
    const United less = unite(mesh, solids, found, {}, nullptr, effort);
    REQUIRE(less.refused.size() == 1);
    CHECK(less.refused[0].why == effort.too_many);
    CHECK(!less.short_of_memory);
    const United poor = unite(mesh, solids, found, {}, nullptr, {100'000});
    REQUIRE(poor.refused.size() == 1);
    CHECK(poor.refused[0].why.find("not enough memory") != std::string::npos);
    CHECK(poor.short_of_memory);
}
