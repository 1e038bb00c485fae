#include "geometry/crop/pieces_at_edges.hpp"

#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("pieces are found at the edges that they were added for, either way round", "[geometry]") {
    PiecesAtEdges at_edges;
    constexpr Index count = 3000; // the table grows
    for (Index piece = 0; piece < count; ++piece)
        for (const Index beyond : {piece + 1, piece + 2}) at_edges.add(beyond, piece, piece);
    at_edges.add(7, 8, count);
    const auto at = [&](Index u, Index v) {
        std::vector<Index> pieces;
        at_edges.visit(u, v, [&](Index piece) { pieces.push_back(piece); });
        return pieces;
    };
    for (Index piece = 0; piece < count; ++piece) {
        if (piece == 7) continue;
        REQUIRE(at(piece, piece + 1) == std::vector<Index>{piece});
        REQUIRE(at(piece + 2, piece) == std::vector<Index>{piece});
    }
    CHECK(at(8, 7) == at(7, 8));
    CHECK(at(7, 8).size() == 2);
    CHECK(at(0, 3).empty());
}
