#include "mesh/cut_memory.hpp"

#include "base/math/random.hpp"
#include "base/math/whole_number.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

namespace facetmill {

namespace {

bool before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

} // namespace

bool CutMemory::Entry::has(const Vec3& point, double side_of_it) const {
    return std::fabs(side_of_it) <= reach && std::binary_search(points.begin(), points.end(), point, before);
}

const CutMemory::Entry* CutMemory::find(const Plane& plane) const {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const Entry& e) { return same_plane(e.plane, plane); });
    return at == entries.end() ? nullptr : &*at;
}

void CutMemory::add(const Plane& plane, std::vector<Vec3> points) {
    const Entry* known = find(plane);
    if (!known) known = &entries.emplace_back(Entry{plane, 0, {}});
    add_to(static_cast<std::size_t>(known - entries.data()), std::move(points));
}

/// Sides are measured against the first notation of the plane.
void CutMemory::add_to(std::size_t entry, std::vector<Vec3> points) {
    Entry& e = entries[entry];
    std::erase_if(points, [&](const Vec3& p) {
        const double s = std::fabs(side(e.plane, p));
        e.reach = std::max(e.reach, s);
        return s == 0;
    });
    points.insert(points.end(), e.points.begin(), e.points.end());
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    e.points = std::move(points);
}

void CutMemory::add_all(std::vector<Entry> more) {
    std::vector<Plane> planes;
    for (const Entry& e : entries) planes.push_back(e.plane);
    for (const Entry& e : more) planes.push_back(e.plane);
    const auto first = first_same_planes(planes);
    std::vector<std::size_t> place(planes.size()); // entry of each plane that is the first of its kind
    const std::size_t old = entries.size();
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (first[i] == i) place[i] = i < old ? i : entries.size();
        if (i < old) continue;
        if (first[i] == i) entries.push_back({planes[i], 0, {}});
        add_to(place[first[i]], std::move(more[i - old].points));
    }
}

namespace {

/// Whether the plane passes through the box, or misses it by no more than rounding.
bool passes(const Plane& plane, const Box& box) {
    const Vec3 middle = box.centre(), half = box.extent() * 0.5;
    double reach = 0, size = std::fabs(plane.offset);
    for (std::size_t i = 0; i < 3; ++i) {
        reach += std::fabs(plane.normal[i]) * half[i];
        size += std::fabs(plane.normal[i]) * (std::fabs(middle[i]) + half[i] + std::fabs(plane.through[i]));
    }
    return !(std::fabs(side(plane, middle)) > reach + 1e-9 * size);
}

/// Finds the points on planes by halving the point set, because few planes pass a small box.
class PointsOnPlanes {
  public:
    PointsOnPlanes(const CutMemory& memory, std::span<const Vec3> points)
        : memory_(memory), points_(points), found_(points.size()) {}

    std::vector<std::vector<std::uint32_t>> run() {
        if (memory_.entries.empty()) return std::move(found_);
        std::vector<std::uint32_t> all(points_.size()), entries(memory_.entries.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
        for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = static_cast<std::uint32_t>(i);
        find(all, entries);
        return std::move(found_);
    }

  private:
    void find(std::span<std::uint32_t> points, const std::vector<std::uint32_t>& entries) {
        Box box;
        for (const auto p : points) box.add(points_[p]);
        std::vector<std::uint32_t> near;
        for (const auto e : entries)
            if (passes(memory_.entries[e].plane, box)) near.push_back(e);
        if (near.empty()) return;
        const Vec3 extent = box.extent();
        const double longest = std::max({extent.x, extent.y, extent.z});
        if (points.size() <= 8 || near.size() <= 2 || longest == 0) return test(points, near);
        const std::size_t axis = longest == extent.x ? 0 : longest == extent.y ? 1 : 2;
        const auto middle = points.begin() + static_cast<std::ptrdiff_t>(points.size() / 2);
        std::nth_element(points.begin(), middle, points.end(), [&](auto a, auto b) {
            return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
        });
        find({points.begin(), middle}, near);
        find({middle, points.end()}, near);
    }
    void test(std::span<const std::uint32_t> points, const std::vector<std::uint32_t>& entries) {
        for (const auto p : points)
            for (const auto e : entries)
                if (memory_.entries[e].counts_as_on(points_[p])) found_[p].push_back(e);
    }

    const CutMemory& memory_;
    std::span<const Vec3> points_;
    std::vector<std::vector<std::uint32_t>> found_;
};

} // namespace

std::vector<std::vector<std::uint32_t>> CutMemory::entries_at(std::span<const Vec3> points) const {
    return PointsOnPlanes(*this, points).run();
}

namespace {

double largest_part(const Vec3& n) { return std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)}); }

