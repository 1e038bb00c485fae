#include "io/gltf/document/accessor_uses.hpp"

namespace facetmill::io::gltf {

std::vector<bool> accessors_needing_bounds(const Json& document) {
    std::vector<bool> needed(count_of(document, "accessors"));
    each_accessor_use(
        document, [&](AccessorUse use, const std::string& attribute, const JsonCursor& reference) {
            if (use == AccessorUse::times || (use == AccessorUse::vertices && attribute == "POSITION"))
                needed[reference.index(needed.size(), "accessor")] = true;
        });
    return needed;
}

} // namespace facetmill::io::gltf
