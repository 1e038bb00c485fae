#pragma once
// Closed outlines of a DXF file. For io/footprint only.

#include "io/footprint/footprint.hpp"

namespace facetmill::io {

/// Whether a text begins with a DXF group: a number on a line, and 0 SECTION soon after.
bool is_dxf(std::string_view text);
FootprintRings parse_dxf(std::string_view text, const std::string& name);

} // namespace facetmill::io
