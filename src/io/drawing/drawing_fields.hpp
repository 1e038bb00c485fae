#pragma once
// The measures of a section as the report and JSON drawings have them.

#include "geometry/section/section.hpp"
#include "options/fields.hpp"

namespace facetmill::io {

/// Origin, axes and normal of the frame.
void declare_frame_fields(DeclareFields<SectionFrame>& d);

/// A section as a whole, holes taken off (centroid null where it has none: see Section::moments), and its
/// contours with their measures, in the plane's frame and in the world. `points` is their count.
void declare_section_fields(DeclareFields<Section>& d);

} // namespace facetmill::io
