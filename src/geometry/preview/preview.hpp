#pragma once
// Reduces a scene to a single mesh with few triangles, for interactive views. Other folders include only
// this header of the folder.

#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <optional>

namespace facetmill {

struct PreviewSettings {
    std::size_t faces = 60000; ///< approximate maximum of triangles; exact maximum of lines and of points
    std::shared_ptr<const ResolvedMaterials>
        materials{}; ///< the materials whose base textures apply; may be null
    /// Caps with numbers above this (later_caps) get separate paints. Empty: no separate paints.
    std::optional<Index> last_cap{};
};

/// The paint of the faces of a primitive of the preview.
struct PreviewPaint {
    Index material = none; ///< index of the scene's material
    bool coloured = false; ///< the part of these faces has colours
    bool cap = false;      ///< these faces close a cut, see PreviewSettings::last_cap
};

struct Preview {
    /// Triangles in world space with wedge attributes:
    /// - NORMAL if all parts with faces have it;
    /// - COLOR_0 (linear, clamped to 0 to 1) if a part has colours;
    /// - TEXCOORD_0 if a material has a base texture (Texture::set and Texture::transform are applied).
    ///
    /// Each vertex is a vertex of the scene. The wedges of triangles are followed by wedges of parts without
    /// faces, every n-th: two ends per line, then single points. In this case all wedges have COLOR_0.
    Mesh mesh;
    std::size_t first_loose = 0,
                first_dot = 0;        ///< wedge numbers of the first line end and of the first single point
    std::vector<PreviewPaint> paints; ///< [mesh.primitives] paints
    std::size_t faces = 0;            ///< triangles of the scene
    std::size_t all_lines = 0, all_dots = 0; ///< counts in the scene
};

/// Joins all parts and simplifies the mesh to a subset of its vertices. A scene without textures and with
/// more than twice the requested triangles goes through a grid first, which leaves a vertex per cell. A
/// scene of very many small components loses some of them. Points that are not finite, and their faces, are
/// left out. Colours of faces stay separate. The result does not depend on the number of threads. About
/// O(n). Memory: the scene's mesh if it is small, otherwise a few times the preview plus 8 bytes per vertex
/// of the largest part.
[[nodiscard]] Preview preview_of(const Scene& scene, const PreviewSettings& settings = {});

} // namespace facetmill
