#include "io/drawing/drawing.hpp"

#include <cmath>

namespace facetmill::io {

namespace {

/// The direction of a profile: level, in the plane, and mostly toward +x or +y (+x or +z if y is up).
Vec3 direction_of_profile(const Vec3& normal, const Vec3& up) {
    const Vec3 along = normalised(cross(up, normal));
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (std::fabs(along[k]) > std::fabs(along[longest])) longest = k;
    return along[longest] < 0 ? -along : along;
}

} // namespace

Paper::Paper(const Drawing& drawing) : layout_(drawing.layout) {
    if (drawing.up == UpAxis::y) up_ = {0, 1, 0};
    if (layout_.kind == DrawingLayout::Kind::profile && !drawing.sheets.empty())
        right_ = direction_of_profile(drawing.sheets[0].frame.normal, up_);
    const auto add = [&](const Sheet& sheet, const Vec2& p) {
        const Vec2 q = at(sheet, p);
        bounds_.add(Vec3{q.x, q.y, 0});
    };
    for (const auto& sheet : drawing.sheets)
        for (const auto& part : sheet.parts) {
            for (const Vec2& p : part.section.points) add(sheet, p);
            for (const auto& s : part.hatch) {
                add(sheet, s.a);
                add(sheet, s.b);
            }
        }
    if (layout_.kind != DrawingLayout::Kind::profile || bounds_.empty()) return;
    start_ = bounds_.min.x;
    bounds_.max.x -= start_;
    bounds_.min.x = 0;
}

std::optional<double> Paper::elevation(const Sheet& sheet) const {
    const double along = dot(sheet.frame.normal, up_);
    if (std::fabs(along) != 1) return {};
    return dot(sheet.frame.origin, up_) + 0.0;
}

Vec2 Paper::at(const Sheet& sheet, const Vec2& p) const {
    if (layout_.kind == DrawingLayout::Kind::sheets) return p;
    const Vec3 world = sheet.frame.point(p);
    if (layout_.kind == DrawingLayout::Kind::profile)
        return {dot(world, right_) - start_, dot(world, up_) * layout_.exaggeration};
    if (!elevation(sheet)) return p;
    return up_.y == 1 ? Vec2{world.x, -world.z} : Vec2{world.x, world.y};
}

std::vector<Vec2> Paper::at(const Sheet& sheet, polygon::Ring ring) const {
    std::vector<Vec2> points;
    points.reserve(ring.size());
    for (const Vec2& p : ring) points.push_back(at(sheet, p));
    return points;
}

} // namespace facetmill::io
