#pragma once
// The help and manual texts of write.

namespace facetmill::help::write {

inline constexpr const char* about =
    R"(Writes the scene to a mesh file; the scene itself passes on unchanged.)";

inline constexpr const char* details =
    R"(Files are first written under temporary names beside their targets and are all renamed together when
the run has succeeded; until then, existing files are unchanged. Each file is decoded again and
compared with the scene: the number of faces and lines, and how far positions moved (float32, Draco,
quantize). Units and the up axis are converted to the convention of the format; PLY, OBJ, OFF and
binary STL, which have none, state those of the scene in comments, which load reads. Formats without
nodes get all parts in world space. Meshes written to glTF anew get their triangles and vertices in
an order that is quick to draw (order), or in Draco's own. Attributes that the format cannot hold
are listed under attribute_changes in the report. An OBJ has its materials in an .mtl beside it, with the images
of their textures as files: colour, emission, normals, opacity, highlights, roughness and metalness (in one
image for both, as glTF has them, under map_Pr and map_Pm), where they lie (-o, -s) and whether they repeat
(-clamp). They are read back the same; W-TEXTURES and W-MTL name what MTL has no words for, W-ATTRIBUTE the
attributes that an OBJ has no place for. Points go to PLY, OBJ, OFF, glTF and Draco, lines to
PLY, OBJ and glTF, where they are not compressed; other formats get the faces beside them. A path that ends in tileset.json, or tiles: 3d, gives
3D Tiles: the parts as one mesh, cut and simplified to a tree of GLB files in a folder beside it, whose
tiles fit at every mix of levels; `geometricError` is the measured deviation. If the name ends in .gz or .zst, the file is
compressed.)";

} // namespace facetmill::help::write
