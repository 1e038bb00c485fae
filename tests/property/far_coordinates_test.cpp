// Stages give the same at projected coordinates (UTM) as at the origin, up to the rounding of the input.
#include "support/catch.hpp"

#include "support/run_stage.hpp"

using namespace facetmill;
using test::run_stage;
using test::scene_of;

namespace {

/// Exact for the whole coordinates of the shapes.
constexpr Vec3 far_away{500001, 5200002, 399};

Mesh at_far(Mesh mesh) {
    for (Vec3& p : mesh.positions) p += far_away;
    return mesh;
}

void check_same(const Scene& near, const Scene& far) {
    REQUIRE(near.parts.size() == far.parts.size());
    for (std::size_t i = 0; i < near.parts.size(); ++i) {
        const Mesh &a = near.parts[i].mesh, &b = far.parts[i].mesh;
        CHECK(a.corners == b.corners);
        REQUIRE(a.vertex_count() == b.vertex_count());
        const Transform &s = near.parts[i].transform, &t = far.parts[i].transform;
        double most = 0;
        for (Index v = 0; v < a.vertex_count(); ++v)
            most = std::max(most, length(s.point(a.positions[v]) + far_away - t.point(b.positions[v])));
        CHECK(most < 1e-8); // ten steps of a double at 5,200,002
    }
}

} // namespace

TEST_CASE("stages give the same far from the origin", "[property]") {
    Mesh terrain = shapes::grid(12, 12);
    for (Vec3& p : terrain.positions) p.z = static_cast<int>(p.x * 7 + p.y * 5) % 4;
    Mesh block = shapes::cube();
    for (Vec3& p : block.positions) p = p * 8;
    for (const Mesh& mesh : {terrain, block})
        for (const auto& [stage, options] : {std::pair{"split", "midpoint"},
                                             {"split", "{method: bisect, max_edge: 0.7}"},
                                             {"relax", "2"},
                                             {"clean", "{}"}}) {
            CAPTURE(stage, options);
            check_same(run_stage(stage, options, scene_of(mesh)).scene,
                       run_stage(stage, options, scene_of(at_far(mesh))).scene);
        }
    const auto area_at = [&](const Mesh& mesh, const char* plane) {
        return run_stage("section", plane, scene_of(mesh)).record.result["area"].get<double>();
    };
    CHECK(area_at(at_far(block), "{plane: {normal: [0, 0, 1], through: [500001, 5200002, 401]}}") ==
          Approx(area_at(block, "{plane: {normal: [0, 0, 1], through: [0, 0, 2]}}")));
}
