#pragma once
// Draws plane sections to scale as SVG, DXF, GeoJSON and JSON.

#include "base/json.hpp"
#include "geometry/section/section.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <optional>
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

/// How sheets are put on paper.
struct DrawingLayout {
    enum class Kind {
        sheets,   ///< next to each other, in the frame of their plane
        contours, ///< over each other as lines; level planes are seen from above
        profile   ///< over each other as lines: the chainage from 0 to the right, the elevation upward
    };
    Kind kind = Kind::sheets;
    double scale = 1;        ///< of prints, 1 to this number
    double exaggeration = 1; ///< of elevations in profiles

    bool is_of_lines() const { return kind != Kind::sheets; }
};

struct Drawing {
    std::string title;
    Unit unit = Unit::unknown;
    std::vector<Sheet> sheets;
    UpAxis up = UpAxis::unknown; ///< unknown counts as z
    DrawingLayout layout{};
};

/// Points of a drawing on its paper.
class Paper {
  public:
    explicit Paper(const Drawing& drawing);

    /// A point of the sheet's frame. In `sheets`, it stays. In `contours`, it is the position in the map if
    /// the plane is level. In `profile`, it is the chainage and the exaggerated elevation.
    Vec2 at(const Sheet& sheet, const Vec2& p) const;
    std::vector<Vec2> at(const Sheet& sheet, polygon::Ring ring) const;

    /// The bounds of all points on the paper; empty without points.
    const Box& bounds() const { return bounds_; }
    /// The elevation of a sheet whose plane is level.
    std::optional<double> elevation(const Sheet& sheet) const;

  private:
    DrawingLayout layout_;
    Vec3 up_{0, 0, 1}, right_{1, 0, 0};
    double start_ = 0; ///< of the chainage, along right_
    Box bounds_;
};

/// The SVG has one group per sheet, in rows for DrawingLayout::sheets, otherwise over each other. Sizes are
/// in the scene's unit (mm if SVG lacks that unit), so that prints are to scale. Coordinates are relative to
/// the drawing's corner, because browsers draw in 32 bits. Filled outlines and holes form a path with
/// fill-rule nonzero. Contours are labelled with their elevation, and profiles have ticks.
[[nodiscard]] std::string to_svg(const Drawing& drawing);

/// DXF release 12: closed polylines, elevated to the plane's height above the origin. Each sheet has a layer
/// SECTION_n and a layer HATCH_n. Layers of contours are named by their elevation: CONTOUR_425_5. Coordinates
/// are on the paper (profiles are not elevated) and in the scene's unit, which $INSUNITS names.
[[nodiscard]] std::string to_dxf(const Drawing& drawing);

/// A feature for each contour: a LineString in world coordinates, seen along the up axis as for crop, with
/// the height last. Properties: part, height, closed, and elevation if the plane is level.
[[nodiscard]] std::string to_geojson(const Drawing& drawing);

/// All points and measures: {unit, sections: [{height, frame, parts: [{name, contours, hatch}]}]}.
[[nodiscard]] std::string to_json(const Drawing& drawing);

/// The drawing in the format of the file's extension: .svg, .dxf, .geojson or .json. Throws a usage error
/// (E-DRAWING) for other extensions.
[[nodiscard]] std::string drawing_for(const std::string& path, const Drawing& drawing);
/// Whether drawing_for knows the extension.
bool is_drawing(const std::string& path);

} // namespace facetmill::io
