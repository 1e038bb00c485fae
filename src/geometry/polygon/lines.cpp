#include "base/error.hpp"
#include "base/math/predicates.hpp"
#include "geometry/polygon/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::polygon {

namespace {

struct Crossing {
    std::int64_t line;
    double at; ///< position along the line
    int turn;  ///< the change of the winding number; 0: the surrounding frame begins or ends
};

Box bounds_of(Rings rings) {
    Box box;
    for (const Ring ring : rings)
        for (const Vec2& p : ring) box.add(Vec3{p.x, p.y, 0});
    return box;
}

/// The first line at or above a height.
std::int64_t line_above(double height, double spacing) {
    auto k = static_cast<std::int64_t>(std::ceil(height / spacing));
    while (static_cast<double>(k) * spacing < height) ++k;
    while (static_cast<double>(k - 1) * spacing >= height) --k;
    return k;
}

/// Crossings of the hatch lines with a ring. A corner's height is computed once and belongs to only one side,
/// so every line crosses every ring upwards as often as downwards.
void cross_ring(Ring ring, const HatchSettings& s, bool frame, std::vector<Crossing>& out) {
    const Vec2 across{-s.direction.y, s.direction.x};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[i + 1 == ring.size() ? 0 : i + 1];
        const double ha = dot(a, across), hb = dot(b, across), low = std::min(ha, hb),
                     high = std::max(ha, hb);
        if (low == high) continue;
        const double sa = dot(a, s.direction), sb = dot(b, s.direction);
        const auto end = line_above(high, s.spacing);
        for (auto k = line_above(low, s.spacing); k < end; ++k) {
            const double t = (static_cast<double>(k) * s.spacing - ha) / (hb - ha);
            out.push_back({k, sa * (1 - t) + sb * t, frame ? 0 : ha < hb ? -1 : 1});
        }
    }
}

void check_limit(const Box& box, const HatchSettings& s) {
    const double lines = box.diagonal() / s.spacing;
    if (!(lines <= static_cast<double>(s.limit)))
        throw Error(ErrorKind::limit, "E-HATCH",
                    fmt::format("hatching would take about {:.0f} lines, but at most {} are possible", lines,
                                s.limit),
                    "choose a larger spacing");
    constexpr double whole = 0x1p52; // lines are counted from the origin
    if (!(std::max(length(box.min), length(box.max)) < whole * s.spacing))
        throw Error(ErrorKind::limit, "E-HATCH",
                    "the outline is too far from the origin for lines at this spacing",
                    "choose a larger spacing, or use transform: {centre: true} first");
}

/// The segments between crossings whose winding number is kept, sorted by line and position. Segments run
/// along the line's direction; on odd lines, they run backward.
std::vector<Segment> kept_segments(const std::vector<Crossing>& crossings, const HatchSettings& s) {
    const Vec2 across{-s.direction.y, s.direction.x};
    std::vector<Segment> segments;
    int winding = 0;
    bool framed = false, goes_on = false;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        const auto& [line, from, turn] = crossings[i];
        const double to = crossings[i + 1].at;
        winding += turn;
        framed ^= turn == 0;
        const bool kept = s.keep == Keep::inside ? winding != 0 : framed && winding == 0;
        if (kept && from == to) continue; // skips coincident corners and edges
        if (kept) {
            const Vec2 foot = across * (static_cast<double>(line) * s.spacing);
            const Vec2 begin = foot + s.direction * from, end = foot + s.direction * to;
            const bool back = line % 2 != 0;
            if (!goes_on)
                segments.push_back(back ? Segment{end, begin} : Segment{begin, end});
            else
                (back ? segments.back().a : segments.back().b) = end;
        }
        goes_on = kept;
    }
    return segments;
}

} // namespace

std::vector<Segment> hatch(Rings rings, const HatchSettings& s) {
    const Box box = bounds_of(rings);
    if (box.empty()) return {};
    check_limit(box, s);
    std::vector<Crossing> crossings;
    for (const Ring ring : rings) cross_ring(ring, s, false, crossings);
    if (s.keep ==
        Keep::outside) { // the surrounding frame, so that the region between it and the outline is inside
        const double w = s.spacing;
        const std::array frame{Vec2{box.min.x - w, box.min.y - w}, Vec2{box.max.x + w, box.min.y - w},
                               Vec2{box.max.x + w, box.max.y + w}, Vec2{box.min.x - w, box.max.y + w}};
        cross_ring(frame, s, true, crossings);
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.line != b.line ? a.line < b.line : a.at != b.at ? a.at < b.at : a.turn < b.turn;
    });
    const Vec2 across{-s.direction.y, s.direction.x};
    std::vector<Segment> segments = kept_segments(crossings, s);
    // Like a pen that moves back and forth, odd lines are drawn from their far end.
    for (std::size_t i = 0; i < segments.size();) {
        std::size_t end = i;
        const auto height = [&](const Segment& g) { return std::llround(dot(g.a, across) / s.spacing); };
        while (end < segments.size() && height(segments[end]) == height(segments[i])) ++end;
        if (height(segments[i]) % 2 != 0)
            std::reverse(segments.begin() + static_cast<std::ptrdiff_t>(i),
                         segments.begin() + static_cast<std::ptrdiff_t>(end));
        i = end;
    }
    return segments;
}

} // namespace facetmill::polygon
