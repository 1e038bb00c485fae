#include "geometry/crop/piece_tree.hpp"

#include "support/catch.hpp"

using namespace facetmill;

namespace {

using Bounds = PieceTree::Bounds;

/// A strip from a to b, of the wedges a and b.
Bounds strip(Index a, Index b) { return {static_cast<double>(a), 0, static_cast<double>(b), 1}; }

std::vector<Index> pieces_in_order(const PieceTree& tree, Index face) {
    std::vector<Index> pieces;
    tree.for_pieces(face, [&](Index p) { pieces.push_back(p); });
    return pieces;
}

} // namespace

TEST_CASE("pieces stay in order, and are found, however one-sided the cuts are", "[geometry]") {
    constexpr Index last = 5000;
    for (const bool from_left : {true, false}) {
        PieceTree tree;
        tree.add_face({7}, strip(0, 1));
        tree.add_face({0, last}, strip(0, last));
        Index left = 0, right = last, rest = 1;
        while (right - left > 1) { // removes a strip at one end
            const Index middle = from_left ? left + 1 : right - 1;
            const std::vector<Bounds> boxes{strip(left, middle), strip(middle, right)};
            std::vector<std::vector<Index>> parts{{left, middle}, {middle, right}};
            tree.replace(rest, parts, boxes);
            CHECK(tree[rest].wedges == std::vector<Index>{left, middle}); // the first has its number
            (from_left ? left : right) = middle;
            const auto pieces = pieces_in_order(tree, 1);
            rest = from_left ? pieces.back() : pieces.front();
            if (middle % 500 != 0) continue;
            REQUIRE(tree[rest].wedges == std::vector<Index>{left, right});
        }
        const auto pieces = pieces_in_order(tree, 1);
        REQUIRE(pieces.size() == last);
        for (Index i = 0; i < last; ++i) REQUIRE(tree[pieces[i]].wedges == std::vector<Index>{i, i + 1});
        std::vector<Index> found;
        tree.query(1, {100.5, 0.25, 101.5, 0.75}, [&](Index p) { found.push_back(tree[p].wedges[0]); });
        CHECK(found == std::vector<Index>{100, 101});
        CHECK(pieces_in_order(tree, 0) == std::vector<Index>{0});
    }
}

TEST_CASE("a piece that is nothing any more is gone, one that reaches farther is found there", "[geometry]") {
    PieceTree tree;
    tree.add_face({0, 4}, strip(0, 4));
    const std::vector<Bounds> boxes{strip(0, 2), strip(2, 4)};
    std::vector<std::vector<Index>> parts{{0, 2}, {2, 4}};
    tree.replace(0, parts, boxes);
    CHECK(pieces_in_order(tree, 0) == std::vector<Index>{0, 1});
    CHECK(tree.numbers() == 2);
    tree.reshape(1, {2, 4, 9}, strip(2, 9));
    std::vector<Index> found;
    tree.query(0, strip(8, 9), [&](Index p) { found.push_back(p); });
    CHECK(found == std::vector<Index>{1});
    std::vector<std::vector<Index>> larger{{2, 3}, {3, 4, 9}};
    const std::vector<Bounds> their_boxes{strip(2, 3), strip(3, 9)};
    tree.replace(1, larger, their_boxes);
    CHECK(pieces_in_order(tree, 0) == std::vector<Index>{0, 2, 1}); // the larger has the number
    tree.replace(2, {}, {});
    tree.replace(0, {}, {});
    CHECK(tree[0].node == none);
    CHECK(pieces_in_order(tree, 0) == std::vector<Index>{1});
    tree.replace(1, {}, {});
    CHECK(pieces_in_order(tree, 0).empty());
}
