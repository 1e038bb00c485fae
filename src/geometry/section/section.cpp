#include "geometry/section/section.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "geometry/section/cut.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr Index open_end = none;

/// Joins the pieces of a plane to contours.
class Chainer {
  public:
    Chainer(std::span<const Piece> pieces, Section& out) : pieces_(pieces), out_(out) {}

    /// place(key): the point in the section's frame where the plane crosses an edge.
    template <class Place>
    void run(Place&& place) {
        match(place);
        std::vector<char> done(pieces_.size());
        for (Index e = 0; e < 2 * pieces_.size(); ++e) // starts with the loose ends
            if (partner_[e] == open_end && !done[e / 2]) walk(e, done, true);
        for (Index e = 0; e < 2 * pieces_.size(); e += 2)
            if (!done[e / 2]) walk(e, done, false);
    }

  private:
    /// End e belongs to piece e / 2; even ends are where pieces start.
    EdgeKey key_of(Index e) const { return e % 2 == 0 ? pieces_[e / 2].from : pieces_[e / 2].to; }

    template <class Place>
    void match(Place&& place) {
        struct End {
            std::uint64_t key;
            Index end;
        };
        std::vector<End> ends(2 * pieces_.size());
        for (Index e = 0; e < ends.size(); ++e) ends[e] = {key_of(e).bits(), e};
        std::sort(ends.begin(), ends.end(),
                  [](const End& a, const End& b) { return a.key != b.key ? a.key < b.key : a.end < b.end; });
        partner_.assign(ends.size(), open_end);
        point_.resize(ends.size());
        std::vector<Index> starts, stops, rest;
        for (std::size_t i = 0; i < ends.size();) {
            starts.clear();
            stops.clear();
            const Vec2 p = place(key_of(ends[i].end));
            const auto key = ends[i].key;
            for (; i < ends.size() && ends[i].key == key; ++i) {
                (ends[i].end % 2 == 0 ? starts : stops).push_back(ends[i].end);
                point_[ends[i].end] = p;
            }
            join(starts, stops, rest);
        }
    }

    /// If faces agree, every piece that stops meets a piece that starts. Remaining ends are joined anyway.
    void join(const std::vector<Index>& starts, const std::vector<Index>& stops, std::vector<Index>& rest) {
        const std::size_t both = std::min(starts.size(), stops.size());
        for (std::size_t i = 0; i < both; ++i) {
            partner_[starts[i]] = stops[i];
            partner_[stops[i]] = starts[i];
        }
        rest.assign(starts.begin() + static_cast<std::ptrdiff_t>(both), starts.end());
        rest.insert(rest.end(), stops.begin() + static_cast<std::ptrdiff_t>(both), stops.end());
        for (std::size_t i = 0; i + 1 < rest.size(); i += 2) {
            partner_[rest[i]] = rest[i + 1];
            partner_[rest[i + 1]] = rest[i];
            out_.oriented = false;
        }
    }

    void walk(Index entered, std::vector<char>& done, bool open) {
        Contour c;
        c.begin = static_cast<Index>(out_.points.size());
        c.role = open ? ContourRole::open : ContourRole::outline;
        while (entered != open_end && !done[entered / 2]) {
            done[entered / 2] = 1;
            out_.points.push_back(point_[entered]);
            const Index left = entered ^ 1U;
            entered = partner_[left];
            if (entered == open_end) out_.points.push_back(point_[left]);
        }
        c.end = static_cast<Index>(out_.points.size());
        out_.contours.push_back(c);
    }

    std::span<const Piece> pieces_;
    Section& out_;
    std::vector<Index> partner_;
    std::vector<Vec2> point_;
};

double magnitude(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// Removes points of a contour that coincide with a neighbour or are straight, up to rounding. Returns the
/// new end.
Index straighten(std::vector<Vec2>& points, Contour& c, Index to, double rounding) {
    const auto near = [&](const Vec2& a, const Vec2& b) {
        return std::abs(a.x - b.x) <= rounding && std::abs(a.y - b.y) <= rounding;
    };
    const auto straight = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
        return dot(b - a, c - b) > 0 && std::abs(cross(b - a, c - a)) <= rounding * length(c - a);
    };
    const Index begin = to;
    for (Index i = c.begin; i < c.end; ++i) {
        const Vec2 p = points[i];
        if (to > begin && near(points[to - 1], p)) continue;
        if (to > begin + 1 && straight(points[to - 2], points[to - 1], p)) --to;
        points[to++] = p;
    }
    if (c.role != ContourRole::open) { // wraps around the end of the contour
        while (to > begin + 1 && near(points[to - 1], points[begin])) --to;
        while (to > begin + 2 && straight(points[to - 2], points[to - 1], points[begin])) --to;
        if (to > begin + 2 && straight(points[to - 1], points[begin], points[begin + 1]))
            points[begin] = points[--to];
    }
    c.begin = begin;
    c.end = to;
    return to;
}

/// Whether a closed contour has winding number 0 everywhere. Zero area alone does not prove it, because
/// opposite windings cancel.
bool is_collapsed(polygon::Ring ring) {
    if (ring.size() < 3) return true;
    if (polygon::orientation(ring) != 0) return false;
    const polygon::WindingRange range = polygon::winding_range(polygon::Rings(&ring, 1));
    return range.min == 0 && range.max == 0;
}

