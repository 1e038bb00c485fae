#pragma once
// Bakes the look of one surface into the textures of another. Each texel of the target casts a ray along the
// smooth normal of its point, and takes colours, normals and other values at the point that it hits. After P.
// Cignoni, C. Montani, C. Rocchini, R. Scopigno, "A general method for preserving attribute values on
// simplified meshes" (1998), and P. Sander, J. Snyder, S. Gortler, H. Hoppe, "Texture mapping progressive
// meshes" (2001).

#include "geometry/render/texture.hpp"
#include "geometry/spatial/face_tree.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace facetmill {

/// The surface whose look is taken, in world space.
struct BakeSource {
    Mesh mesh;                              ///< triangles
    std::vector<MaterialLook> looks;        ///< by material of its primitives
    std::vector<std::uint8_t> double_sided; ///< by material
};

/// Gives the source the normals that it lacks (smooth, with edges at 40 degrees), and tangents if a look has
/// a normal map.
void prepare_bake_source(BakeSource& source);

/// How far two surfaces are apart, at the vertices, edges and centres of the target and at vertices of the
/// source.
struct BakeGap {
    double mean = 0, farthest = 0; ///< distances from the target to the source
    double back = 0;               ///< the largest distance from the source to the target
    double agreeing = 1; ///< share of the target's points whose nearest face has a similar direction
};
/// tree: over the source. At most about 300,000 points are measured.
[[nodiscard]] BakeGap bake_gap(const Mesh& source, const FaceTree& tree, const Mesh& target);

struct BakeSettings {
    int size = 2048;        ///< pixels of a side
    int samples = 1;        ///< samples along each side of a texel
    double distance = 0;    ///< how far rays reach to both sides of the target
    bool any_side = false;  ///< rays may hit faces from behind
    int dilation = 16;      ///< texels that the border of charts grows
    int occlusion_rays = 0; ///< rays for each texel and its neighbours; 0: occlusion only from textures
    double occlusion_distance = HUGE_VAL; ///< how far occluders are looked for
    bool height = false, position = false, thickness = false;
};

/// Baked maps, row by row from the top.
struct BakedMaps {
    int size = 0;
    std::vector<std::uint8_t> base;     ///< sRGB and alpha, four bytes a texel
    std::vector<std::uint8_t> normal;   ///< tangent space, four bytes a texel
    std::vector<std::uint8_t> surface;  ///< occlusion, roughness, metalness, 255
    std::vector<std::uint8_t> emission; ///< sRGB and 255, divided by emission_strength
    std::vector<float> height;          ///< along the normal, outward positive
    std::vector<float> thickness;       ///< of the source, inward along its normal; 0: no other side
    std::vector<float> position;        ///< three coordinates in world space
    float emission_strength = 1;
    bool transparent = false, glows = false;
    std::size_t covered = 0; ///< texels with a point of the target
    std::size_t missed = 0;  ///< covered texels whose rays hit nothing, filled from the nearest point
    std::size_t overlapping_faces = 0; ///< faces of the target that share texels
    std::size_t faces_without_texels = 0;
};

/// The number of faces of the target that are not within the unit square.
[[nodiscard]] std::size_t faces_outside_texture(const Mesh& target);

/// Bakes. target: triangles in world space with NORMAL, TANGENT and TEXCOORD_0 within the unit square. tree:
/// over the source's mesh, for all uses. Of several faces that cover a texel, the first counts.
///
/// A ray starts at the target and searches both ways. The nearest hit counts whose face looks in the same
/// direction (any_side: in any direction). Colours are averaged in linear light, and textures are filtered
/// by the footprint of a texel. Occlusion is weighted by the cosine. Each texel casts a sixteenth of the
/// rays, and the mean over 4 x 4 texels of similar direction counts.
///
/// O(texels log faces), parallel; the result does not depend on the number of threads. Memory: about 40 bytes
/// a texel.
[[nodiscard]] BakedMaps bake(const BakeSource& source, const FaceTree& tree, const Mesh& target,
                             const BakeSettings& settings);

} // namespace facetmill
