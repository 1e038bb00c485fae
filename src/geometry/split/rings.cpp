#include "geometry/split/rings.hpp"

#include "base/portable_math.hpp"
#include "base/parallel.hpp"
#include "mesh/face.hpp"

namespace facetmill {

SmoothRings::SmoothRings(const Mesh& m, const EdgeTable& e, const SplitSettings& settings)
    : mesh(m), edges(e), corners(corners_at_vertices(m)), next_(m.corner_count()),
      previous_(m.corner_count()), twin_(m.corner_count(), none), sharp_(e.size()) {
    const std::vector<Index> faces = corner_faces(mesh);
    parallel_for(mesh.corner_count(), [&](std::size_t i) {
        const auto c = static_cast<Index>(i);
        next_[c] = next_corner(mesh, faces[c], c);
        previous_[next_[c]] = c;
    });
    const double limit = settings.feature_angle ? cosine(*settings.feature_angle) : -2;
    const auto normal = [&](Index c) { return normalised(area_vector(mesh, faces[c], settings.to_world)); };
    parallel_for(edges.size(), [&](std::size_t i) {
        const auto at = edges.corners_of(static_cast<Index>(i));
        if (at.size() != 2) {
            sharp_[i] = 1;
            return;
        }
        twin_[at[0]] = at[1];
        twin_[at[1]] = at[0];
        if (settings.feature_angle) sharp_[i] = exceeds_feature_angle(dot(normal(at[0]), normal(at[1])), limit);
    });
}

SmoothRings::Sharp SmoothRings::sharp_at(Index v) const {
    Sharp sharp;
    const auto see = [&](Index c, Index end) {
        if (!is_sharp(edges.corner_edge[c])) return;
        if (sharp.count < 2) sharp.ends[sharp.count] = end;
        ++sharp.count;
    };
    for (const Index c : corners.of(v)) {
        see(c, to(c));
        // The edge that ends here is another corner's own, unless it is a boundary.
        if (twin(previous(c)) == none) see(previous(c), from(previous(c)));
    }
    return sharp;
}

bool SmoothRings::is_smooth(Index v) const {
    for (const Index c : corners.of(v))
        if (twin(c) == none || twin(previous(c)) == none) return false;
    return sharp_at(v).count < 2;
}

} // namespace facetmill
