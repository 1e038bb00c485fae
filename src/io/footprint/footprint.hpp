#pragma once
// Reads crop outlines from GeoJSON, WKT and DXF.

#include "base/error.hpp"
#include "geometry/polygon/polygon.hpp"
#include "io/bytes.hpp"

namespace facetmill::io {

using FootprintRings = std::vector<std::vector<Vec2>>;

/// The contents of a file.
struct FootprintFile {
    FootprintRings rings;
    double metres = 0;           ///< one unit of the file; 0: not stated
    bool can_state_unit = false; ///< the format can
    std::vector<Diagnostic> warnings;
};

/// The rings of all polygons in a file, detected by content. GeoJSON: Polygon and MultiPolygon, alone or in
/// features and collections. WKT: POLYGON and MULTIPOLYGON, one or several. Text DXF: circles, ellipses,
/// closed polylines, and lines, arcs, splines and polylines whose ends meet, also in inserted blocks. Arcs
/// become segments of at most 5 degrees. Ignores heights. A ring that lies on another one is left out. Warns
/// (W-FOOTPRINT) of entities, geometries and rings that are left out, and of a GeoJSON in degrees. Throws
/// malformed (E-GEOJSON, E-WKT, E-DXF) with the line or the reason. Throws malformed (E-FOOTPRINT) without
/// any polygon, and if the lines of a DXF leave a gap or branch.
[[nodiscard]] FootprintFile read_footprint(const Input& input);

/// The rings of a WKT text. name: the name for messages.
[[nodiscard]] FootprintRings parse_wkt(std::string_view text, const std::string& name);

/// Whether a text begins like WKT; only parse_wkt refuses types other than polygons.
bool is_wkt(std::string_view text);

} // namespace facetmill::io
