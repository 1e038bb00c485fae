#pragma once
// Implicit tiling of 3D Tiles 1.1 (OGC 22-025r4, "Implicit Tiling"). Level and coordinates in a quadtree or
// octree identify tiles, templates name their files, and subtree files list the existing tiles.
//
// facetmill's trees halve meshes, not space. The digit of a child is used as its position in the quadtree.
// The subtree files give each tile's box and error, which replace the values from halving space.

#include "base/json.hpp"
#include "io/gltf/document/container.hpp"
#include "io/tileset/tiles.hpp"

namespace facetmill::io::tileset {

/// The file of a tile or subtree from its path: `{level}-{x}-{y}`.
[[nodiscard]] std::string implicit_name(const std::string& name);

/// Makes the root of a tileset implicit, and adds the schema of the metadata in subtree files.
void add_implicit_tiling(Json& tileset, const std::vector<TreeTile>& tiles, const std::string& title);

/// Subtree files of up to six levels each, sorted from the root down.
[[nodiscard]] std::vector<OutputFile> subtree_files(const std::vector<TreeTile>& tiles,
                                                    const std::string& title);

/// The contents of an implicit tile when every tile is refined, and the subtree files that list them.
struct ImplicitContents {
    std::vector<std::string> uris;
    std::vector<Input> files;
};
/// tile: has implicitTiling. replaces: only tiles without children are shown. Throws a malformed-input error
/// (E-GLTF, E-TILESET, E-JSON, E-URI), a missing-file error (E-FILE), and a limit error (E-LIMIT) for more
/// tiles than files could hold.
[[nodiscard]] ImplicitContents read_implicit(const gltf::JsonCursor& tile, bool replaces,
                                             const Input& tileset);

} // namespace facetmill::io::tileset
