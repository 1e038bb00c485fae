#pragma once
// Gathers all parts of a scene into a single mesh in world space.

#include "geometry/preview/preview.hpp"

#include <span>

namespace facetmill {

/// The attributes of a scene that a preview keeps.
struct PreviewAttributes {
    bool normals = false, colours = false, textures = false;
    bool baked = false;              ///< base textures become colours, sampled at each wedge
    std::optional<Index> last_cap{}; ///< see PreviewSettings::last_cap
};
/// The colours of a mesh, or null.
[[nodiscard]] const Attribute* colours_in(const Mesh& mesh);
[[nodiscard]] PreviewAttributes preview_attributes(const Scene& scene, const ResolvedMaterials* materials);

/// Collects triangles, part by part, in a single mesh.
class Gatherer {
  public:
    Gatherer(const Scene& scene, const ResolvedMaterials* materials, PreviewAttributes wanted);
    /// Adds triangles of a triangle mesh with this transform. corners: three corners of the mesh per
    /// triangle, from which vertices and attributes come. Skips triangles with points that are not finite.
    void add(const Mesh& triangles, const Transform& to_world, std::span<const Index> corners);
    Preview finish();

  private:
    struct Placed; ///< a mesh that is being added
    Index primitive_for(Placed& placed, Index face);
    Index wedge_for(Placed& placed, Index corner, Index primitive);
    void push_attributes(const Placed& placed, Index face, Index wedge, const PreviewPaint& paint);

    const Scene& scene_;
    const ResolvedMaterials* materials_;
    PreviewAttributes wanted_;
    Preview out_;
    std::vector<float> normals_, colours_, coordinates_;
    std::vector<std::uint32_t> primitives_;
};

} // namespace facetmill