/// Straightens all contours. Drops and counts contours that shrink to a point or a line.
void tidy(Section& s, double rounding) {
    Index to = 0;
    std::size_t kept = 0;
    for (Contour c : s.contours) {
        const Index end = straighten(s.points, c, to, rounding);
        const bool open = c.role == ContourRole::open;
        if (open ? end - c.begin < 2U : is_collapsed(s.ring(c))) {
            ++s.collapsed;
            continue;
        }
        to = end;
        s.contours[kept++] = c;
    }
    s.contours.resize(kept);
    s.points.resize(to);
}

} // namespace

const char* to_string(ContourRole role) {
    constexpr const char* names[] = {"outline", "hole", "inner", "open"};
    return names[static_cast<int>(role)];
}

SectionFrame frame_of(const Plane& plane) {
    check_plane(plane);
    // Scaled first, so that any length of the normal is accepted.
    const Vec3 n = normalised(plane.normal / magnitude(plane.normal));
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[axis])) axis = i;
    Vec3 u;
    u[(axis + 1) % 3] = 1;
    u = normalised(u - n * dot(u, n));
    // The distance of the plane from the origin along n.
    const double away = dot(n, plane.through) - plane.offset / length(plane.normal);
    return {n * away, u, cross(n, u), n};
}

std::vector<polygon::Ring> Section::filled() const {
    std::vector<polygon::Ring> rings;
    for (const Contour& c : contours)
        if (c.role == ContourRole::outline || c.role == ContourRole::hole) rings.push_back(ring(c));
    return rings;
}

std::size_t Section::inside_out() const {
    return static_cast<std::size_t>(std::count_if(contours.begin(), contours.end(), [](const Contour& c) {
        return c.role == ContourRole::outline && c.orientation < 0;
    }));
}

std::vector<Section> section(const Mesh& mesh, const SectionSettings& settings) {
    const SectionFrame frame = frame_of(settings.plane);
    const StackPlanes stack(settings);
    auto pieces = pieces_of(mesh, stack, pulled_back(settings.plane, settings.to_world));
    if (settings.to_world.determinant() <
        0) // a mirrored part: its faces are reversed, so that fronts stay fronts
        parallel_for(pieces.size(), [&](std::size_t i) { std::swap(pieces[i].from, pieces[i].to); });
    std::vector<Section> sections(stack.size());
    ProgressScope::report_next_loop();
    parallel_for(
        sections.size(),
        [&](std::size_t k) {
            Section& s = sections[k];
            s.height = settings.heights[k];
            s.frame = frame;
            s.frame.origin += frame.normal * s.height;
            const auto first =
                std::lower_bound(pieces.begin(), pieces.end(), k,
                                 [](const Piece& p, std::size_t plane) { return p.plane < plane; });
            const auto last =
                std::lower_bound(first, pieces.end(), k + 1,
                                 [](const Piece& p, std::size_t plane) { return p.plane < plane; });
            double largest = magnitude(s.frame.origin);
            Chainer({first, last}, s).run([&](const EdgeKey& e) {
                const Vec3 &a = mesh.positions[e.low], &b = mesh.positions[e.high];
                const double sa = stack.side_of(k, a), sb = stack.side_of(k, b);
                const Vec3 p = settings.to_world.point(sa == 0 ? a : sb == 0 ? b : mix(a, b, sa / (sa - sb)));
                largest = std::max(largest, magnitude(p));
                return s.frame.flat(p);
            });
            tidy(s, 64 * 2.220446049250313e-16 * largest);
            arrange(s);
        },
        1);
    return sections;
}

Extent extent_along(const Plane& plane, const Mesh& mesh, const Transform& to_world) {
    const double scale = length(plane.normal);
    return parallel_reduce(
        mesh.positions.size(), Extent{},
        [&](std::size_t begin, std::size_t end) {
            Extent e;
            for (std::size_t i = begin; i < end; ++i) {
                const double h = side(plane, to_world.point(mesh.positions[i])) / scale;
                e.add({h, h});
            }
            return e;
        },
        [](Extent a, const Extent& b) {
            a.add(b);
            return a;
        });
}

Stack stack_of(const Extent& extent, std::optional<double> spacing, std::optional<std::int64_t> count) {
    Stack stack{{}, spacing.value_or(0)};
    double first = 0, planes = count ? static_cast<double>(*count) : 0;
    if (!(extent.low <= extent.high)) {
        planes = spacing ? planes : 0;
    } else if (!count) {
        first = std::ceil(extent.low / stack.spacing);
        planes = std::floor(extent.high / stack.spacing) - first + 1;
        first *= stack.spacing;
    } else if (!spacing) {
        stack.spacing = (extent.high - extent.low) / planes;
        first = extent.low + stack.spacing / 2;
        if (!(stack.spacing > 0)) planes = 0;
    }
    if (planes > static_cast<double>(max_planes))
        throw Error(ErrorKind::limit, "E-SECTION",
                    fmt::format("the stack would have {:.0f} planes, but at most {} are possible", planes,
                                max_planes),
                    "choose a larger spacing");
    for (std::int64_t i = 0; static_cast<double>(i) < planes; ++i)
        stack.heights.push_back(first + static_cast<double>(i) * stack.spacing);
    return stack;
}

} // namespace facetmill
