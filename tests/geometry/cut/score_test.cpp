#include "geometry/cut/score.hpp"

#include "geometry/cut/cut.hpp"
#include "support/catch.hpp"

using namespace facetmill;

TEST_CASE("an edge without length in the plane goes to one piece only", "[geometry]") {
    Mesh pillow; // a pentagon with two corners at the same position, and its back
    pillow.positions = {{-1, 0, 0}, {0, -1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}};
    pillow.corners = {0, 1, 2, 3, 4, 4, 3, 2, 1, 0};
    pillow.face_offsets = {0, 5, 10};
    REQUIRE(is_closed(pillow));
    for (const std::vector<std::uint8_t>& faces : {std::vector<std::uint8_t>{1, 0}, {0, 1}, {1, 1}}) {
        ScoreSettings settings;
        settings.plane = {{1, 0, 0}, {}, 0};
        settings.faces = faces;
        CutMemory memory;
        const ScoreResult scored = score(pillow, settings, memory);
        CHECK(scored.cut_faces == static_cast<std::size_t>(faces[0] + faces[1]));
        CHECK(is_closed(scored.mesh));
    }
}
