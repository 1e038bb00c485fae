#pragma once
// What a scene as a whole may hold: counts, names, glTF extensions, textures.

#include "mesh/scene.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"

namespace facetmill::validate_stage {

struct SceneLimits {
    std::optional<CountLimit> parts, materials, texture_pixels;
    std::optional<ByteLimit> documents_bytes;
    std::vector<std::string> names;      ///< patterns, one of which every part's name has to match
    std::vector<std::string> extensions; ///< glTF extensions that may be used; none given: all
    bool any() const;
};

void declare_limits(Declare<SceneLimits>& d);

/// A check, and of words that no pattern matches what they are known by, ascending.
struct LimitCheck {
    report::Check check;
    std::vector<std::uint64_t> keys = {};
};

/// One check per limit that is set. A failed one has as evidence what counts most towards it, ten entries at
/// most: [{part}], [{material}], [{image, width, height, amount}], [{bytes_of, amount}], [{extension,
/// document}].
std::vector<LimitCheck> check_limits(const SceneLimits& limits, const Scene& scene);

} // namespace facetmill::validate_stage
