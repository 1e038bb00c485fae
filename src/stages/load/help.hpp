#pragma once
// The help and manual texts of load.

namespace facetmill::help::load {

inline constexpr const char* about = R"(Reads mesh files and adds their parts to the scene.)";

inline constexpr const char* details =
    R"(The format of a file is determined from its content or, if that is not conclusive, from its suffix;
a .gz or .zst file is decompressed. Each mesh, solid or object in a file becomes a part, named as in the
file or after the file; names are made unique. The scene takes its unit and up axis from the first
file that has them, and later files are converted to them. Comments in the first lines of OBJ and OFF (`# unit: mm`,
`# up: z`) and in the headers of PLY and binary STL state them. Lines (l of OBJ, edges of PLY, line primitives of
glTF) are parts of their own, which stages that work on faces leave as they are; lines and points beside triangles
in one glTF mesh get meshes and nodes of their own. The option `lines` gives lines a thickness instead: consecutive
lines become one closed tube with mitred corners, which ends where a line ends or where more than two
lines meet. Broken meshes
are loaded as they are; a malformed file is refused, and the error names the line or byte at fault.
Coordinates that are no finite numbers refuse a file, too, unless not_finite: drop leaves out their
vertices. In attributes that have no meaning to facetmill (quality, confidence), nan stays and says that
there is no number: render shows it as "no value", what is mixed with it (split, clip, simplify) has no
number either, and formats that cannot hold it get 0 (W-NAN).)";

} // namespace facetmill::help::load
