#include "geometry/pegs/pegs.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/measure.hpp"

using namespace facetmill;

TEST_CASE("pegs keep apart, and the count is a maximum", "[bed]") {
    Mesh cube = shapes::cube();
    for (Vec3& p : cube.positions) p = p * 40;
    TileSettings grid;
    grid.axes = {{0, 20, 0, 2}, {1, 20, 0, 2}, {2, 20, 0, 2}};
    grid.clip.cap = true;
    TileResult r = tile(Mesh(cube), grid);
    REQUIRE(r.tiles.size() == 8);
    PegSettings settings;
    settings.diameter = 2;
    settings.length = 3;
    settings.clearance = 0.1;
    settings.wall = 1;
    settings.count = 50;
    const PegsResult pegs = add_pegs(r.tiles, cube, grid, settings);
    REQUIRE(!pegs.failure);
    CHECK(pegs.without.empty());
    CHECK(pegs.pegs.size() > 24);
    for (std::size_t i = 0; i < pegs.pegs.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (pegs.pegs[i].axis == pegs.pegs[k].axis && pegs.pegs[i].low == pegs.pegs[k].low)
                CHECK(length(pegs.pegs[i].at - pegs.pegs[k].at) >= 2 * 1.1 + 1);
    for (const Tile& t : r.tiles) CHECK(test::closed(t.mesh));
}