/// The axis and the coordinate of an axis-aligned plane, if the plane's numbers give it without rounding.
std::optional<std::pair<int, double>> exact_place(const Plane& plane) {
    const int axis = axis_of(plane);
    if (axis < 0) return {};
    const auto i = static_cast<std::size_t>(axis);
    if (plane.offset == 0) return std::pair{axis, plane.through[i] + 0.0}; // 0 instead of -0
    if (plane.through[i] == 0 && std::fabs(plane.normal[i]) == 1)
        return std::pair{axis, -plane.offset * plane.normal[i]};
    return {};
}

/// Hashes planes by their exact coordinate if they have one. Other planes are hashed by two numbers that do
/// not depend on the notation, up to rounding: the distance from the origin, and the angle between the
/// normal and a direction.
class PlaneBuckets {
  public:
    /// reach: the largest coordinate of the points through which the planes are written, and offset.
    explicit PlaneBuckets(double reach) : scale_(reach > 0 ? 1 / reach : 1) {}

    /// The first stored plane that is the same. If none is, stores this plane and returns it.
    std::size_t first(std::span<const Plane> planes, std::size_t number) {
        const auto place = exact_place(planes[number]);
        if (!place) return first_of_others(planes, number);
        const auto [at, is_new] = places_.try_emplace(*place, number);
        if (!is_new) return at->second;
        for (const std::size_t other : across_)
            if (same_plane(planes[other], planes[number])) return at->second = other;
        return number;
    }

  private:
    std::size_t first_of_others(std::span<const Plane> planes, std::size_t number) {
        const bool is_across = axis_of(planes[number]) >= 0;
        if (is_across)
            for (const auto& [place, other] : places_)
                if (same_plane(planes[other], planes[number])) return other;
        const auto [distance, leaning] = numbers(planes[number]);
        for (const double d : {distance - cell / 2, distance + cell / 2})
            for (const double l : {leaning - cell / 2, leaning + cell / 2})
                if (const auto at = buckets_.find(key(d, l)); at != buckets_.end())
                    for (const std::size_t other : at->second)
                        if (same_plane(planes[other], planes[number])) return other;
        buckets_[key(distance, leaning)].push_back(number);
        if (is_across) across_.push_back(number);
        return number;
    }

    /// Far above the rounding of the numbers, which have a size near 1.
    static constexpr double cell = 1e-12;

    std::pair<double, double> numbers(const Plane& plane) const {
        const Vec3& n = plane.normal;
        const double largest = largest_part(n);
        const Vec3 unit = normalised(n / largest);
        const double offset = plane.offset / largest / length(n / largest) * scale_;
        return {std::fabs(offset - dot(unit, plane.through * scale_)),
                std::fabs(dot(unit, {0.36, 0.48, 0.8}))};
    }
    static std::uint64_t key(double a, double b) {
        const auto whole = [](double x) { // offsets may be far beyond the points
            return static_cast<std::uint64_t>(whole_number<std::int64_t>(std::floor(x / cell)));
        };
        return hashed(whole(a), whole(b));
    }

    double scale_;
    std::map<std::pair<int, double>, std::size_t> places_;
    std::vector<std::size_t>
        across_; ///< axis-aligned planes whose numbers do not give the coordinate exactly
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> buckets_;
};

} // namespace

std::vector<std::size_t> first_same_planes(std::span<const Plane> planes) {
    double reach = 0;
    for (const Plane& p : planes)
        reach = std::max({reach, std::fabs(p.through.x), std::fabs(p.through.y), std::fabs(p.through.z),
                          std::fabs(p.offset) / largest_part(p.normal)});
    if (!std::isfinite(reach)) reach = 0;
    PlaneBuckets buckets(reach);
    std::vector<std::size_t> first(planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) first[i] = buckets.first(planes, i);
    return first;
}

} // namespace facetmill
