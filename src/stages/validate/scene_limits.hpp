#pragma once
// Limits of a whole scene: counts, names, glTF extensions, textures.

#include "base/lazy.hpp"
#include "mesh/scene.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"
#include "stage/context.hpp"
#include "stages/validate/material_ranges.hpp"

#include <span>

namespace facetmill::validate_stage {

struct SceneLimits {
    std::optional<CountLimit> parts{}, materials{};
    std::optional<CountLimit> primitives{}; ///< draw calls of the scene
    std::optional<CountLimit> texture_sides{}, odd_textures{}, base_colours{}, partial_metals{};
    std::optional<CountLimit> moved_roots{}, pivot{}, longest_side{};
    std::optional<CountLimit> draw_calls{}, texture_pixels{}; ///< of a file
    std::optional<ByteLimit> bytes{};                         ///< of a file, with its neighbours
    std::vector<std::string> names{};      ///< patterns; every part's name must match at least one
    std::vector<std::string> extensions{}; ///< allowed glTF extensions; empty: all
    [[nodiscard]] bool any() const;
    /// The first given limit of files, "limits.bytes"; empty: none.
    [[nodiscard]] std::string of_files() const;
    /// Whether a limit other than of bytes is given.
    [[nodiscard]] bool need_whole_scene() const;
    /// Whether judging a file needs its scene, not only its size.
    [[nodiscard]] bool need_contents() const { return draw_calls || texture_pixels; }
};

/// A scene, or a file with its scene if limits need it.
struct Limited {
    const Scene& scene;
    std::span<const report::FileRecord> files = {}; ///< the file and its neighbours
    Lazy<std::vector<MaterialRange>> materials{[&s = scene] { return material_ranges(s); }};
};

void declare_limits(Declare<SceneLimits>& d);

/// A check, with the ascending keys of words that match no pattern.
struct LimitCheck {
    report::Check check;
    std::vector<std::uint64_t> keys = {};
};

/// Throws stage (E-LIMITS) if there is a limit of files, and no file was written on the way to the stage.
void require_written(const SceneLimits& limits, const Context& context);

enum class LimitsOf { scene, file };

/// A check per limit of that kind. A failed check lists at most ten entries as evidence, the largest first:
/// [{part}],
/// [{material}], [{image, width, height, amount}], [{bytes_of, amount}], [{extension, document}].
[[nodiscard]] std::vector<LimitCheck> check_limits(const SceneLimits& limits, LimitsOf of,
                                                   const Limited& of_what);

} // namespace facetmill::validate_stage
