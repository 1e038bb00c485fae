#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages stages_messages{
    {"E-ATTRIBUTE", "A part has no attribute with the requested name and kind.",
     "Run `facetmill info` to list the attributes of a file. The help of `render` lists the quantities that "
     "it can measure.",
     ErrorKind::stage},
    {"E-PART", "An option selects no part of the scene, or all of them.",
     "Run `facetmill info` to list the parts.", ErrorKind::usage},
    {"W-CELLS",
     "Cells do not keep some data of a file, such as face attributes. A GLB written from cells has only "
     "positions.",
     "Give more `--memory` to process the file in memory, if you need the data. A PLY written from cells "
     "keeps vertex attributes."},
    {"W-INSIDE-OUT",
     "The faces of a solid face inward, so its volume and the area of its sections are negative.",
     "Use `orient` to reverse them."},
    {"W-SPLIT-FOLDED", "`split` made overlapping faces from concave faces. The message gives their number.",
     "Use `triangulate` first, or choose another method."},
};

} // namespace facetmill
