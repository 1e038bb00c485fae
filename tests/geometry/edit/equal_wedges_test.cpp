#include "geometry/edit/equal_wedges.hpp"

#include "base/math/random.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

/// A triangle whose corners have many wedges, with numbers below `values`. -0 and 0 are different.
Mesh of_wedges(std::size_t faces, std::uint64_t values) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<float> numbers;
    for (Index c = 0; c < 3 * faces; ++c) {
        mesh.corners.push_back(c);
        mesh.wedge_vertex.push_back(c % 3);
        const auto number = static_cast<float>(hashed(values, c) % values);
        numbers.push_back(number == 0 && hashed(3, c) % 2 == 0 ? -number : number);
    }
    Attribute own;
    own.name = "_own";
    own.domain = Domain::wedge;
    own.components = 1;
    own.data = std::move(numbers);
    mesh.attributes.push_back(std::move(own));
    return mesh;
}

const std::vector<float>& numbers_of(const Mesh& mesh) {
    return std::get<std::vector<float>>(mesh.attributes.at(0).data);
}

} // namespace

TEST_CASE("wedges of a vertex with the same bits become the first of them", "[geometry]") {
    for (const std::uint64_t values : {1, 3, 31, 32, 40, 1000}) { // few different ones, and many
        INFO(values);
        const Mesh before = of_wedges(200, values);
        Mesh after = before;
        const std::size_t merged = merge_equal_wedges(after);
        CHECK(merged == before.wedge_count() - after.wedge_count());
        // Groups are in the order of their first members, which this test compares one by one.
        std::vector<Index> kept, wedge(before.wedge_count());
        for (Index w = 0; w < before.wedge_count(); ++w) {
            const auto same = [&](Index k) {
                return before.wedge_vertex[k] == before.wedge_vertex[w] &&
                       std::bit_cast<std::uint32_t>(numbers_of(before)[k]) ==
                           std::bit_cast<std::uint32_t>(numbers_of(before)[w]);
            };
            const auto found = std::find_if(kept.begin(), kept.end(), same);
            wedge[w] = static_cast<Index>(found - kept.begin());
            if (found == kept.end()) kept.push_back(w);
        }
        REQUIRE(after.wedge_count() == kept.size());
        CHECK(merged > 0);
        for (std::size_t c = 0; c < before.corners.size(); ++c)
            CHECK(after.corners[c] == wedge[before.corners[c]]);
        for (std::size_t k = 0; k < kept.size(); ++k) {
            CHECK(after.wedge_vertex[k] == before.wedge_vertex[kept[k]]);
            CHECK(numbers_of(after)[k] == numbers_of(before)[kept[k]]);
        }
    }
}
