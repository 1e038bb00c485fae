#pragma once
// The uses of a document's accessors.

#include "io/gltf/document/nodes.hpp"

#include <vector>

namespace facetmill::io::gltf {

enum class AccessorUse { vertices, indices, bind_matrices, times, values, instances };

/// Calls visit(use, attribute, reference) for every use of an accessor: by primitives and their morph
/// targets, skins, animations and instances. The attribute is empty for indices, skins and animations. Throws
/// malformed at members of the wrong type.
template <class Visit>
void each_accessor_use(const Json& document, const Visit& visit) {
    const std::string no_attribute;
    const auto attributes = [&](AccessorUse use, const JsonCursor& of) {
        for (const auto& [key, value] : of.json().get_ref<const Json::object_t&>())
            visit(use, key, JsonCursor(of, {&key, 0}, value));
    };
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m) {
        const JsonCursor primitives = item(document, "meshes", m).at("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const JsonCursor primitive = primitives.at(p);
            attributes(AccessorUse::vertices, primitive.at("attributes"));
            if (const auto indices = primitive.find("indices"))
                visit(AccessorUse::indices, no_attribute, *indices);
            const auto targets = primitive.find("targets");
            for (std::size_t t = 0; targets && t < targets->size(); ++t)
                attributes(AccessorUse::vertices, targets->at(t));
        }
    }
    for (std::size_t s = 0; s < count_of(document, "skins"); ++s)
        if (const auto matrices = item(document, "skins", s).find("inverseBindMatrices"))
            visit(AccessorUse::bind_matrices, no_attribute, *matrices);
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor samplers = item(document, "animations", a).at("samplers");
        for (std::size_t s = 0; s < samplers.size(); ++s) {
            visit(AccessorUse::times, no_attribute, samplers.at(s).at("input"));
            visit(AccessorUse::values, no_attribute, samplers.at(s).at("output"));
        }
    }
    for (std::size_t n = 0; n < count_of(document, "nodes"); ++n)
        if (const auto extensions = item(document, "nodes", n).find("extensions"))
            if (const auto instances = extensions->find(instancing_extension))
                if (const auto of = instances->find("attributes")) attributes(AccessorUse::instances, *of);
}

/// [accessors] true if glTF requires their minima and maxima: positions, also of morph targets, and the times
/// of animations. Throws malformed like each_accessor_use.
[[nodiscard]] std::vector<bool> accessors_needing_bounds(const Json& document);

} // namespace facetmill::io::gltf
