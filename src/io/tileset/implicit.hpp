#pragma once
// Implicit tiling of 3D Tiles 1.1 (OGC 22-025r4, "Implicit Tiling"): tiles are known by level and place in a
// quadtree or octree, templates name their files, and subtree files say which there are.
//
// A tree of ours halves meshes, not space, so a child's digit is its place in the quadtree, and each tile has
// its own box and error in the subtree files, which replace those that halving space would give.

#include "io/tileset/tiles.hpp"

namespace facetmill::io::tileset {

/// The file of a tile or subtree by its place: `{level}-{x}-{y}` of its name.
std::string implicit_name(const std::string& name);

/// Makes the root of a tileset implicit, and adds the schema of what subtree files say of tiles.
void add_implicit_tiling(Json& tileset, const std::vector<TreeTile>& tiles, const std::string& title);

/// Files of up to six levels of the tree each, those nearer to the root first.
std::vector<OutputFile> subtree_files(const std::vector<TreeTile>& tiles, const std::string& title);

/// What an implicit tile shows when every tile is refined, and the files that say so.
struct ImplicitContents {
    std::vector<std::string> uris;
    std::vector<Input> files;
};
/// tile: has implicitTiling. replaces: a tile is shown only where none is below it. Throws malformed (E-GLTF,
/// E-TILESET, E-JSON, E-URI), missing (E-FILE), and limit (E-LIMIT) for more tiles than files could hold.
ImplicitContents read_implicit(const gltf::JsonCursor& tile, bool replaces, const Input& tileset);

} // namespace facetmill::io::tileset
