#pragma once
// 3D Tiles 1.1: a tileset of GLB files refined by replacing (OGC 22-025r4). Tiles are
// z-up, and their glTF is y-up, as both standards want it.

#include "base/json.hpp"
#include "io/codec.hpp"

namespace facetmill::io::tileset {

/// One part: the tiles without tiles below them, and what tiles that are refined by ADD have above them, in
/// the tileset's frame; vertices at one place are one. Throws malformed (E-GLTF, E-URI), missing (E-FILE),
/// and malformed (E-TILESET) for what is not read: tilesets in tilesets, formats other than GLB.
Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// The files that read opens beside the tileset: those of tiles as the tileset names them, and the paths of
/// those that had to be read to know that. Throws as read does.
struct NamedFiles {
    std::vector<std::string> uris;
    std::vector<std::filesystem::path> read;
};
NamedFiles named_files(const Input& tileset);

/// All parts as one mesh in the world, which must be in metres and z-up, as a pyramid (geometry/pyramid); the
/// tileset comes first, the tiles below a folder that is named after it. Skins, morph targets, names of parts
/// and what documents have beside materials stay behind.
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::tileset
