#pragma once
// Pictures of scenes in pages.

#include "geometry/render/render.hpp"
#include "io/gltf/contents/resolved_materials.hpp"

#include <string>

namespace facetmill::report {

/// Fast settings for pages with many pictures.
[[nodiscard]] PictureSettings page_settings();

/// The picture as a PNG in base64.
[[nodiscard]] std::string page_text(const Picture& picture);

/// A picture with textures, as a PNG in base64. Silently skips textures that cannot be drawn; the caller
/// reports them (io::MaterialResolver).
[[nodiscard]] std::string scene_picture(const Scene& scene, PictureSettings settings,
                                        io::MaterialResolver& materials);

/// A picture for an index. Adds skipped textures to not_drawn.
[[nodiscard]] std::string small_picture(const Scene& scene, std::vector<Diagnostic>& not_drawn);

} // namespace facetmill::report
