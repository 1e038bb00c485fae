#include "support/cells.hpp"

#include <algorithm>
#include <tuple>

namespace facetmill::test {

Mesh rejoined(const cells::Partition& partition) {
    std::vector<cells::Cell> all;
    for (std::uint32_t leaf = 0; leaf < partition.tree().leaves.size(); ++leaf)
        all.push_back(partition.cell(leaf));
    return cells::joined(std::move(all), 0).mesh;
}

std::vector<std::array<double, 9>> triangles_of(const Mesh& mesh) {
    std::vector<std::array<double, 9>> all;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Index low = 3 * f;
        const auto before = [&](Index a, Index b) {
            const Vec3 &p = mesh.point(a), &q = mesh.point(b);
            return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
        };
        for (Index c = 3 * f; c < 3 * f + 3; ++c)
            if (before(c, low)) low = c;
        std::array<double, 9> triangle{};
        for (std::size_t i = 0; i < 9; ++i)
            triangle[i] = mesh.point(3 * f + (low % 3 + static_cast<Index>(i / 3)) % 3)[i % 3];
        all.push_back(triangle);
    }
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace facetmill::test
