#pragma once
// 3D Tiles 1.1: a tileset of GLB files with replacing refinement (OGC 22-025r4). Tiles are z-up and their
// glTF is y-up, as both standards require.

#include "base/json.hpp"
#include "io/codec.hpp"

namespace facetmill::io::tileset {

/// Reads a tileset as a single part in the tileset's frame. It consists of the leaf tiles, and of ancestors
/// that ADD refinement keeps visible. Vertices at the same position are merged. Throws a malformed-input
/// error (E-GLTF, E-URI), a missing-file error (E-FILE), and a malformed-input error (E-TILESET) for
/// formats of contents other than GLB and nested tilesets.
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// The neighbours that reading opens: tiles, nested tilesets, and the subtree files that list tiles. Throws
/// the errors of read.
[[nodiscard]] std::vector<std::filesystem::path> named_files(const Input& tileset);

/// Writes all parts as a single mesh, as a pyramid (geometry/pyramid). World space must be in metres and
/// z-up. The tileset comes first, and the tiles are in a folder named after it. Skins, morph targets, part
/// names, and document contents other than materials are dropped.
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::tileset
