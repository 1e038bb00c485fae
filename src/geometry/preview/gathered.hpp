#pragma once
// All parts of a scene as one mesh in world space.

#include "geometry/preview/preview.hpp"

#include <span>

namespace facetmill {

/// The attributes of a scene that a preview keeps.
struct PreviewAttributes {
    bool normals = false, colours = false, textures = false;
    bool baked = false;              ///< base textures as colours, sampled at each wedge
    std::optional<Index> last_cap{}; ///< PreviewSettings::last_cap
};
/// The colours of a mesh, or null.
[[nodiscard]] const Attribute* colours_in(const Mesh& mesh);
[[nodiscard]] PreviewAttributes preview_attributes(const Scene& scene, const ResolvedMaterials* materials);

/// Takes triangles, part by part, into one mesh.
class Gatherer {
  public:
    Gatherer(const Scene& scene, const ResolvedMaterials* materials, PreviewAttributes wanted);
    /// Triangles of a mesh of triangles that stands there, by their corners, three each: whose vertices and
    /// attributes they have. Those with a point that is not finite are left out.
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
