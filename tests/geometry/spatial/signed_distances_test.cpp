#include "geometry/spatial/signed_distances.hpp"
#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"

#include <limits>

using namespace facetmill;

TEST_CASE("signed distances are negative inside, and 0 where there is nothing to measure", "[geometry]") {
    const FaceTree tree(surface_of(shapes::cube()), FaceTree::Use::near);
    const std::vector<Vec3> points{
        {0.5, 0.5, 1.25}, {0.5, 0.5, 0.9}, {0.5, 0.5, 1}, {std::numeric_limits<double>::infinity(), 0, 0}};
    const std::vector<float> found = signed_distances(tree, points);
    CHECK(found == std::vector<float>{0.25f, -0.1f, 0, 0});
    CHECK(signed_distances(FaceTree(Surface{}, FaceTree::Use::near), points) == std::vector<float>(4));
}
