#pragma once
// The sections of a scene's parts as a drawing.

#include "geometry/section/section.hpp"
#include "io/drawing/drawing.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// The planes: one alone without spacing and count, else as geometry/section_stack says over the extent of
/// the parts selected. Throws stage (E-SECTION) for a spacing that comes to 0, and what stack_of throws.
Stack stack_for(const Scene& scene, const Plane& plane, const std::optional<Length>& spacing,
                const std::optional<std::int64_t>& count, Context& context);

/// A sheet for each plane, with the sections of the parts selected and their hatching. Throws what section
/// and hatch throw, and limit (E-HATCH) for a stack that would take more than five
/// million lines in a part.
io::Drawing draw_sections(const Scene& scene, const Plane& plane, const Stack& stack,
                          const std::optional<polygon::HatchSettings>& hatching, Context& context);

} // namespace facetmill
