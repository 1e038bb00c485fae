#pragma once
// Outlines to crop by, from GeoJSON, WKT and DXF.

#include "geometry/polygon/polygon.hpp"
#include "io/bytes.hpp"

namespace facetmill::io {

using FootprintRings = std::vector<std::vector<Vec2>>;

/// The rings of all polygons in a file, by its content: GeoJSON (Polygon and MultiPolygon, alone or in
/// features and collections), WKT (POLYGON and MULTIPOLYGON, one or several), or DXF as text (closed
/// LWPOLYLINE and POLYLINE, CIRCLE among the drawing's entities, also drawn from behind; arcs in segments of
/// at most 5 degrees). Heights are left out, and so is what is no polygon. Throws malformed (E-GEOJSON,
/// E-WKT, E-DXF) with the line or the reason, E-FOOTPRINT when there is no polygon.
FootprintRings read_footprint(const Input& input);

/// The same of a text in WKT. name: for messages.
FootprintRings parse_wkt(std::string_view text, const std::string& name);

/// Whether a text begins as WKT does; of what is no polygon, only parse_wkt tells.
bool is_wkt(std::string_view text);

} // namespace facetmill::io
