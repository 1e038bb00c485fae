#pragma once
// What the help and the manual say about load.

namespace facetmill::help::load {

inline constexpr const char* about = R"(Reads mesh files and adds their parts to the scene.)";

inline constexpr const char* details =
    R"(The format of a file is recognised by its content, or else by its suffix; a .gz file is
decompressed. Each mesh, solid or object in a file becomes a part, named as in the file or after the
file; names are made unique. The scene takes its unit and up axis from the first file loaded, and
later files are converted to them. Lines (l of OBJ, line primitives of glTF) are no surface and are
skipped, unless lines gives them a thickness: lines that follow one another become one closed tube
with mitred corners, which ends where a line ends or more than two meet. Broken meshes are loaded as
they are; a malformed file is refused, with the line or byte at fault.)";

} // namespace facetmill::help::load
