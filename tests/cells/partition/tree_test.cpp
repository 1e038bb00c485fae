#include "cells/partition/tree.hpp"

#include "support/catch.hpp"
#include "support/meshes.hpp"

#include <map>

using namespace facetmill;
using namespace facetmill::cells;

TEST_CASE("the tree halves counts until none is above the most", "[cells]") {
    Box box;
    std::vector<Vec3> points;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        Vec3 p = test::random_point(1, 5, i);
        p.x = p.x * p.x * p.x; // denser in the middle
        points.push_back(p);
        box.add(p);
    }
    Grid grid(box, 128);
    for (const Vec3& p : points) grid.count(grid.cell_of(p));
    const Tree tree = grid.split(300);
    std::map<std::uint32_t, std::size_t> counts;
    for (const Vec3& p : points) ++counts[grid.leaf_of(grid.cell_of(p))];
    CHECK(counts.size() == tree.leaves.size());
    for (const auto& [leaf, count] : counts) {
        CHECK(count <= 300);
        CHECK(count >= 75); // halves of halves
    }
    for (std::uint32_t n = 0; n < tree.nodes.size(); ++n)
        if (!tree.nodes[n].is_leaf())
            for (const std::uint32_t child : tree.nodes[n].child) {
                CHECK(tree.nodes[child].parent == n);
                CHECK(tree.nodes[child].depth == tree.nodes[n].depth + 1);
            }
    const auto last = static_cast<std::uint32_t>(tree.leaves.size() - 1);
    CHECK(tree.common_depth(0, last) == 0);
    Tree again;
    REQUIRE(again.restore(tree.depths()));
    CHECK(again.leaves == tree.leaves);
    REQUIRE(again.nodes.size() == tree.nodes.size());
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
        CHECK(again.nodes[n].child[0] == tree.nodes[n].child[0]);
        CHECK(again.nodes[n].child[1] == tree.nodes[n].child[1]);
        CHECK(again.nodes[n].parent == tree.nodes[n].parent);
    }
    for (const std::vector<std::uint8_t>& none_of_a_tree :
         {std::vector<std::uint8_t>{}, {1}, {1, 1, 1}, {1, 2}, {2, 1, 1}, {0, 0}})
        CHECK_FALSE(again.restore(none_of_a_tree));
    CHECK(tree.common_depth(1, 1) == tree.nodes[tree.leaves[1]].depth);
}

TEST_CASE("a grid over nothing, over a point and over infinity has one leaf or some", "[cells]") {
    Box point;
    point.add(Vec3{1, 2, 3});
    Grid grid(point, 128);
    for (int i = 0; i < 10; ++i) grid.count(grid.cell_of({1, 2, 3}));
    CHECK(grid.split(2).leaves.size() == 1);
    Box huge;
    huge.add(Vec3{-1e308, 0, 0});
    huge.add(Vec3{1e308, 1, 0});
    Grid wide(huge, 128);
    wide.count(wide.cell_of({-1e308, 0, 0}));
    wide.count(wide.cell_of({1e308, 1, 0}));
    CHECK(wide.split(1).leaves.size() <= 2);
}

TEST_CASE("more faces than a count holds are still very many", "[cells]") {
    Box box;
    box.add(Vec3{0, 0, 0});
    box.add(Vec3{2, 1, 1});
    Grid grid(box, 2);
    grid.count(grid.cell_of({0.5, 0.5, 0.5}), UINT32_MAX);
    grid.count(grid.cell_of({0.5, 0.5, 0.5}), 5);
    grid.count(grid.cell_of({1.5, 0.5, 0.5}), 3);
    CHECK(grid.split(10).leaves.size() == 2);
}
