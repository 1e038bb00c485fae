#pragma once
// 3D Tiles 1.1: a tileset of GLB files with explicit tiling, refined by replacing (OGC 22-025r4). Tiles are
// z-up, and their glTF is y-up, as both standards want it.

#include "base/json.hpp"
#include "io/codec.hpp"

namespace facetmill::io::tileset {

/// One part: the tiles without tiles below them, and what tiles that are refined by ADD have above them, in
/// the tileset's frame; vertices at one place are one. Throws malformed (E-GLTF, E-URI), missing (E-FILE),
/// and malformed (E-TILESET) for what is not read: implicit tiling, tilesets in tilesets, formats other than
/// GLB.
Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// The files that read opens, as the tileset names them. Throws as read does.
std::vector<std::string> uris_of(const Json& tileset);

/// All parts as one mesh in the world, which must be in metres and z-up, as a pyramid (geometry/pyramid); the
/// tileset comes first, the tiles below a folder that is named after it. Skins, morph targets, names of parts
/// and what documents have beside materials stay behind.
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::tileset
