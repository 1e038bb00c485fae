// The methods of relax other than laplacian, features, masks, targets.
#include "geometry/crumple/crumple.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/generate/generate.hpp"
#include "geometry/relax/relax.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = RelaxSettings::Method;
using Boundary = RelaxSettings::Boundary;

namespace {

constexpr Method every_method[] = {Method::laplacian, Method::taubin, Method::cotangent, Method::implicit,
                                   Method::hc};

RelaxSettings by(Method method, std::int64_t iterations = 1) {
    RelaxSettings s;
    s.method = method;
    s.iterations = iterations;
    return s;
}

Mesh noisy_sphere() { return crumple(shapes::icosphere(4), {.amplitude = 0.01, .seed = 1}).mesh; }

/// The roughness of the unit sphere: the deviation of the distances from their mean.
double roughness(const Mesh& mesh) {
    double mean = 0, sum = 0;
    for (const Vec3& p : mesh.positions) mean += length(p);
    mean /= static_cast<double>(mesh.vertex_count());
    for (const Vec3& p : mesh.positions) sum += (length(p) / mean - 1) * (length(p) / mean - 1);
    return std::sqrt(sum / static_cast<double>(mesh.vertex_count()));
}

double volume_of_surface(const Mesh& mesh) { return *surface_size(mesh).volume; }

bool finite(const Mesh& mesh) {
    for (const Vec3& p : mesh.positions)
        if (!is_finite(p)) return false;
    return true;
}

} // namespace

TEST_CASE("every method takes noise away", "[geometry]") {
    const Mesh mesh = noisy_sphere();
    for (const Method method : every_method) {
        const Mesh smooth = relax(mesh, by(method, 5)).mesh;
        CAPTURE(static_cast<int>(method));
        CHECK(roughness(smooth) < 0.5 * roughness(mesh));
        CHECK(smooth.corners == mesh.corners);
        CHECK(broken_invariants(smooth).empty());
    }
}

TEST_CASE("taubin and hc keep the volume where laplacian shrinks", "[geometry]") {
    const Mesh mesh = noisy_sphere();
    const double before = volume_of_surface(mesh),
                 shrunk = 1 - volume_of_surface(relax(mesh, by(Method::laplacian, 10)).mesh) / before;
    CHECK(shrunk > 0.02);
    CHECK(std::abs(1 - volume_of_surface(relax(mesh, by(Method::taubin, 10)).mesh) / before) < 0.2 * shrunk);
    CHECK(std::abs(1 - volume_of_surface(relax(mesh, by(Method::hc, 10)).mesh) / before) < 0.2 * shrunk);
}

TEST_CASE("cotangent leaves a flat, irregular grid where it is; laplacian does not", "[geometry]") {
    Mesh mesh = crumple(shapes::grid(12, 12), {.amplitude = 0.12, .seed = 4}).mesh;
    for (auto& p : mesh.positions) p.z = 0;
    const auto largest = [&](Method method) { return relax(mesh, by(method)).largest_move; };
    CHECK(largest(Method::cotangent) < 0.15); // obtuse angles count 0, so a few vertices drift a little
    CHECK(largest(Method::cotangent) < 0.6 * largest(Method::laplacian));
}

TEST_CASE("implicit solves the equation that it states", "[geometry]") {
    const Mesh mesh = noisy_sphere();
    RelaxSettings s = by(Method::implicit);
    s.lambda = 7;
    const Mesh after = relax(mesh, s).mesh;
    // P' - lambda (mean' - P') = P, so a step back of the explicit method returns.
    std::vector<Vec3> sums(mesh.vertex_count());
    std::vector<double> counts(mesh.vertex_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index k = 0; k < 3; ++k) { // each edge of a closed mesh once in each direction
            const Index a = mesh.corners[3 * f + k], b = mesh.corners[3 * f + (k + 1) % 3];
            sums[a] += after.positions[b];
            ++counts[a];
        }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const Vec3& p = after.positions[v];
        CHECK(length(p - (sums[v] / counts[v] - p) * 7 - mesh.positions[v]) < 1e-8);
    }
    s.lambda = 1e5;
    CHECK(finite(relax(mesh, s).mesh));
}

