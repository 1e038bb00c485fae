#include "diff/line_shape.hpp"

#include "mesh/lines.hpp"

namespace facetmill::report {

namespace {

void add_without_area(Surface& to, const Vec3& a, const Vec3& b) {
    const auto first = static_cast<Index>(to.positions.size());
    to.positions.insert(to.positions.end(), {a, b});
    to.corners.insert(to.corners.end(), {first, first + 1, first + 1});
}

} // namespace

LineShape::LineShape(const Scene& scene, std::optional<Index> material) {
    for (const Part& part : scene.parts) {
        const Lines own = lines_of(part);
        for (const auto& segment : own.segments) {
            if (material && segment.material != *material) continue;
            const Vec3 &a = own.points[segment.from], &b = own.points[segment.to];
            add_without_area(lines, a, b);
            for (const Vec3& p : {a, (a + b) * 0.5, b}) add_without_area(points, p, p);
        }
    }
}

double LineShape::distance_to(const LineShape& other) const {
    return lines.size() == 0 ? 0 : deviation_to(points, FaceTree(other.lines)).maximum;
}

} // namespace facetmill::report
