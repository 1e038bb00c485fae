#pragma once
// Reads crop outlines from GeoJSON, WKT and DXF.

#include "geometry/polygon/polygon.hpp"
#include "io/bytes.hpp"

namespace facetmill::io {

using FootprintRings = std::vector<std::vector<Vec2>>;

/// The rings of all polygons in a file, detected by content. GeoJSON: Polygon and MultiPolygon, alone or in
/// features and collections. WKT: POLYGON and MULTIPOLYGON, one or several. Text DXF: closed LWPOLYLINE and
/// POLYLINE, and CIRCLE, among the drawing's entities, even if drawn from the back. Arcs become segments of
/// at most 5 degrees. Ignores heights and other geometry. Throws a malformed-input error (E-GEOJSON, E-WKT,
/// E-DXF) with the line or the reason, or E-FOOTPRINT without any polygon.
[[nodiscard]] FootprintRings read_footprint(const Input& input);

/// The rings of a WKT text. name: the name for messages.
[[nodiscard]] FootprintRings parse_wkt(std::string_view text, const std::string& name);

/// Whether a text begins like WKT; only parse_wkt refuses types other than polygons.
bool is_wkt(std::string_view text);

} // namespace facetmill::io
