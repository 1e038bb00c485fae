#include "mesh/unreferenced.hpp"

#include "base/error.hpp"
#include "mesh/placement.hpp"

#include <limits>

namespace facetmill {

namespace {

void require_numbers(std::size_t corners) {
    if (corners > std::numeric_limits<Index>::max())
        throw Error(ErrorKind::limit, "E-LIMIT", "there are too many points to compare",
                    "compare parts of the files");
}

} // namespace

Surface unreferenced_points_of(const Scene& scene) {
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

Surface surface_or_points_of(const Scene& scene) {
    return scene.face_count() > 0 ? surface_of(scene) : unreferenced_points_of(scene);
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
