#pragma once
// Limits of a whole scene: counts, names, glTF extensions, textures.

#include "mesh/scene.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"

namespace facetmill::validate_stage {

struct SceneLimits {
    std::optional<CountLimit> parts, materials, texture_pixels;
    std::optional<ByteLimit> documents_bytes;
    std::vector<std::string> names;      ///< patterns; every part's name must match at least one
    std::vector<std::string> extensions; ///< allowed glTF extensions; empty: all
    bool any() const;
};

void declare_limits(Declare<SceneLimits>& d);

/// A check, with the ascending keys of words that match no pattern.
struct LimitCheck {
    report::Check check;
    std::vector<std::uint64_t> keys = {};
};

/// A check per limit. A failed check lists at most ten entries as evidence, the largest first: [{part}],
/// [{material}], [{image, width, height, amount}], [{bytes_of, amount}], [{extension, document}].
[[nodiscard]] std::vector<LimitCheck> check_limits(const SceneLimits& limits, const Scene& scene);

} // namespace facetmill::validate_stage
