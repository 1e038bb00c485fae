// Compares our polygon algorithms with CGAL's on small integer polygons, where every degeneracy occurs.
#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/polygon/polygon.hpp"
#include "oracle/cgal_oracle.hpp"

#include <algorithm>
#include <array>

using namespace facetmill;
using namespace facetmill::polygon;

namespace {

std::vector<Vec2> lattice_polygon(std::uint64_t seed) {
    std::vector<Vec2> ring;
    const auto n = 3 + hashed(seed, 0) % 5;
    for (std::uint64_t i = 0; i < n; ++i)
        ring.push_back({static_cast<double>(hashed(seed, 2 * i + 1) % 6),
                        static_cast<double>(hashed(seed, 2 * i + 2) % 6)});
    return ring;
}

PointLocation place_of(int side, const Vec2& p, const std::vector<Vec2>& ring) {
    if (side > 0) return PointLocation::inside;
    if (side < 0) return PointLocation::outside;
    return std::find(ring.begin(), ring.end(), p) != ring.end() ? PointLocation::on_vertex
                                                                : PointLocation::on_edge;
}

} // namespace

TEST_CASE("polygons agree with CGAL", "[geometry]") {
    int simple = 0, disagreements = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        const auto ring = lattice_polygon(seed);
        const oracle::Polygon theirs(ring);
        disagreements += signed_area(ring) != theirs.area();
        const bool is_simple = theirs.is_simple();
        disagreements += is_simple != (contact(std::array{Ring(ring)}) == Contact::none);
        if (!is_simple) continue;
        ++simple;
        disagreements += is_convex(ring) != theirs.is_convex();
        disagreements += orientation(ring) != theirs.orientation();
        for (double x = -0.5; x < 6; x += 0.5)
            for (double y = -0.5; y < 6; y += 0.5)
                disagreements += locate({x, y}, ring) != place_of(theirs.side({x, y}), {x, y}, ring);
    }
    CHECK(disagreements == 0);
    CHECK(simple > 500);
}
