#include "diff/line_shape.hpp"

#include "mesh/lines.hpp"

namespace facetmill::report {

namespace {

void add_without_area(Surface& to, const Vec3& a, const Vec3& b) {
    const auto first = static_cast<Index>(to.positions.size());
    to.positions.insert(to.positions.end(), {a, b});
    to.corners.insert(to.corners.end(), {first, first + 1, first + 1});
}

/// Calls add(a, b, material) for each line, in the order of parts and lines.
template <class Add>
void for_each_line(const Scene& scene, Add&& add) {
    for (const Part& part : scene.parts) {
        const Lines own = lines_of(part);
        for (const auto& segment : own.segments)
            add(own.points[segment.from], own.points[segment.to], segment.material);
    }
}

} // namespace

LineShape::LineShape(const Scene& scene) {
    for_each_line(scene, [&](const Vec3& a, const Vec3& b, Index) { add(a, b); });
}

void LineShape::add(const Vec3& a, const Vec3& b) {
    add_without_area(lines, a, b);
    for (const Vec3& p : {a, (a + b) * 0.5, b}) add_without_area(points, p, p);
}

double LineShape::distance_to(const LineShape& other) const {
    return lines.size() == 0 ? 0 : deviation_to(points, FaceTree(other.lines)).maximum;
}

std::map<Index, LineShape> lines_by_material(const Scene& scene) {
    std::map<Index, LineShape> all;
    for_each_line(scene, [&](const Vec3& a, const Vec3& b, Index material) { all[material].add(a, b); });
    return all;
}

} // namespace facetmill::report
