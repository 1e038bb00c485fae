#pragma once
// Helpers for the checks of rules between objects. Members must have been checked.

#include "io/gltf/document/check.hpp"

#include <initializer_list>

namespace facetmill::io::gltf {

/// A document whose rules are checked.
struct CheckedDocument {
    const Json& json;
    Breaches& breaches;

    /// The item of a top-level list that a reference names.
    const Json& at(const char* list, const Json& index) const {
        return json[list][static_cast<std::size_t>(index.get<double>())];
    }
    /// The number of morph targets of a mesh.
    static std::size_t targets_of(const Json& mesh) {
        const Json& primitives = mesh["primitives"];
        return primitives.empty() || !primitives[0].contains("targets") ? 0 : primitives[0]["targets"].size();
    }
};

[[nodiscard]] std::size_t number_in(const Json& owner, const char* key, std::size_t otherwise = SIZE_MAX);
/// The accessor as "VEC3 5126 normalized".
[[nodiscard]] std::string format_of(const Json& accessor);
[[nodiscard]] bool is_one_of(const std::string& text, std::initializer_list<const char*> all);

void check_nodes(const CheckedDocument& document);      ///< nodes, scenes, skins
void check_meshes(const CheckedDocument& document);     ///< primitives, attributes
void check_animations(const CheckedDocument& document); ///< channels, samplers
void check_data(const CheckedDocument& document);       ///< accessors, views, images

} // namespace facetmill::io::gltf
