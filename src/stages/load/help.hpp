#pragma once
// The help and manual texts of load.

namespace facetmill::help::load {

inline constexpr const char* about = R"(Reads mesh files and adds their parts to the scene.)";

inline constexpr const char* details =
    R"(The content of a file determines its format.
If the content is not conclusive, the suffix decides.
Files that end in .gz or .zst are decompressed.
Each mesh, solid or object becomes a part. Its name is the name inside the file, or else the name of
the file.
Names are made unique.

The scene takes its unit and up axis from the first file that has them.
Later files are converted to them.
OBJ and OFF files can state both in comments in the first lines (`# unit: mm`, `# up: z`).
PLY and binary STL files can state both in the header.

Lines (l in OBJ, edges in PLY, line primitives in glTF, beams in 3MF) become separate parts.
Stages that work on faces leave them unchanged.
Lines and points next to triangles in one glTF mesh get their own mesh and node.
The option `lines` turns lines into tubes.
Consecutive lines become one closed tube with mitred corners, which ends where a line ends or more
than two lines meet.

Colours (COLOR_0) are linear in a scene, as in glTF.
PLY, OFF, OBJ, STL, 3MF and Draco files hold sRGB colours. load converts them to linear colours, and
write converts them back.
8-bit colours become 16-bit colours, because 8 bits cannot hold all dark tones of linear colours.
Colours of materials in an .mtl (Kd, Ke) are linear, as Blender reads and writes them.

Broken meshes are loaded unchanged.
A malformed file is refused, and the error gives the line or byte.
Files with coordinates that are not finite are also refused, unless not_finite: drop removes these
vertices.
Unknown attributes, such as quality and confidence, may contain nan, which means no value.
The stage render shows nan as "no value".
When split, clip or simplify mix nan with numbers, the result is nan.
Formats that cannot store nan get 0 (W-NAN).)";

} // namespace facetmill::help::load
