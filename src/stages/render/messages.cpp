#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages render_messages{
    {"E-DIRECTION", "A direction has zero length.", "Give three numbers that are not all 0.",
     ErrorKind::usage},
    {"E-PICTURE", "The name of an image does not end in .png.", "Use a name that ends in .png.",
     ErrorKind::usage},
    {"W-BLANK", "The scene has no faces, lines or points, so its picture is blank.",
     "Check the results of the previous stages. `when: {vertices: {min: 1}}` skips the picture."},
    {"W-FAR",
     "Most of a scene is hardly visible in its picture, because another object is far away. Examples are a "
     "stray face or a part in other units.",
     "Use the position in the message for `at` and `zoom`. `clean: {components: {keep: 1}}` keeps the "
     "largest component, and `facetmill info` prints the bounds of parts."},
    {"W-NO-VALUE",
     "The quantity that `render` measured has no value at any face or vertex. For example, the walls of an "
     "open sheet have no thickness.",
     "Give a sheet walls with `thicken: 1%`, or close a solid with `clean: {holes: minimal}` and turn it "
     "outward with `orient`."},
};

} // namespace facetmill
