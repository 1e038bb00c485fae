#pragma once
// The measures of a section in the report and in JSON drawings.

#include "geometry/section/section.hpp"
#include "options/fields.hpp"

namespace facetmill::io {

/// Declares the origin, axes and normal of the frame.
void declare_frame_fields(DeclareFields<SectionFrame>& d);

/// Declares a whole section, with holes subtracted, and its contours. Both have measures in the plane's
/// frame and in world space. The centroid is null if undefined (see Section::moments). `points` is a count.
void declare_section_fields(DeclareFields<Section>& d);

} // namespace facetmill::io
