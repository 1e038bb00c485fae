#pragma once
// The texture coordinates of materials that may go into an atlas.

#include "io/gltf/contents/atlas_material.hpp"
#include "mesh/scene.hpp"

#include <map>

namespace facetmill::textures_stage {

using Uv = std::array<double, 2>;

/// The part of a texture that faces use, and the areas of these faces.
struct UvExtent {
    Uv low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
    double uv_area = 0, world_area = 0;
    [[nodiscard]] double side(std::size_t axis) const { return high[axis] - low[axis]; }
    /// How many copies of the texture it needs.
    [[nodiscard]] double copies() const { return std::max(1.0, side(0)) * std::max(1.0, side(1)); }
    void add(const UvExtent& other);
};

/// A material that parts of the scene use.
struct AtlasCandidate {
    io::AtlasMaterial look;
    bool double_sided = false;
    UvExtent extent;
};
using AtlasCandidates = std::map<Index, AtlasCandidate>; ///< by index of the scene's materials

/// The candidates' wedges of a part.
struct MappedPart {
    std::size_t part = 0;
    std::vector<Index> material; ///< [wedges] candidate, or none
    std::vector<Uv> uv;          ///< [wedges] after the texture transform, moved by whole textures
};

/// Maps the candidates' faces of a part, and adds to their extents. Each connected set of faces is moved by
/// whole textures to where it is nearest the origin, if its textures repeat. Wedges that several materials
/// share are separated. Candidates that the part uses in an unsupported way get a reason to stay apart.
[[nodiscard]] MappedPart map_part(Part& part, std::size_t number, AtlasCandidates& candidates);

} // namespace facetmill::textures_stage
