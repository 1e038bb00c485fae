#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages merge_messages{
    {"W-MERGE-STAYS",
     "`merge` leaves parts unchanged if merging would change their look in viewers. These are animated and "
     "instanced parts, levels of detail, and parts outside the scene that viewers show.",
     "Use `load: {path: ..., instances: expand}` to make a part of each instance. To merge the other parts "
     "in their rest pose, write the scene to PLY, which has no nodes, and load that."},
    {"W-VOLUME",
     "The thickness of a transparent volume (KHR_materials_volume) has no direction, but the mesh is scaled "
     "differently by direction.",
     "Use `only` to exclude the part, or scale it equally along all axes."},
};

} // namespace facetmill
