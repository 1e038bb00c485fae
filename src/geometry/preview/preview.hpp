#pragma once
// A scene as one mesh of few triangles, for a view that is turned on a screen. The one header of this folder
// that others include.

#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <optional>

namespace facetmill {

struct PreviewSettings {
    std::size_t faces = 60000; ///< about so many triangles at most; of lines and of points exactly so many
    std::shared_ptr<const ResolvedMaterials> materials{}; ///< whose base textures will be laid on; or none
    /// What closes cuts with numbers above it (later_caps) has paints of its own; none: it has not.
    std::optional<Index> last_cap{};
};

/// The paint of the faces of a primitive of the preview.
struct PreviewPaint {
    Index material = none; ///< of the scene
    bool coloured = false; ///< their part has colours
    bool cap = false;      ///< they close a cut, where PreviewSettings::last_cap asks for it
};

struct Preview {
    /// Triangles in world space with wedge attributes:
    /// - NORMAL if all parts with faces have it;
    /// - COLOR_0 (linear, clamped to 0 to 1) if a part has colours;
    /// - TEXCOORD_0 if a material has a base texture (Texture::set and Texture::transform are applied).
    ///
    /// Each vertex is a vertex of the scene. After the wedges of triangles come the wedges of parts without
    /// faces, every n-th of them: the ends of lines, two each, and single points. In this case all wedges
    /// have COLOR_0.
    Mesh mesh;
    std::size_t first_loose = 0, first_dot = 0; ///< wedges: the first end of a line, the first single point
    std::vector<PreviewPaint> paints;           ///< [mesh.primitives]
    std::size_t faces = 0;                      ///< triangles of the scene
    std::size_t all_lines = 0, all_dots = 0;    ///< of the scene
};

/// Makes one mesh of all parts and simplifies it, to vertices among those that it has; a scene of more than
/// twice the triangles asked for, without textures, goes through a grid first, in each cell of which one
/// vertex stays. What is made of very many small components loses some of them. Points that are not finite,
/// and their faces, are left out. Colours of faces stay apart. The same for any number of threads. About
/// O(n); memory: as the mesh of the scene where it is not large, else a few times that of the preview and 8
/// bytes for each vertex of the largest part.
[[nodiscard]] Preview preview_of(const Scene& scene, const PreviewSettings& settings = {});

} // namespace facetmill
