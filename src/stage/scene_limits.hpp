#pragma once
// What a scene as a whole may hold: counts, names, glTF extensions, textures.

#include "mesh/scene.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"

namespace facetmill {

struct SceneLimits {
    std::optional<Bound> parts, materials, documents_bytes, texture_pixels;
    std::vector<std::string> names;      ///< patterns, one of which every part's name has to match
    std::vector<std::string> extensions; ///< glTF extensions that may be used; none given: all
    bool any() const {
        return parts || materials || documents_bytes || texture_pixels || !names.empty() ||
               !extensions.empty();
    }
};

void declare_limits(Declare<SceneLimits>& d);

/// One check per limit that is set.
std::vector<report::Check> check_limits(const SceneLimits& limits, const Scene& scene);

} // namespace facetmill
