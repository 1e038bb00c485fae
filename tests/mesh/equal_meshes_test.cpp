#include "support/catch.hpp"

#include "mesh/equal_meshes.hpp"
#include "mesh/shapes.hpp"

#include <limits>

using namespace facetmill;

TEST_CASE("parts with equal meshes are found, wherever they stand, and others told apart", "[mesh]") {
    Scene scene;
    for (int i = 0; i < 7; ++i) scene.parts.emplace_back().mesh = shapes::icosphere(1);
    scene.parts[1].transform.m[0][3] = 5;
    scene.parts[2].mesh.positions[3].x += 1;
    scene.parts[3].mesh = shapes::cube();
    scene.parts[4].mesh.primitives = {{0, {}, {}}};
    const auto coloured = [&](Part& part, float value) {
        part.mesh.attributes.push_back({"COLOR_0", Domain::vertex, Role::colour, 3, false,
                                        std::vector<float>(3 * part.mesh.vertex_count(), value)});
    };
    coloured(scene.parts[5], 0);
    coloured(scene.parts[6], 1);
    CHECK(DistinctParts(scene).first == std::vector<std::size_t>{0, 0, 2, 3, 4, 5, 6});
    coloured(scene.parts[1], 1);
    scene.parts[2] = scene.parts[1];
    CHECK(DistinctParts(scene).first == std::vector<std::size_t>{0, 1, 1, 3, 4, 5, 1});
    CHECK(DistinctParts(Scene{}).first.empty());
}

TEST_CASE("parts of one shape differ by a move alone", "[mesh]") {
    Scene scene;
    for (int i = 0; i < 4; ++i) scene.parts.emplace_back().mesh = shapes::cube();
    scene.parts[1].transform.m[0][3] = 5;
    scene.parts[2].transform.m[0][0] = -1; // mirrored
    scene.parts[3].transform = scene.parts[2].transform;
    scene.parts[3].transform.m[2][3] = 1;
    CHECK(distinct_shapes(scene).first == std::vector<std::size_t>{0, 0, 2, 2});
    scene.parts[1].mesh.positions[0].x -= 1;
    CHECK(distinct_shapes(scene).first == std::vector<std::size_t>{0, 1, 2, 2});
}

TEST_CASE("parts that stand nowhere are of no other shape", "[mesh]") {
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    Scene scene;
    for (int i = 0; i < 6; ++i) scene.parts.emplace_back().mesh = shapes::cube();
    scene.parts[1].transform.m[0][0] = nowhere;
    scene.parts[2].transform.m[0][0] = 2;
    scene.parts[3].transform.m[0][0] = nowhere;
    scene.parts[4].transform.m[1][0] = -0.0;
    scene.parts[5].transform.m[2][2] = nowhere;
    CHECK(distinct_shapes(scene).first == std::vector<std::size_t>{0, 1, 2, 1, 0, 5});
}
