#pragma once
// Joins several glTF documents into a single document, with all their contents.

#include "io/gltf/write/patch.hpp"

#include <set>

namespace facetmill::io::gltf {

/// A scene whose parts are in its base document, to which other documents were appended.
struct JoinedDocuments {
    Scene scene;
    Json json;              ///< of the base document
    ImageOwners images{};   ///< the documents of appended images
    std::set<int> joined{}; ///< the appended documents
};

/// Appends the other glTF documents of a scene to its base document: nodes, skins, animations, variants,
/// cameras, lights and all the rest. Variants with equal names are merged. Documents stay apart if their
/// extensions may refer to items in an unknown way, or if stages took all their meshes. None if nothing was
/// joined.
[[nodiscard]] std::optional<JoinedDocuments> join_documents(const Scene& scene, const BaseDocument& base);

/// The number of the variant with this name in a document's list of variants. A new variant is appended.
[[nodiscard]] std::size_t variant_number(Json& all, const Json& variant);

} // namespace facetmill::io::gltf
