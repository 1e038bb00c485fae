#pragma once
// 3D Tiles 1.1: a tileset of GLB files with replacing refinement (OGC 22-025r4). Tiles are z-up and their
// glTF is y-up, as both standards require.

#include "base/json.hpp"
#include "io/codec.hpp"

namespace facetmill::io::tileset {

/// A single part in the tileset's frame: the leaf tiles, and the ancestors that ADD refinement keeps
/// visible. Vertices at the same position are merged. Throws malformed (E-GLTF, E-URI), missing (E-FILE),
/// and malformed (E-TILESET) for unsupported content: nested tilesets and formats other than GLB.
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// The neighbours that reading opens: the tile files as the tileset names them, and the subtree files read
/// to find these. Throws as read.
struct NamedFiles {
    std::vector<std::string> uris;
    std::vector<std::filesystem::path> read;
};
[[nodiscard]] NamedFiles named_files(const Input& tileset);

/// Writes all parts as a single mesh, as a pyramid (geometry/pyramid). World space must be in metres and
/// z-up. The tileset comes first, and the tiles are in a folder named after it. Skins, morph targets, part
/// names, and document contents other than materials are dropped.
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::tileset
