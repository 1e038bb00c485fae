#include "geometry/nest/nest.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

struct Placed {
    std::size_t plate;
    double x, y, width, depth;
};

std::vector<Placed> placed(const std::vector<NestRectangle>& r,
                           const std::vector<std::optional<NestPlace>>& p) {
    std::vector<Placed> all;
    for (std::size_t i = 0; i < r.size(); ++i)
        if (p[i])
            all.push_back({p[i]->plate, p[i]->x, p[i]->y, p[i]->turned ? r[i].depth : r[i].width,
                           p[i]->turned ? r[i].width : r[i].depth});
    return all;
}

/// All pairs on the same plate, and the plate's border.
void check_apart(const std::vector<Placed>& all, double width, double depth, double spacing) {
    const double slack = 1e-6;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Placed& a = all[i];
        REQUIRE(a.x >= 0);
        REQUIRE(a.y >= 0);
        REQUIRE(a.x + a.width <= width + slack);
        REQUIRE(a.y + a.depth <= depth + slack);
        for (std::size_t k = 0; k < i; ++k) {
            const Placed& b = all[k];
            if (a.plate != b.plate) continue;
            const double dx = std::max(a.x - (b.x + b.width), b.x - (a.x + a.width));
            const double dy = std::max(a.y - (b.y + b.depth), b.y - (a.y + a.depth));
            REQUIRE(std::max(dx, dy) >= spacing - slack);
        }
    }
}

} // namespace

TEST_CASE("nest fills a plate exactly", "[bed]") {
    // 16 squares of 50 on a plate of 200, and 9 with spacing.
    const std::vector<NestRectangle> squares(16, {50, 50});
    const auto exact = nest(squares, {200, 200, 0, true, 1});
    CHECK(std::all_of(exact.begin(), exact.end(), [](const auto& p) { return p.has_value(); }));
    check_apart(placed(squares, exact), 200, 200, 0);
    const auto spaced = nest(squares, {200, 200, 5, true, SIZE_MAX});
    CHECK(std::count_if(spaced.begin(), spaced.end(), [](const auto& p) { return p->plate == 0; }) == 9);
    check_apart(placed(squares, spaced), 200, 200, 5);
    // A long part must turn.
    const std::vector<NestRectangle> bar{{10, 190}};
    CHECK(nest(bar, {200, 100, 0, true, 1})[0]->turned);
    CHECK(!nest(bar, {200, 100, 0, false, 1})[0]);
}

TEST_CASE("nest keeps rectangles apart", "[bed]") {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        std::vector<NestRectangle> all;
        for (std::uint64_t i = 0; i < 120; ++i)
            all.push_back({test::between(2, 60, seed, 2 * i), test::between(2, 60, seed, 2 * i + 1)});
        const NestSettings settings{200, 150, 3, true, SIZE_MAX};
        const auto places = nest(all, settings);
        const auto where = placed(all, places);
        REQUIRE(where.size() == all.size());
        check_apart(where, 200, 150, 3);
        double area = 0;
        std::size_t plates = 0;
        for (const Placed& p : where) {
            area += (p.width + 3) * (p.depth + 3);
            plates = std::max(plates, p.plate + 1);
        }
        CHECK(static_cast<double>(plates) <= 1 + area / (0.7 * 203 * 153)); // the plates are well filled
    }
}
