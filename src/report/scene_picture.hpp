#pragma once
// Pictures of scenes inside pages.

#include "geometry/render/render.hpp"
#include "io/gltf/contents/resolved_materials.hpp"

#include <string>

namespace facetmill::report {

/// Settings of pictures that stand beside many others in a page: quickly made.
PictureSettings page_settings();

/// As text of a page: a PNG in base64.
std::string page_text(const Picture& picture);

/// With the textures of its materials, a PNG in base64. A texture that cannot be drawn is left out without a
/// word, which is for who calls (io::MaterialResolver).
std::string scene_picture(const Scene& scene, PictureSettings settings, io::MaterialResolver& materials);

/// One of many in an index. Textures that it does without are added to not_drawn.
std::string small_picture(const Scene& scene, std::vector<Diagnostic>& not_drawn);

} // namespace facetmill::report
