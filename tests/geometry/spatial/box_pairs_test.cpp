#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/intersect/disjoint_triangles.hpp"
#include "geometry/spatial/box_pairs.hpp"

#include <set>

using namespace facetmill;
using test::between;

namespace {

using Pairs = std::set<std::pair<Index, Index>>;

Pairs pairs_of(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& among = {}) {
    const BoxPairs tree(boxes, among);
    std::size_t count = 0;
    const Pairs pairs = tree.reduce(
        Pairs{},
        [&](Pairs& found, std::size_t i, std::size_t j) {
            found.insert(std::minmax(tree.items()[i], tree.items()[j]));
        },
        [&](Pairs a, const Pairs& b) {
            count += b.size();
            a.insert(b.begin(), b.end());
            return a;
        });
    CHECK(count == pairs.size()); // no pair twice
    return pairs;
}

std::vector<Box> random_boxes(std::size_t count, double size, std::uint64_t seed) {
    std::vector<Box> boxes(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 17 == 5) continue; // empty
        Vec3 p, q;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = between(0, 1, seed, 6 * i + k);
            q[k] = p[k] + between(0, size, seed, 6 * i + 3 + k);
        }
        boxes[i].add(p);
        boxes[i].add(q);
    }
    return boxes;
}

bool meet(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(a.min[k] <= b.max[k] && b.min[k] <= a.max[k])) return false;
    return true;
}

Pairs by_trial(const std::vector<Box>& boxes, const std::vector<std::uint8_t>& among = {}) {
    Pairs pairs;
    for (Index i = 0; i < boxes.size(); ++i)
        for (Index j = i + 1; j < boxes.size(); ++j)
            if (meet(boxes[i], boxes[j]) && (among.empty() || among[i] || among[j])) pairs.emplace(i, j);
    return pairs;
}

} // namespace

TEST_CASE("all pairs of boxes that meet are found, each once", "[geometry]") {
    for (const std::size_t count : {0, 1, 2, 3, 4, 5, 17, 700})
        for (const double size : {0.01, 0.1, 0.7}) {
            const auto boxes = random_boxes(count, size, count + 1);
            CHECK(pairs_of(boxes) == by_trial(boxes));
        }
    CHECK(pairs_of(std::vector<Box>(9)).empty());
    const std::vector<Box> same(40, random_boxes(1, 1, 2)[0]);
    CHECK(pairs_of(same).size() == 40 * 39 / 2);
}

TEST_CASE("pairs of boxes among some", "[geometry]") {
    const auto boxes = random_boxes(500, 0.15, 3);
    for (const unsigned every : {1u, 7u, 499u, 1000u}) {
        std::vector<std::uint8_t> among(boxes.size());
        for (std::size_t i = 0; i < among.size(); ++i) among[i] = i % every == every - 1;
        CHECK(pairs_of(boxes, among) == by_trial(boxes, among));
    }
}

TEST_CASE("triangles are surely disjoint only when they are", "[geometry]") {
    using Corners = std::array<Vec3, 3>;
    const Corners a{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
    CHECK(surely_disjoint(a, {{{5, 5, -1}, {6, 5, 1}, {5, 6, 1}}}, 0));  // projected along z
    CHECK(surely_disjoint(a, {{{1, 1, 1}, {2, 1, 1}, {1, 2, 1.5}}}, 0)); // above the plane
    CHECK_FALSE(surely_disjoint(a, {{{1, 1, -1}, {1, 1, 1}, {9, 9, 0}}}, 0));
    CHECK_FALSE(surely_disjoint(a, {{{1, 1, 0}, {2, 1, 5}, {1, 2, 5}}}, 0)); // touches
    CHECK(surely_disjoint(a, {{{0, 0, 0}, {-4, -1, 0}, {-1, -4, 1}}}, 1));   // next to each other
    CHECK(surely_disjoint(a, {{{0, 0, 0}, {4, 1, 1}, {1, 4, 1}}}, 1));       // over each other, rising
    CHECK_FALSE(surely_disjoint(a, {{{0, 0, 0}, {4, 1, 1}, {1, 4, -1}}}, 1));
    CHECK_FALSE(surely_disjoint(a, {{{0, 0, 0}, {1, 1, 0}, {-4, 1, 0}}}, 1));
    CHECK(surely_disjoint(a, {{{0, 0, 0}, {4, 0, 0}, {0, -4, 0}}}, 2));
    CHECK(surely_disjoint(a, {{{0, 0, 0}, {4, 0, 0}, {1, 1, 1}}}, 2));
    CHECK_FALSE(surely_disjoint(a, {{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}}}, 2)); // folded flat
    const Corners tiny{{{0, 0, 0}, {1e-120, 0, 0}, {0, 1e-120, 0}}};
    CHECK_FALSE(surely_disjoint(tiny, {{{0, 0, 1e-120}, {1e-120, 0, 1e-120}, {0, 1e-120, 1e-120}}}, 0));
}

TEST_CASE("pairs of boxes are counted up to a limit", "[geometry]") {
    for (const double size : {0.01, 0.2}) {
        const auto boxes = random_boxes(3000, size, 7);
        std::vector<std::uint8_t> among(boxes.size());
        for (std::size_t i = 0; i < among.size(); i += 3) among[i] = 1;
        for (const auto& flags : {std::vector<std::uint8_t>{}, among}) {
            const BoxPairs tree(boxes, flags);
            const std::size_t all = pairs_of(boxes, flags).size();
            REQUIRE(all > 0);
            for (const std::size_t most :
                 {std::size_t{0}, all / 2, all - 1, all, all + 1, std::size_t{1} << 40})
                CHECK(tree.for_each(most, [](std::size_t, std::size_t) {}) == std::min(all, most + 1));
        }
    }
}
