#pragma once
// Attributes of a mesh taken from the nearest points of another mesh.

#include "geometry/spatial/face_tree.hpp"
#include "mesh/provenance.hpp"

#include <array>
#include <span>
#include <vector>

namespace facetmill {

/// The barycentric weights of the point of a triangle nearest to p.
[[nodiscard]] std::array<double, 3> barycentric_weights(const FaceTree::Triangle& triangle, const Vec3& p);

/// The sources of the elements of a mesh on another mesh.
struct NearestSources {
    MeshProvenance provenance; ///< mixes of three elements; faces are copies
    std::vector<double>
        distances; ///< [vertices] to the nearest point; infinite for points that are not finite
};

/// Regions of faces that must correspond, for example the sides of a seam. Empty: any face may be a source.
struct SourceRegions {
    std::span<const Index> from, to; ///< [faces of the mesh] regions
};

/// For each vertex, wedge and face of `to`, the nearest point of the triangle mesh `from`, which must have a
/// triangle. Both are in the same space. tree: over surface_of(from). The mix has the barycentric weights of
/// the point, the largest first.
///
/// A wedge of a vertex with several wedges is looked up a ten thousandth of the way towards one of its faces.
/// So it gets the values of its own side of a seam. A wedge in several regions takes any of them, because
/// values are continuous at their borders. A face gets the source at its centre. If the region of the nearest
/// face differs, points on the way to the centre of a face of the element are tried, then any face of the
/// region. O(n log n), parallel; the result does not depend on the number of threads.
[[nodiscard]] NearestSources nearest_sources(const Mesh& from, const FaceTree& tree, const Mesh& to,
                                             const SourceRegions& regions = {});

/// The number of faces of `to` whose corners have sources that no wedges of `from` connect, such as the
/// charts of a texture. Values vary across them without meaning.
[[nodiscard]] std::size_t faces_across_charts(const Mesh& from, const Mesh& to,
                                              const MeshProvenance& provenance);

} // namespace facetmill
