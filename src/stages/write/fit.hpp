#pragma once
// Makes files fit the purpose that their scene was checked for.

#include "stage/purpose.hpp"
#include "stages/write/options.hpp"

namespace facetmill::write_stage {

/// Rounds the parts as the file will, and repairs the faults that this causes. On 32-bit floats it welds,
/// splits and moves vertices, and resolves intersections. On a grid it only welds vertices and removes faces.
/// Parts that rounding does not spoil are left unchanged. Returns, for each part, the mesh that was replaced,
/// if any.
[[nodiscard]] std::vector<std::optional<Mesh>> make_fit(Scene& scene, const Purpose& purpose,
                                                        const io::Codec& codec,
                                                        const io::WriteSettings& write, Context& context);

/// Reads the file back and judges it. Adds a check for each assertion that does not hold. Returns true if all
/// hold.
[[nodiscard]] bool check_fit(const WrittenScene& file, const Purpose& purpose, const Scene& scene,
                             const io::WriteSettings& settings, Context& context);

} // namespace facetmill::write_stage
