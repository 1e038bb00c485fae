#pragma once
// Which points were built on which planes. A point where a plane cuts an edge is rounded, so it lies beside
// that plane by some units in the last place; when the same plane comes again, it must count as on it, or
// slivers come off.

#include "mesh/plane.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

/// Points are known by their exact places, not by numbers: so the memory outlives whatever renumbers
/// vertices, and a point that is moved, by whatever stage, is forgotten without anybody's doing.
struct CutMemory {
    struct Entry {
        Plane plane;
        double reach = 0;         ///< the largest |side| of the points
        std::vector<Vec3> points; ///< ascending by x, y, z

        /// Whether the point was built on the plane. side_of_it: side(plane, point), as far as the caller has
        /// it.
        bool has(const Vec3& point, double side_of_it) const;
        /// ... or is exactly on it.
        bool counts_as_on(const Vec3& point) const {
            const double s = side(plane, point);
            return s == 0 || has(point, s);
        }
    };
    std::vector<Entry> entries;

    /// What is known of that plane, however it is written (same_plane); or nothing.
    const Entry* find(const Plane& plane) const;
    /// Adds points to what is known of the plane. Those exactly on it need no memory and are left out, but
    /// the plane is known from now on, for the points that later cuts make on edges along it.
    void add(const Plane& plane, std::vector<Vec3> points);
    /// The same of the plane of an entry.
    void add_to(std::size_t entry, std::vector<Vec3> points);
    /// As add for each of those entries, in order, but in time that grows with the sum of both.
    void add_all(std::vector<Entry> more);
    /// For each point the entries that it counts as on, ascending.
    std::vector<std::vector<std::uint32_t>> entries_at(std::span<const Vec3> points) const;
};

/// For each plane the number of the first one that is the same plane.
std::vector<std::size_t> first_same_planes(std::span<const Plane> planes);

} // namespace facetmill
