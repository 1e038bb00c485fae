#pragma once
// Draws plane sections to scale as SVG, DXF and JSON.

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
    std::vector<polygon::Segment> hatch; ///< hatching in the section's frame
};

/// The section of a single plane.
struct Sheet {
    double height = 0; ///< the distance from the given plane along the normal
    SectionFrame frame;
    std::vector<DrawnPart> parts;
};

struct Drawing {
    std::string title;
    Unit unit = Unit::unknown;
    std::vector<Sheet> sheets;
};

/// The SVG has one group per sheet, arranged in rows, in the frame of the sheet's plane with v up. Sizes are
/// in the scene's unit (mm if SVG lacks that unit), so that prints are to scale. Outlines and holes form a
/// path with fill-rule nonzero.
[[nodiscard]] std::string to_svg(const Drawing& drawing);

/// DXF release 12: closed polylines, elevated to the plane's height above the origin. Each sheet has a layer
/// SECTION_n and a layer HATCH_n. Coordinates are in the plane's frame and the scene's unit, which $INSUNITS
/// names.
[[nodiscard]] std::string to_dxf(const Drawing& drawing);

/// All points and measures: {unit, sections: [{height, frame, parts: [{name, contours, hatch}]}]}.
[[nodiscard]] std::string to_json(const Drawing& drawing);

/// The drawing in the format of the file's extension: .svg, .dxf or .json. Throws a usage error (E-DRAWING)
/// for other extensions.
[[nodiscard]] std::string drawing_for(const std::string& path, const Drawing& drawing);
/// Whether drawing_for knows the extension.
bool is_drawing(const std::string& path);

} // namespace facetmill::io
