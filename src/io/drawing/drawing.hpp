#pragma once
// Drawings of plane sections, to scale: SVG, DXF and JSON.

#include "base/json.hpp"
#include "geometry/section/section.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <string>

namespace facetmill::io {

/// A part's section and its hatching.
struct DrawnPart {
    std::string name;
    Section section;
    std::vector<polygon::Segment> hatch; ///< in the section's frame
};

/// What one plane cuts.
struct Sheet {
    double height = 0; ///< along the normal from the plane given
    SectionFrame frame;
    std::vector<DrawnPart> parts;
};

struct Drawing {
    std::string title;
    Unit unit = Unit::unknown;
    std::vector<Sheet> sheets;
};

/// One group a sheet, side by side in rows, each in its plane's frame with v upwards. Sizes are in the
/// scene's unit (mm where SVG has no such unit), so that a print is to scale. Outlines and holes are one path
/// with fill-rule nonzero.
std::string to_svg(const Drawing& drawing);

/// DXF release 12: closed polylines, one layer a sheet (SECTION_1, ... with HATCH_1, ...), elevated to the
/// plane's height above the origin; coordinates of the plane's frame in the scene's unit, which $INSUNITS
/// names.
std::string to_dxf(const Drawing& drawing);

/// All points and measures: {unit, sections: [{height, frame, parts: [{name, contours, hatch}]}]}.
std::string to_json(const Drawing& drawing);

/// By the file's extension: .svg, .dxf or .json. Throws usage (E-DRAWING) for others.
std::string drawing_for(const std::string& path, const Drawing& drawing);
/// Whether drawing_for knows the extension.
bool is_drawing(const std::string& path);

} // namespace facetmill::io
