#include "geometry/thicken/moved_surface.hpp"

#include "geometry/edit/surgery.hpp"
#include "geometry/measure/measure.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/rays.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <queue>

namespace facetmill {

namespace {

/// The triangle's map: its determinant and trace, times twice the triangle's area squared.
bool is_turned(const Vec3& u, const Vec3& v, const Vec3& moved_u, const Vec3& moved_v) {
    const Vec3 normal = cross(u, v);
    const double whole = dot(normal, normal);
    if (!(whole > 0)) return false;
    const double determinant = dot(normal, cross(moved_u, moved_v));
    const double trace = dot(normal, cross(u, moved_v) + cross(moved_u, v));
    return determinant <= collapse_rounding * whole || trace <= collapse_rounding * whole;
}

/// A cube of the search, and an upper bound for the distance of its points to the surface.
struct Cell {
    Vec3 middle;
    double half = 0, reach = 0;
    bool operator<(const Cell& o) const { return reach < o.reach; }
};

class RoomSearch {
  public:
    RoomSearch(const Mesh& component, double depth) : tree_(surface_of(component)), depth_(depth) {}

    Room run(const Box& box) {
        const Vec3 extent = box.max - box.min;
        if (2 * depth_ >= std::min({extent.x, extent.y, extent.z})) return Room::none;
        if (look_at({box.centre(), box.longest_side() / 2, 0})) return Room::some;
        for (int looked = 0; !cells_.empty(); ++looked) {
            if (looked == max_cells) return Room::unknown;
            const Cell cell = cells_.top();
            cells_.pop();
            for (unsigned octant = 0; octant < 8; ++octant) {
                Cell part{cell.middle, cell.half / 2, 0};
                for (std::size_t i = 0; i < 3; ++i)
                    part.middle[i] += (octant >> i & 1U) != 0 ? part.half : -part.half;
                if (look_at(part)) return Room::some;
            }
        }
        return Room::none;
    }

  private:
    static constexpr int max_cells = 12'500; // each division makes eight cells

    /// True when the middle of the cell has room; queues the cell if another point may have.
    bool look_at(Cell cell) {
        const double distance = closest_point(tree_, cell.middle).distance,
                     corner = cell.half * std::sqrt(3.0);
        cell.reach = distance + corner;
        if (cell.reach <= depth_ * (1 + 0x1p-10)) return false;
        if (distance > 0 && (distance > depth_ || distance > corner)) {
            const bool inside = winding(tree_, cell.middle) > 0;
            if (inside && distance > depth_) return true;
            if (!inside && distance > corner) return false;
        }
        cells_.push(cell);
        return false;
    }

    FaceTree tree_;
    double depth_;
    std::priority_queue<Cell> cells_;
};

void reverse_faces(Mesh& mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin(f), mesh.corners.begin() + mesh.face_end(f));
}

} // namespace

std::vector<std::uint8_t> turned_faces(const Mesh& mesh, const std::vector<Vec3>& moved) {
    const Surface surface = surface_of(mesh);
    std::vector<std::uint8_t> of_triangle(surface.size());
    parallel_for(of_triangle.size(), [&](std::size_t t) {
        const auto side = [&](const std::vector<Vec3>& points, std::size_t k) {
            return points[surface.corners[3 * t + k]] - points[surface.corners[3 * t]];
        };
        of_triangle[t] =
            is_turned(side(mesh.positions, 1), side(mesh.positions, 2), side(moved, 1), side(moved, 2));
    });
    if (surface.faces.empty()) return of_triangle;
    std::vector<std::uint8_t> turned(mesh.face_count(), 0);
    for (std::size_t t = 0; t < of_triangle.size(); ++t) turned[surface.face(t)] |= of_triangle[t];
    return turned;
}

Room room_inside(const Mesh& component, double depth) {
    return RoomSearch(component, depth).run(component.bounds());
}

std::vector<std::uint8_t> vanished_components(const Mesh& mesh, const std::vector<std::uint8_t>& turned,
                                              double distance) {
    if (std::find(turned.begin(), turned.end(), 1) == turned.end()) // the usual case
        return std::vector<std::uint8_t>(mesh.face_count(), 0);
    const Components components = face_components(mesh, false);
    std::vector<Index> label(components.count, none), labels(mesh.face_count());
    Index count = 0;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (Index& l = label[components.of_face[f]]; turned[f] && l == none) l = count++;
    std::vector<std::uint8_t> vanished(mesh.face_count(), 0);
    if (count == 0) return vanished;
    for (Index f = 0; f < mesh.face_count(); ++f)
        labels[f] =
            std::min(label[components.of_face[f]], count); // the last label collects all unturned components
    auto meshes = separated(bare(mesh), labels, std::size_t{count} + 1);
    std::vector<std::uint8_t> gone(meshes.size(), 0);
    meshes.pop_back();
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        if (distance > 0)
            reverse_faces(meshes[i]); // moving outward shrinks the space in front of the surface
        const auto solid = measure_mass(meshes[i]).solid;
        gone[i] = solid && solid->volume > 0 && room_inside(meshes[i], std::abs(distance)) == Room::none;
    }
    for (Index f = 0; f < mesh.face_count(); ++f) vanished[f] = gone[labels[f]];
    return vanished;
}

} // namespace facetmill