TEST_CASE("feature_angle keeps the edges of a cube", "[geometry]") {
    const Mesh cube = grid_split(shapes::cube(), 6).mesh;
    for (const Method method : every_method) {
        CAPTURE(static_cast<int>(method));
        RelaxSettings s = by(method, 8);
        CHECK(std::abs(1 - volume_of_surface(relax(cube, s).mesh)) > 1e-4);
        s.feature_angle = 0.5;
        const RelaxResult r = relax(cube, s);
        CHECK(volume_of_surface(r.mesh) == Approx(1).epsilon(1e-9));
        CHECK(r.held == 8); // the corners
    }
}

TEST_CASE("a boundary slides along itself with every method", "[geometry]") {
    Mesh mesh = shapes::grid(8, 8);
    for (auto& p : mesh.positions) p.x = p.x * p.x / 8; // uneven along x
    for (const Method method : every_method) {
        RelaxSettings s = by(method, 4);
        s.boundary = Boundary::slide;
        s.feature_angle = 1;
        const RelaxResult r = relax(mesh, s);
        CAPTURE(static_cast<int>(method));
        CHECK(r.mesh.bounds().min.y == Approx(0).margin(1e-9));
        CHECK(r.mesh.bounds().max.y == Approx(8).epsilon(1e-9));
        CHECK(r.moved > 0);
        CHECK(r.mesh.positions[1].y == Approx(0).margin(1e-9));
    }
}

TEST_CASE("a mask keeps vertices, or shortens their moves", "[geometry]") {
    const Mesh mesh = noisy_sphere();
    for (const Method method : every_method) {
        RelaxSettings s = by(method, 2);
        s.mask.assign(mesh.vertex_count(), 1);
        const Mesh all = relax(mesh, s).mesh;
        CHECK(test::same(all, relax(mesh, by(method, 2)).mesh));
        for (std::size_t v = 0; v < 100; ++v) s.mask[v] = 0;
        const Mesh masked = relax(mesh, s).mesh;
        for (std::size_t v = 0; v < 100; ++v) CHECK(masked.positions[v] == mesh.positions[v]);
        s.mask.assign(mesh.vertex_count(), 0.5);
        CHECK(roughness(relax(mesh, s).mesh) < roughness(mesh));
    }
}

TEST_CASE("until stops early and says so", "[geometry]") {
    RelaxSettings s = by(Method::laplacian, 1000);
    s.until = 0.0035; // a smooth sphere of these faces shrinks by 0.0028 in an iteration
    const RelaxResult r = relax(noisy_sphere(), s);
    CHECK(r.settled);
    CHECK(r.iterations > 1);
    CHECK(r.iterations < 500);
    CHECK(r.last_move <= 0.0035);
    s.iterations = 1;
    CHECK_FALSE(relax(noisy_sphere(), s).settled);
}

TEST_CASE("morph targets are relaxed as the surfaces they stand for", "[geometry]") {
    Mesh mesh = noisy_sphere();
    const Mesh target = crumple(shapes::icosphere(4), {.amplitude = 0.02, .seed = 9}).mesh;
    std::vector<double> deltas;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
        for (std::size_t i = 0; i < 3; ++i) deltas.push_back(target.positions[v][i] - mesh.positions[v][i]);
    mesh.attributes.push_back({"TARGET_0_POSITION", Domain::wedge, Role::morph_vector, 3, false, deltas});
    mesh.attributes.push_back({"TARGET_0_NORMAL", Domain::wedge, Role::morph_vector, 3, false, deltas});
    for (const Method method : every_method) {
        const RelaxResult r = relax(mesh, by(method, 2));
        const Mesh alone = relax(target, by(method, 2)).mesh;
        const Attribute* a = r.mesh.find("TARGET_0_POSITION", Domain::wedge);
        for (std::size_t v = 0; v < mesh.vertex_count(); v += 7) {
            const Vec3 d{a->value(v, 0), a->value(v, 1), a->value(v, 2)};
            CHECK(length(r.mesh.positions[v] + d - alone.positions[v]) < 1e-8);
        }
        REQUIRE(r.changes.size() == 2);
        CHECK(r.changes[0] == AttributeChange{"TARGET_0_POSITION", Domain::wedge,
                                              AttributeChange::Kind::recomputed, "relaxed with the surface"});
        CHECK(r.changes[1] ==
              AttributeChange{"TARGET_0_NORMAL", Domain::wedge, AttributeChange::Kind::kept, "not relaxed"});
    }
}

