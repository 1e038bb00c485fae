#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages write_messages{
    {"E-UP", "The scene has no up axis, so it cannot be rotated.",
     "Give the up axis when loading: `load: {up: z}`.", ErrorKind::stage},
    {"W-DRACO",
     "A glTF file is not compressed, because Draco in glTF compresses only faces, and the scene has none.",
     "Compress points and lines with `write: {meshopt: true}`."},
    {"W-ORIGIN",
     "A part keeps its origin although `write: {origin: ...}` gives a different one, because it has a skin, "
     "an animation or instances.",
     "If you need the new origin, use `merge` before `write`, because it removes skins and animations."},
    {"W-ROUNDED",
     "Rounding or a limit of the format gave a written file more defects than the scene. Or it moved points "
     "by more than a millionth of the diagonal.",
     "Use a format with more digits (`precision: full`) or more Draco bits, and move distant parts to the "
     "origin (`transform: {centre: true}`)."},
};

} // namespace facetmill
