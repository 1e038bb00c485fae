#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages io_messages{
    {"E-ASSET-ROOT",
     "The folder given by `--asset-root` or `load: {asset_root: ...}` does not exist, or is a file.",
     "Give the folder with all files that the mesh file refers to.", ErrorKind::missing},
    {"E-CSV",
     "A table is malformed: a cell is not a finite number, or a row has too few or too many columns.",
     "Correct the row given in the message.", ErrorKind::malformed},
    {"E-DIRECTORY",
     "A path is a directory where a file is expected, or a directory cannot be created.",
     "Give the path of a file, or write elsewhere with `--output-dir`.",
     {ErrorKind::missing, ErrorKind::output}},
    {"E-EMPTY",
     "A file is empty or has no vertices, or a stage has nothing to write.",
     "Check the results of the previous stages. `when: {vertices: {min: 1}}` skips a write.",
     {ErrorKind::malformed, ErrorKind::stage}},
    {"E-ENCODING", "A text file is neither valid UTF-8 nor complete UTF-16.", "Save it as UTF-8.",
     ErrorKind::malformed},
    {"E-EXTENSION", "A file requires a glTF or 3MF extension that facetmill does not support.",
     "Export the file without that extension.", ErrorKind::malformed},
    {"E-FILE", "An input does not exist.",
     "Check the path. Paths in a pipeline are relative to the pipeline file. Paths given with `-D` are "
     "relative to the working directory.",
     ErrorKind::missing},
    {"E-FORMAT", "The format of a file is unknown, or cannot be read or written.",
     "Use the option `format`. Run `facetmill formats` to list the formats.", ErrorKind::usage},
    {"E-GZIP", "A gzip file is damaged or truncated.", "Download or compress it again.",
     ErrorKind::malformed},
    {"E-NAN", "A coordinate in a file is not a finite number.",
     "Drop such vertices and their faces with `load: {not_finite: drop}`, then close the holes with `clean: "
     "{holes: minimal}`. Or export the file again.",
     ErrorKind::malformed},
    {"E-PERMISSION", "The permissions of an input do not allow facetmill to read it.",
     "Check the permissions of the file.", ErrorKind::missing},
    {"E-READBACK", "A written file differs from the scene when facetmill reads it back.",
     "Report this as a bug in facetmill unless the disk is faulty. Existing outputs are unchanged.",
     ErrorKind::output},
    {"E-SIZE", "A file is too large to read or write.",
     "Uncompress it first, write another format, or split the scene.", ErrorKind::limit},
    {"E-TAR", "A tar archive is damaged or truncated.", "Make the archive again, or download it again.",
     ErrorKind::malformed},
    {"E-URI", "A glTF file refers to a file outside its directory.",
     "Copy the file into this folder, or give a folder that contains all files, with `--asset-root DIR` or "
     "`load: {path: ..., asset_root: DIR}`. facetmill never follows absolute paths, URLs, or links that lead "
     "out of the folder.",
     ErrorKind::malformed},
    {"E-ZIP", "A zip archive (3MF) is damaged, truncated or encrypted.",
     "Export it again, or download it again.", ErrorKind::malformed},
    {"E-ZSTD", "A zstd file is damaged or truncated, or needs more memory than zstd allows by default.",
     "Compress it again without `--long`.", ErrorKind::malformed},
    {"W-ANIMATION",
     "The file format cannot store animations and skins, so the mesh is written in its rest pose.",
     "Write glTF (.glb) to keep them. Ignore this warning if you need only the mesh."},
    {"W-ATTRIBUTE",
     "An attribute is not read because of its type, or not written because OBJ cannot store it.",
     "Export it as float, or write glTF or PLY. Ignore this warning if you do not need the attribute."},
    {"W-FACES",
     "Invalid faces are skipped: they have fewer than three corners, or use the same vertex twice.",
     "Check whether this leaves holes in the surface, and ignore this warning otherwise."},
    {"W-FORMAT", "The content of a file does not match its suffix.", "Rename the file."},
    {"W-IMAGE",
     "An image or texture that a file refers to is missing, outside the file's directory, of an unsupported "
     "kind, or broken. Broken means a wrong header or truncated data. A broken image is written unchanged.",
     "Put the image in the folder of the file as PNG or JPEG, and export a broken one again. To read "
     "`../wood.png`, allow a common folder with `--asset-root DIR` or `load: {path: ..., asset_root: DIR}`."},
    {"W-LOST",
     "The format cannot store metadata (title, licence), cameras, lights, contents of extensions, "
     "or "
     "extras, such as part numbers of 3MF.",
     "Write glTF (.glb) to keep them. PLY, OBJ and OFF keep metadata as comments. Ignore this warning if you "
     "need only the mesh."},
    {"W-MATERIAL",
     "The format cannot store the material of points or lines, or it has no materials and cannot store their "
     "colours.",
     "Write glTF to keep them. OBJ keeps materials of lines, and OBJ and 3MF keep materials of faces."},
    {"W-MERGED",
     "Several glTF documents are written to one file, and some of their contents are lost. If a document has "
     "animation pointers or extensions with unknown references, only its meshes and materials are kept.",
     "If you need the animations or cameras of the file in the message, load it alone and write it to a "
     "separate file."},
    {"W-NAME",
     "The name of a part or material has control characters, such as a line end, that the format does not "
     "allow in names. They are replaced by blanks or the sign for unknown characters.",
     "Write glTF to keep them, or rename the part or material."},
    {"W-NAN",
     "Values of an attribute are not finite numbers. Reading sets such normals, colours and similar values "
     "to 0. Other attributes keep NaN as the sign for no value, and formats that cannot hold NaN get 0.",
     "Export the file again if you need the attribute, or write PLY, which keeps NaN."},
    {"W-NOT-FINITE",
     "`load: {not_finite: drop}` left out vertices whose coordinates are not finite numbers, and the faces "
     "and lines that use them.",
     "Close the holes that this leaves with `clean: {holes: minimal}`."},
    {"W-OVERRIDDEN",
     "`load` uses the unit or up axis that you gave instead of the one that the format or the file states.",
     "Remove the option. To convert, use `transform: {unit: ...}` or `write: {unit: ...}`."},
    {"W-PARTS", "Several parts become one mesh without their names, because the format holds one mesh.",
     "Write glTF, OBJ or 3MF to keep them. `foreach: {part: \"*\"}` writes a file for each."},
    {"W-SIZE", "A part is so large or so small that products of its coordinates may overflow or underflow.",
     "Bring its size near 1 with `transform: {scale: ...}`; the message has the number to type."},
    {"W-TRAILING",
     "facetmill skips bytes after the last item that a file promises, for example a second mesh.",
     "Check that the mesh is complete, for example with `facetmill info`. If it is, the exporter has a bug."},
    {"W-SKIPPED", "facetmill skips data in a file that a mesh cannot represent.",
     "Ignore this warning if you do not need the data that the message names."},
    {"W-TEXTURES",
     "Textures are changed or not written, because the format cannot hold them or facetmill does not write "
     "them in this format. For OBJ, the message names each texture and the reason.",
     "Write glTF to keep them. `textures: {format: png}` converts WebP, which OBJ cannot reference, to PNG."},
    {"W-UNITS",
     "A scene without a unit meets a scene, format or option with a unit, and facetmill uses the numbers "
     "unchanged. Or a comment of a file states an unknown unit.",
     "Give the unit of the file: `load: {unit: mm}`, or `-D unit=mm` for a built-in pipeline."},
    {"W-UP", "A scene without an up axis gets one, without being rotated.",
     "Give the up axis: `load: {up: z}`, or `-D up=z` for a built-in pipeline."},
};

} // namespace facetmill
