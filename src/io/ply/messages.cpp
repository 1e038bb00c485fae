#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages ply_messages{
    {"E-PLY", "A PLY file is malformed or truncated.",
     "Export the file again. The message names the element or line.", ErrorKind::malformed},
    {"W-SPLATS",
     "A PLY file has Gaussian splats: points with a rotation, three scales and spherical harmonics. "
     "facetmill "
     "reads them as points and keeps these values, but no stage turns or scales them.",
     "Use stages that select points, such as crop, and write PLY. Turn and scale splats with a splat editor, "
     "for example SuperSplat."},
};

} // namespace facetmill
