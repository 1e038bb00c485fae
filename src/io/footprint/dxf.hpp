#pragma once
// Text DXF as groups: entities, blocks, layers and the unit, after Autodesk's DXF reference.

#include "geometry/polygon/polygon.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

struct DxfGroup {
    std::int64_t code = 0;
    std::string_view value;
    std::int64_t line = 0; ///< of the value
};

struct DxfEntity {
    std::string_view type;
    std::int64_t line = 0;
    std::size_t first = 0, end = 0; ///< into DxfFile::groups
};

/// A range of DxfFile::entities.
struct DxfBlock {
    Vec2 base;
    std::size_t first = 0, end = 0;
};

/// Names are in lower case. Views point into the text.
struct DxfFile {
    std::vector<DxfGroup> groups;
    std::vector<DxfEntity> entities; ///< POLYLINE is followed by its VERTEX entities
    DxfBlock drawing;                ///< the entities of the drawing itself
    std::map<std::string, DxfBlock> blocks;
    std::set<std::string> hidden_layers; ///< off or frozen
    double metres = 0;                   ///< one unit of the drawing ($INSUNITS); 0: not stated
};

/// Throws malformed (E-DXF) with the line.
[[nodiscard]] DxfFile parse_dxf(std::string_view text, const std::string& name);

/// Curves of the drawing as polylines, at their places: blocks are inserted.
struct DxfCurve {
    std::vector<Vec2> points;
    bool closed = false;
    double size = 0; ///< the radius of an arc, else the diagonal of the bounds
    std::string_view type;
    std::uint32_t layer = 0;
};

struct DxfCurves {
    std::vector<DxfCurve> curves;
    std::map<std::string, std::size_t> unused; ///< entities by type that are no curves in the plane
    std::size_t hidden = 0; ///< entities that are invisible, on hidden layers, or on a paper sheet
};

/// Arcs become segments of at most 5 degrees, and splines turn by at most that at a point. Heights count as
/// 0. Throws malformed (E-DXF), also for a closed outline that is tilted, and limit (E-SIZE).
[[nodiscard]] DxfCurves curves_of(const DxfFile& file, const std::string& name);

} // namespace facetmill::io
