#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/render/canvas.hpp"

#include <cmath>
#include <vector>

using namespace facetmill;

TEST_CASE("a triangle has the samples that its three edges say, however thin or large it is", "[geometry]") {
    const SampleBox box{0, 119, 0, 79};
    std::size_t seen = 0, thin = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const std::uint64_t j = i / 3;
        const double size =
            std::pow(10.0, static_cast<double>(j % 5 < 4 ? j % 4 : j / 5 % 16)); // also far outside
        std::array<Vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = {60 + size * (uniform(hashed(i, 2 * k)) - 0.5),
                    40 + size * (uniform(hashed(i, 2 * k + 1)) - 0.5), 0};
        if (i % 3 == 1)
            p[2] = p[0] + (p[1] - p[0]) * 0.3 + Vec3{0, 0.1 * uniform(hashed(i, 9)), 0};      // a sliver
        if (i % 3 == 2) p[i % 9 / 3].y = p[(i % 9 / 3 + 1) % 3].y = std::floor(p[0].y) + 0.5; // along a row
        const CanvasTriangle t(p);
        if (!t.drawn()) continue;
        std::vector<std::pair<int, int>> wanted, visited;
        const double side = t.area > 0 ? 1 : -1;
        for (int y = box.top; y <= box.bottom; ++y)
            for (int x = box.left; x <= box.right; ++x)
                if (t.edges[0].of(x + 0.5, y + 0.5) * side >= 0 &&
                    t.edges[1].of(x + 0.5, y + 0.5) * side >= 0 &&
                    t.edges[2].of(x + 0.5, y + 0.5) * side >= 0)
                    wanted.emplace_back(x, y);
        for_each_sample(t, true, box, [&](int x, int y, double) { visited.emplace_back(x, y); });
        REQUIRE(visited == wanted);
        seen += wanted.empty() ? 0 : 1;
        thin += i % 3 == 1 && !wanted.empty() ? 1 : 0;
    }
    CHECK(seen > 1000);
    CHECK(thin > 100);
}
