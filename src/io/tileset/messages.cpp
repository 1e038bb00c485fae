#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages tileset_messages{
    {"E-TILESET",
     "facetmill cannot read this 3D Tiles tileset. It has a required extension, content other than GLB and "
     "tilesets, a tileset nested in itself, or a broken subtree file of an implicit tiling.",
     "Load the files of its tiles one by one. facetmill reads explicit and implicit tilesets of GLB files.",
     ErrorKind::malformed},
    {"W-GEOCENTRIC",
     "A tileset has projected coordinates, such as UTM. Globe viewers read the root's transform as "
     "geocentric coordinates (ECEF), so they show the tiles far from their position.",
     "Use `transform: {crs: \"EPSG:25832\"}` before `write`, with the coordinate system of the mesh. Or use "
     "`transform: {centre: true}`, and give the latitude and longitude with `place`."},
};

} // namespace facetmill
