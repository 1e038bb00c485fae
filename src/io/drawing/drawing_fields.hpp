#pragma once
// The measures of a section in the report and in JSON drawings.

#include "geometry/section/section.hpp"
#include "options/fields.hpp"

namespace facetmill::io {

/// Origin, axes and normal of the frame.
void declare_frame_fields(DeclareFields<SectionFrame>& d);

/// A whole section with holes subtracted (centroid null if undefined: see Section::moments), and its
/// contours. Both have measures in the plane's frame and in world space. `points` is their count.
void declare_section_fields(DeclareFields<Section>& d);

} // namespace facetmill::io
