#include "mesh/surface.hpp"

#include "base/error.hpp"
#include "mesh/finite_box.hpp"
#include "mesh/placement.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace facetmill {

namespace {

/// The triangles of a mesh with polygons, and the face of each.
void cut_polygons(const Mesh& mesh, Surface& surface) {
    Mesh numbered = bare(mesh);
    std::vector<std::uint32_t> numbers(mesh.face_count());
    for (std::size_t f = 0; f < numbers.size(); ++f) numbers[f] = static_cast<std::uint32_t>(f);
    numbered.attributes.push_back({"face", Domain::face, Role::index, 1, false, std::move(numbers)});
    Mesh cut = triangulated(numbered);
    surface.faces = std::get<std::vector<std::uint32_t>>(std::move(cut.attributes[0].data));
    surface.positions = std::move(cut.positions);
    surface.corners = std::move(cut.corners);
}

void append(Surface& all, Surface&& one, Index first_face) {
    if (all.positions.size() + one.positions.size() > std::numeric_limits<Index>::max() ||
        all.corners.size() + one.corners.size() > std::numeric_limits<Index>::max())
        throw Error(ErrorKind::limit, "E-LIMIT", "the parts together have too many vertices or corners",
                    "work on fewer parts at a time, or simplify first");
    const auto base = static_cast<Index>(all.positions.size());
    for (std::size_t t = 0; t < one.size(); ++t) all.faces.push_back(first_face + one.face(t));
    for (const Index v : one.corners) all.corners.push_back(base + v);
    all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
}

/// The first vertex on each side of the box of all vertices. None if a side is at 0, whose sign would depend
/// on the order of the vertices.
std::optional<std::array<Index, 6>> vertices_on_sides(const std::vector<Vec3>& positions, const Box& box) {
    std::array<Index, 6> first{};
    for (std::size_t side = 0; side < first.size(); ++side) {
        const std::size_t axis = side % 3;
        const double at = side < 3 ? box.min[axis] : box.max[axis];
        const auto there = std::find_if(positions.begin(), positions.end(),
                                        [&](const Vec3& p) { return p[axis] == at && is_finite(p); });
        if (at == 0 || there == positions.end()) return {};
        first[side] = static_cast<Index>(there - positions.begin());
    }
    return first;
}

/// Whether each of these vertices is a corner.
bool are_corners(const std::array<Index, 6>& vertices, const std::vector<Index>& corners) {
    const unsigned met = parallel_reduce(
        corners.size(), 0U,
        [&](std::size_t begin, std::size_t end) {
            unsigned found = 0;
            for (std::size_t c = begin; c < end; ++c)
                for (std::size_t i = 0; i < vertices.size(); ++i)
                    found |= static_cast<unsigned>(corners[c] == vertices[i]) << i;
            return found;
        },
        [](unsigned a, unsigned b) { return a | b; });
    return met == (1U << vertices.size()) - 1;
}

} // namespace

Box Surface::bounds() const {
    // Reading vertices in order is twice as fast as corner by corner. If the vertices on the sides of their
    // box are corners, it is also the box of the corners.
    if (positions.size() < corners.size()) {
        const Box all = box_of_finite(positions.size(), [&](std::size_t v) { return positions[v]; });
        if (const auto vertices = vertices_on_sides(positions, all);
            vertices && are_corners(*vertices, corners))
            return all;
    }
    return parallel_reduce(
        corners.size(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Vec3 low = Box{}.min, high = Box{}.max;
            for (std::size_t c = begin; c < end; ++c) {
                const Vec3& p = positions[corners[c]];
                if (!is_finite(p)) continue;
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
            return Box{low, high};
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

Surface surface_of(const Mesh& mesh) {
    Surface surface;
    if (!mesh.all_triangles()) {
        cut_polygons(mesh, surface);
    } else {
        surface.positions = mesh.positions;
        surface.corners = mesh.corners;
    }
    if (mesh.has_seams())
        parallel_for(surface.corners.size(),
                     [&](std::size_t c) { surface.corners[c] = mesh.vertex_of_wedge(surface.corners[c]); });
    return surface;
}

Surface surface_of(const Part& part, SurfaceOfMesh of_mesh) {
    Surface surface = of_mesh(part.mesh);
    if (!part.transform.identity())
        parallel_for(surface.positions.size(), [&](std::size_t v) {
            surface.positions[v] = part.transform.point(surface.positions[v]);
        });
    return surface;
}

Surface surface_of(std::span<const Part* const> parts, SurfaceOfMesh of_mesh) {
    if (parts.size() == 1) return surface_of(*parts[0], of_mesh);
    Surface all;
    Index first_face = 0;
    for (const Part* part : parts) {
        append(all, surface_of(*part, of_mesh), first_face);
        first_face += static_cast<Index>(part->mesh.face_count());
    }
    return all;
}

Surface surface_of(const Scene& scene, SurfaceOfMesh of_mesh) {
    std::vector<const Part*> parts;
    for (const auto& part : scene.parts) parts.push_back(&part);
    return surface_of(parts, of_mesh);
}

namespace {

void require_numbers(std::size_t corners) {
    if (corners > std::numeric_limits<Index>::max())
        throw Error(ErrorKind::limit, "E-LIMIT", "there are too many points to compare",
                    "compare parts of the files");
}

} // namespace

Surface isolated_vertices_of(const Scene& scene) {
    Surface points;
    for (const Part& part : scene.parts) {
        std::vector<std::uint8_t> used(part.mesh.vertex_count());
        for (Index c = 0; c < part.mesh.corner_count(); ++c) used[part.mesh.vertex(c)] = 1;
        for (std::size_t v = 0; v < used.size(); ++v)
            if (!used[v]) points.positions.push_back(in_world(part, part.mesh.positions[v]));
    }
    require_numbers(3 * points.positions.size());
    points.corners.resize(3 * points.positions.size());
    for (std::size_t c = 0; c < points.corners.size(); ++c) points.corners[c] = static_cast<Index>(c / 3);
    points.faces.assign(points.positions.size(), none);
    return points;
}

Surface surface_or_points_of(const Scene& scene, SurfaceOfMesh of_mesh) {
    return scene.face_count() > 0 ? surface_of(scene, of_mesh) : isolated_vertices_of(scene);
}

Surface joined(Surface a, const Surface& b) {
    require_numbers(a.corners.size() + b.corners.size());
    const auto base = static_cast<Index>(a.positions.size());
    if (a.faces.empty())
        for (std::size_t t = 0; t < a.size(); ++t) a.faces.push_back(static_cast<Index>(t));
    for (std::size_t t = 0; t < b.size(); ++t) a.faces.push_back(b.face(t));
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Index v : b.corners) a.corners.push_back(base + v);
    return a;
}

} // namespace facetmill
