#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages gltf_messages{
    {"E-BUFFER", "A glTF buffer, buffer view or accessor extends beyond the end of its data.",
     "Export the file again. It is truncated, or its .bin belongs to another version of it.",
     ErrorKind::malformed},
    {"E-DRACO",
     "Draco data cannot be decoded, or a mesh cannot be encoded.",
     "Export the input again without Draco, or write the output without `draco`.",
     {ErrorKind::malformed, ErrorKind::stage, ErrorKind::bug}},
    {"E-GLB", "The container of a GLB file is malformed.",
     "Export the file again. It is truncated or is not a GLB.", ErrorKind::malformed},
    {"E-GLTF", "A glTF document breaks the rules of its format at the position in the message.",
     "Export the file again. The Khronos validator gives details.", ErrorKind::malformed},
    {"E-INDEX", "An index in a glTF file refers to an element that does not exist.", "Export the file again.",
     ErrorKind::malformed},
    {"E-JSON", "The JSON of a glTF file cannot be parsed.", "Export the file again.", ErrorKind::malformed},
    {"E-MESHOPT",
     "Data compressed with EXT_meshopt_compression or KHR_meshopt_compression is damaged and cannot be "
     "decoded.",
     "Export the input again.", ErrorKind::malformed},
    {"E-NODES", "A glTF node is its own ancestor.", "Export the file again.", ErrorKind::malformed},
    {"E-VERSION", "The version of a glTF or GLB file is not 2.",
     "Export it as glTF 2.0, or convert it: `npx gltf-pipeline -i old.gltf -o new.gltf`.",
     ErrorKind::malformed},
    {"W-EXTENSION",
     "A glTF extension is dropped, because its data has changed or facetmill does not support it.",
     "Ignore this warning if you do not need the extension that the message names."},
    {"W-GLTF",
     "A glTF document breaks rules of its format that do not prevent reading. Wrong minima and maxima are "
     "corrected.",
     "Export the file again. The Khronos validator lists all broken rules."},
    {"W-INCOMPLETE", "A glTF primitive has extra indices after its last triangle.",
     "Ignore this warning. The exporter has a bug."},
    {"W-INSTANCES", "Instances of a glTF mesh now differ, so they are written as separate meshes.",
     "Ignore this warning if the larger file is acceptable."},
    {"W-INSTANCING",
     "A glTF node places many instances of its mesh (EXT_mesh_gpu_instancing). Stages process them as one "
     "part, at the position of the largest instance.",
     "Write glTF to keep the instances. `load: {path: ..., instances: expand}` makes each one a part, and "
     "`optimize: {instance: true}` makes instances of parts again."},
    {"W-LODS", "You asked `write` to link levels of detail, but the scene has none.",
     "Create levels of detail with `simplify: {lods: [50%, 10%]}`."},
    {"W-MANIFOLD", "EXT_mesh_manifold cannot be read or written for a part.",
     "Read the reason in the message. `clean` makes a mesh manifold."},
    {"W-MESHOPT",
     "The input is compressed with EXT_meshopt_compression or KHR_meshopt_compression, but the output is "
     "not.",
     "Use `write: {meshopt: true}` or `write: {draco: true}` to make the file smaller."},
    {"W-MORPH", "A mesh has lost its morph targets, so their animation is not written.",
     "Ignore this warning if you do not need the morph targets."},
    {"W-NODES", "A glTF node has two parents, and facetmill places it under the first.",
     "Export the file again."},
    {"W-SCENES",
     "Some parts of a glTF file are in no scene, or not in the scene that viewers show. facetmill loads, "
     "measures, changes and writes them like the others.",
     "Exclude them with the common key `only`, or export only the scene."},
    {"W-SKIN",
     "A part in bind pose loses its skin, because it was joined with others or moved away from its skeleton.",
     "Process all parts of a skeleton in the same way, or ignore this warning if you do not animate the "
     "part."},
    {"W-TEXTURE",
     "A picture is drawn without a texture. Its image is missing, broken, larger than 2^26 pixels, of an "
     "unsupported kind, or beyond a total of 512 MiB of images.",
     "Use PNG, JPEG or WebP of at most 8192 x 8192 pixels. The plain colour is drawn instead of the "
     "texture."},
    {"W-TRANSFORM", "A glTF node cannot be moved like its part, or moves separately from its animation.",
     "Use `merge` before the stage, because `merge` removes animations."},
};

} // namespace facetmill