TEST_CASE("degenerate and non-manifold places give numbers", "[geometry]") {
    Mesh mesh = shapes::icosphere(1);
    mesh.positions.push_back({9, 9, 9});                       // of no face
    mesh.positions.insert(mesh.positions.end(), 3, {5, 5, 5}); // a face with all corners at the same position
    const Index n = 43;
    mesh.corners.insert(mesh.corners.end(), {0, 0, 1, 2, 2, 2, 0, 1, 5, n, n + 1, n + 2, 3, 4, 42});
    for (const Method method : every_method)
        for (const Boundary boundary : {Boundary::fixed, Boundary::slide, Boundary::free})
            for (const bool features : {false, true}) {
                RelaxSettings s = by(method, 3);
                s.boundary = boundary;
                if (features) s.feature_angle = 0.3;
                CAPTURE(static_cast<int>(method), static_cast<int>(boundary), features);
                for (const Mesh& m : {mesh, shapes::fan3(), shapes::bowtie(), shapes::hourglass(),
                                      shapes::moebius(12), shapes::folded_quad(), shapes::quad_cube()})
                    CHECK(finite(relax(m, s).mesh));
                CHECK(relax(Mesh{}, s).mesh.face_count() == 0);
            }
}

TEST_CASE("every method gives the same for any number of threads", "[geometry]") {
    const Mesh mesh = crumple(shapes::icosphere(5), {.amplitude = 0.01}).mesh;
    for (const Method method : every_method) {
        RelaxSettings s = by(method, 3);
        s.feature_angle = 1;
        CHECK(test::same_for_any_threads([&] { return relax(mesh, s).mesh; }));
    }
}

TEST_CASE("relax: factors that a method cannot take are refused", "[geometry]") {
    RelaxSettings s = by(Method::taubin);
    s.lambda = 0.7;
    CHECK(test::failure([&] { relax(shapes::cube(), s); }) ==
          "usage [E-RANGE] relax: lambda is 0 < x < 0.7 for taubin, not 0.7");
    s = by(Method::hc);
    s.lambda = 1.5;
    CHECK(test::failure([&] { relax(shapes::cube(), s); }) ==
          "usage [E-RANGE] relax: lambda is 0 < x <= 1, not 1.5");
    s.method = Method::implicit;
    CHECK_NOTHROW(relax(shapes::cube(), s));
}

TEST_CASE("slide rounds the corners of the outline, and feature_angle holds them", "[geometry]") {
    const Mesh square = shapes::grid(6, 6);
    RelaxSettings s;
    s.iterations = 5;
    s.boundary = RelaxSettings::Boundary::slide;
    CHECK(test::area(relax(square, s).mesh) < 36);
    s.feature_angle = 30 * 3.14159265358979 / 180;
    const Mesh held = relax(square, s).mesh;
    CHECK(test::area(held) == Approx(36).epsilon(1e-12));
    for (const Index corner : {0, 6, 42, 48}) CHECK(held.positions[corner] == square.positions[corner]);
}

TEST_CASE("edges that bend by exactly the angle are no features", "[geometry]") {
    const double right = 1.5707963267948966;
    RelaxSettings s;
    s.feature_angle = right;
    CHECK(relax(shapes::cube(), s).held == 0);
    s.feature_angle = right - 1e-6;
    CHECK(relax(shapes::cube(), s).held == 8);
}
