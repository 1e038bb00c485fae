#pragma once
// Remembers which points were built on which planes. The intersection of a plane and an edge is rounded, so
// it is off the plane by a few units in the last place. When the same plane occurs again, the point must
// count as on it, or the cut would make slivers.

#include "mesh/plane.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace facetmill {

/// Points are identified by their exact positions, not by numbers. So the memory survives renumbering of
/// vertices, and a point moved by any stage is forgotten automatically.
struct CutMemory {
    struct Entry {
        Plane plane;
        double reach = 0;         ///< the largest |side| of the points
        std::vector<Vec3> points; ///< ascending by x, y, z

        /// Whether the point was built on the plane. side_of_it: side(plane, point), which the caller has
        /// already computed.
        bool has(const Vec3& point, double side_of_it) const;
        /// Whether the point was built on the plane, or is exactly on it.
        bool counts_as_on(const Vec3& point) const {
            const double s = side(plane, point);
            return s == 0 || has(point, s);
        }
    };
    std::vector<Entry> entries;

    /// The entry of this plane, in any notation (same_plane), or null.
    const Entry* find(const Plane& plane) const;
    /// Adds points to the entry of the plane. Points exactly on it need no memory and are skipped. The plane
    /// becomes known in any case, for the points that later cuts make on edges along it.
    void add(const Plane& plane, std::vector<Vec3> points);
    /// Adds points to an entry.
    void add_to(std::size_t entry, std::vector<Vec3> points);
    /// Like add for each entry, in order, in time that grows with the sum of both sizes.
    void add_all(std::vector<Entry> more);
    /// For each point, the entries that contain it, ascending.
    std::vector<std::vector<std::uint32_t>> entries_at(std::span<const Vec3> points) const;
};

/// For each plane, the number of the first plane that is the same.
[[nodiscard]] std::vector<std::size_t> first_same_planes(std::span<const Plane> planes);

} // namespace facetmill
