#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages footprint_messages{
    {"E-DXF", "A DXF file with outlines is malformed.",
     "Save it as a text DXF with closed polylines, or lines and arcs whose ends meet.", ErrorKind::malformed},
    {"E-GEOJSON", "A GeoJSON file is malformed, or contains no polygon.",
     "Save the outline as a Polygon or MultiPolygon.", ErrorKind::malformed},
    {"E-WKT",
     "The WKT text of an outline is malformed.",
     "Write for example `POLYGON ((0 0, 1 0, 1 1))`.",
     {ErrorKind::malformed, ErrorKind::usage}},
    {"W-FOOTPRINT",
     "Parts of a footprint's file are left out: lines of a DXF that enclose nothing, hatches, hidden "
     "entities, lines and points of a GeoJSON, or a ring that repeats another one. Or a GeoJSON states that "
     "it "
     "is in degrees of longitude and latitude.",
     "Join the ends of lines that belong to the outline in the CAD program. Convert degrees to the "
     "coordinate "
     "system of the mesh. Ignore this warning otherwise."},
};

} // namespace facetmill
