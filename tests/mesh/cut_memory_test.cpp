#include "support/catch.hpp"

#include "mesh/cut_memory.hpp"

#include <random>

using namespace facetmill;

namespace {

/// One of few planes, in one of the ways to write it, so that many are the same.
Plane drawn_plane(std::mt19937& random) {
    const auto draw = [&](unsigned n) { return static_cast<double>(random() % n); };
    Plane plane;
    const std::size_t axis = random() % 3;
    const double place = random() % 5 ? draw(4) - 1 : (draw(2) - 0.5) * 1e300,
                 length = std::ldexp(1, random() % 3);
    plane.normal = {};
    plane.normal[axis] = random() % 2 ? length : -length;
    plane.through = {draw(3), draw(3), draw(3)};
    plane.through[axis] = 0;
    switch (random() % 4) {
    case 0:
        plane.through[axis] = place;
        break;
    case 1:
        plane.offset = -place * plane.normal[axis];
        break;
    case 2: // half of it each
        plane.through[axis] = place / 2;
        plane.offset = -place / 2 * plane.normal[axis];
        break;
    default: // leans
        plane.normal[(axis + 1) % 3] = length;
        plane.through[axis] = place;
    }
    return plane;
}

} // namespace

TEST_CASE("Planes that are the same are found, however they are written", "[mesh][planes]") {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        std::vector<Plane> planes;
        for (int i = 0; i < 60; ++i) planes.push_back(drawn_plane(random));
        const auto first = first_same_planes(planes);
        for (std::size_t i = 0; i < planes.size(); ++i) {
            std::size_t wanted = 0;
            while (!same_plane(planes[wanted], planes[i])) ++wanted;
            REQUIRE(first[i] == wanted);
        }
    }
}
