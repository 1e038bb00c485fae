#pragma once
// Decisions about the parts of a scene, made before any part is simplified.

#include "geometry/simplify/joint.hpp"
#include "mesh/equal_meshes.hpp"

namespace facetmill::simplification {

using PartSet = std::vector<std::size_t>; ///< part numbers in the scene

struct PartsPlan {
    const Scene& scene;
    const SimplifyPartsSettings& o;
    MeshCounts all{}; ///< total counts of the selected parts
    Contacts contacts{};
    std::vector<const PartSet*> set_of{}; ///< [parts] the set in contacts that is simplified jointly; empty:
                                          ///< no such set
    DistinctParts work{};                 ///< equal parts, which share the result of the first
    std::vector<std::size_t> measured_as{}; ///< [parts] the part whose measurements apply, usually itself
    std::vector<std::size_t> samples{};     ///< [parts] samples in each direction, for the selected parts

    PartSet set_with(std::size_t part) const {
        return set_of.empty() || !set_of[part] ? PartSet{part} : *set_of[part];
    }
    bool measures() const { return o.measure || o.certify; }
    bool changes_topology() const {
        return o.all.topology == SimplifySettings::Topology::allow ||
               o.all.method == SimplifySettings::Method::cluster;
    }
};

[[nodiscard]] PartsPlan plan_parts(const Scene& scene, const SimplifyPartsSettings& settings);

/// The settings for a set of parts that are merged for simplification: their share of the targets, in their
/// own space.
[[nodiscard]] SimplifySettings settings_for(const PartSet& set, const PartsPlan& plan);

/// Scale from a part's space to the world, used only to order the errors of parts. It is rounded, so that
/// nodes that differ by a rotation have the same scale.
[[nodiscard]] double ordering_scale(const Transform& to_world);

} // namespace facetmill::simplification
