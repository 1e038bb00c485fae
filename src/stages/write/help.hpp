#pragma once
// The help and manual texts of write.

namespace facetmill::help::write {

inline constexpr const char* about =
    R"(Writes the scene to a mesh file. The scene itself passes on unchanged.)";

inline constexpr const char* details =
    R"(Files are first written under temporary names.
They are all renamed together when the run succeeds, so existing files do not change before that.
Each file is read back and compared with the scene: the number of faces and lines, and how far
positions moved (float32, Draco, quantize).

Units and the up axis are converted to the convention of the format.
PLY, OBJ, OFF and binary STL have no convention.
They store the scene's unit and axis in comments, which load reads.
Formats without nodes store all parts in world space.
New meshes in glTF get an order of triangles and vertices that is fast to draw (order), or the order
that Draco chooses.
Under attribute_changes, the report lists attributes that the format cannot store.

An OBJ file stores its materials in an .mtl file and the images of textures as separate files.
It supports colour, emission, normals, opacity, highlights, roughness and metalness.
Roughness and metalness share one image, as in glTF (map_Pr and map_Pm).
The .mtl also stores the offset, scale and repetition of textures (-o, -s, -clamp).
The stage load reads all of this back unchanged.
W-TEXTURES and W-MTL list material properties that MTL cannot store, and W-ATTRIBUTE lists
attributes that OBJ cannot store.

USDZ, for phones, stores nodes, shared meshes, normals, UVs, colours and materials, with textures as
PNG or JPEG.
WebP and AVIF become PNG.
Skins, morph targets and animations are not written (W-ANIMATION).

PLY, OBJ, OFF, glTF and Draco store points.
PLY, OBJ and glTF store lines.
In glTF, meshopt compresses points and lines, and Draco does not.
Other formats store only the faces.

A path that ends in tileset.json, or tiles: 3d, writes 3D Tiles.
All parts become a single mesh, which is cut and simplified into a tree of GLB files in a folder
next to the tileset.
Tiles of different levels fit together.
The `geometricError` of tiles is the measured deviation.
A name that ends in .gz or .zst compresses the file.)";

} // namespace facetmill::help::write
