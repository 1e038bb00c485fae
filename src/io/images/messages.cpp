#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages images_messages{
    {"E-KTX",
     "The program ktx or toktx, which encodes KTX2 textures, is not installed, failed or took too long.",
     "Install KTX-Software (https://github.com/KhronosGroup/KTX-Software/releases), or set the variable "
     "FACETMILL_KTX to the program. `textures: {format: webp}` needs no other program.",
     {ErrorKind::usage, ErrorKind::stage}},
    {"E-AVIF",
     "This build has no libavif, or libavif cannot write the image.",
     "Use `textures: {format: webp}`, or install libavif-dev and build facetmill again. `facetmill --version "
     "--json` says whether a build has libavif.",
     {ErrorKind::usage, ErrorKind::stage}},
};

} // namespace facetmill
