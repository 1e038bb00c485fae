#pragma once
// Removes the skin attributes of a mesh whose part loses its skin.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Drops the attributes that are meaningless without the skin. Returns their changes.
inline AttributeChanges drop_skin(Mesh& mesh, const char* why) {
    AttributeChanges changes;
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (a.role != Role::joints && a.role != Role::weights) return false;
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, why});
        return true;
    });
    return changes;
}

} // namespace facetmill
