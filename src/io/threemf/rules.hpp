#pragma once
// Rules of the 3MF core and materials specifications between the files and the resources of an archive.
// Private to threemf.

#include "io/threemf/layers.hpp"
#include "io/threemf/zip.hpp"

namespace facetmill::io::threemf {

/// The kinds of resources with an id.
enum class ResourceKind { object, materials, composites, colours, texture, points, layers, other };

struct Resource {
    ResourceKind kind = ResourceKind::other;
    std::size_t line = 0;
    std::uint32_t materials = none; ///< of composites: the group that they mix
};
using Resources = std::map<std::uint32_t, Resource>;

/// Throws malformed (E-3MF) if composites mix something other than materials. name: of the model.
void check_composites(const Resources& resources, const std::string& name);
/// Throws malformed (E-3MF) unless the layers have at most one material, as the lowest layer, at most one
/// group of colours, and no layers.
void check_layers(const Layers& layers, const Resources& resources, const std::string& name);

/// The path of the main model from the archive's relationships, else the path that all writers use. Throws
/// malformed (E-3MF) unless they name one model and existing thumbnails.
[[nodiscard]] std::string main_model(Archive& archive, const std::string& name);
/// Throws malformed (E-3MF) if the relationships of a model name a file outside the archive, or two print
/// tickets.
void check_relations_of(Archive& archive, const std::string& name, const std::string& model);

} // namespace facetmill::io::threemf
