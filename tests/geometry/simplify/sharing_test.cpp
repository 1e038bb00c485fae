#include "geometry/crumple/crumple.hpp"
#include "geometry/simplify/sharing.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = SimplifySettings::Method;
using Stop = SimplifyResult::Stop;

namespace {

Mesh rough_ball(int level) { return crumple(shapes::icosphere(level), {.amplitude = 0.01}).mesh; }

SharingMeshes sharing(Mesh mesh, double scale = 1, std::size_t uses = 1) {
    SharingMeshes s;
    s.meshes.push_back(std::move(mesh));
    s.scale = scale;
    s.uses = uses;
    return s;
}

std::vector<SharingMeshes> both(SharingMeshes a, SharingMeshes b) {
    std::vector<SharingMeshes> all;
    all.push_back(std::move(a));
    all.push_back(std::move(b));
    return all;
}

} // namespace

TEST_CASE("a mesh that shares its target with none becomes what it becomes alone", "[geometry]") {
    for (const Method method : {Method::quadric, Method::quadric_endpoints, Method::shortest_edge}) {
        const SimplifySettings settings{.method = method, .ratio = 0.1};
        const auto alone = simplify(rough_ball(5), settings);
        std::vector<SharingMeshes> one;
        one.push_back(sharing(rough_ball(5), 3));
        const auto shared = simplify_sharing(std::move(one), settings);
        CHECK(test::same(shared[0][0][0].mesh, alone.mesh));
        CHECK(shared[0][0][0].stop == Stop::ratio);
    }
}

TEST_CASE("meshes that share a target end at about the same error", "[geometry]") {
    const auto r = simplify_sharing(both(sharing(rough_ball(5)), sharing(rough_ball(4), 5)), {.ratio = 0.05});
    const auto &large = r[0][0][0], &small = r[1][0][0]; // by the number of triangles
    CHECK(large.faces_after + small.faces_after == 20480 / 20 + 5120 / 20);
    // Costs are squared errors times the (5/8)th power of an area. A surface 25 times as large therefore has
    // about 25^(5/16) = 2.7 times less error.
    CHECK(*large.largest_error / (5 * *small.largest_error) > 0.7);
    CHECK(*large.largest_error / (5 * *small.largest_error) < 3);
    CHECK(test::sound(large.mesh, 2));
    CHECK(test::sound(small.mesh, 2));
}

TEST_CASE("a mesh that needs all its triangles stays as it came where others have enough to give",
          "[geometry]") {
    const auto r =
        simplify_sharing(both(sharing(shapes::cube()), sharing(shapes::grid(32, 32))), {.ratio = 0.5});
    CHECK(r[0][0][0].unchanged);
    CHECK(r[0][0][0].stop == Stop::ratio);
    CHECK(test::same(r[0][0][0].mesh, shapes::cube()));
    CHECK(r[1][0][0].faces_after == 1030 - 12);
}

TEST_CASE("where no collapse is left, meshes that met their own part of the target have met it",
          "[geometry]") {
    Mesh ball = rough_ball(3);
    SharingMeshes held = sharing(ball);
    held.lock.vertices.assign(ball.vertex_count(), 1);
    const auto r = simplify_sharing(both(std::move(held), sharing(ball, 1, 3)), {.ratio = 0.01});
    CHECK(r[0][0][0].stop == Stop::stuck);
    CHECK(r[0][0][0].faces_after == ball.face_count());
    CHECK(r[0][0][0].blocked.borders > 0);
    CHECK(r[1][0][0].stop == Stop::ratio);
    CHECK(r[1][0][0].faces_after < 13);
}

TEST_CASE("no collapse is beyond max_quadric_error", "[geometry]") {
    for (const Method method : {Method::quadric, Method::quadric_endpoints}) {
        const SimplifySettings settings{.method = method, .faces = 4, .max_quadric_error = 0.02};
        const auto r = simplify(rough_ball(4), settings);
        CHECK(r.stop == Stop::max_quadric_error);
        CHECK(r.blocked.error > 0);
        CHECK(*r.largest_error <= 0.02);
        CHECK(*r.largest_error > 0.015);
        CHECK(r.faces_after > 20);
        CHECK(test::sound(r.mesh, 2));
    }
    // If the target is reached first, the limit changes nothing.
    const auto free = simplify(rough_ball(4), {.ratio = 0.2});
    CHECK(test::same(simplify(rough_ball(4), {.ratio = 0.2, .max_quadric_error = 0.05}).mesh, free.mesh));
    CHECK(test::failure([] { simplify(shapes::cube(), {.ratio = 0.5, .max_quadric_error = 0}); }) != "");
}

TEST_CASE("what meshes cannot share is refused", "[geometry]") {
    for (SimplifySettings settings : {SimplifySettings{.method = Method::cluster, .ratio = 0.5},
                                      SimplifySettings{.method = Method::constrained, .ratio = 0.5},
                                      SimplifySettings{.ratio = 0.5, .max_error = 1}}) {
        CHECK(test::failure([&] {
                  simplify_sharing(both(sharing(shapes::cube()), sharing(shapes::cube())), settings);
              }).find("E-CONFLICT") != std::string::npos);
    }
}

TEST_CASE("meshes share a target alike for any number of threads", "[geometry]") {
    for (std::size_t which : {std::size_t{0}, std::size_t{1}})
        CHECK(test::same_for_any_threads([&] {
            auto r =
                simplify_sharing(both(sharing(rough_ball(6)), sharing(rough_ball(5), 2, 3)), {.ratio = 0.2});
            return std::move(r[which][0][0].mesh);
        }));
}
