#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages bake_messages{
    {"E-BAKE-UV", "`bake` needs texture coordinates TEXCOORD_0 within the unit square on every part.",
     "Use `unwrap` before `bake`. Or exclude the part with the common key `only`.", ErrorKind::stage},
    {"E-BAKE-SOURCE", "`bake` has no surface to take values from.",
     "Load a mesh with faces before, or give one as `from`.", ErrorKind::stage},
    {"W-BAKE-FAR",
     "The surface is far from the source of `bake`, or looks in other directions, so values are smeared.",
     "Use `align` if a stage moved the scene. Use `bake` before the stage that moves it."},
    {"W-BAKE-OVERLAP", "Faces overlap in the texture, so they show the values of another face.",
     "Use `unwrap` before `bake`."},
};

} // namespace facetmill
