#pragma once
// What is decided about the parts of a scene before any of them is simplified.

#include "geometry/simplify/joint.hpp"
#include "mesh/equal_meshes.hpp"

namespace facetmill::simplification {

using PartSet = std::vector<std::size_t>; ///< parts, by their number in the scene

struct PartsPlan {
    const Scene& scene;
    const SimplifyPartsSettings& o;
    MeshCounts all{}; ///< of the selected parts
    Contacts contacts{};
    std::vector<const PartSet*> set_of{};   ///< [parts] of contacts, when simplified as one; empty: none is
    DistinctParts work{Scene{}};            ///< parts that have the result of the first
    std::vector<std::size_t> measured_as{}; ///< [parts] the part that has its measurements, mostly itself
    std::vector<std::size_t> samples{};     ///< [parts] each way, of those selected

    PartSet set_with(std::size_t part) const {
        return set_of.empty() || !set_of[part] ? PartSet{part} : *set_of[part];
    }
    bool measures() const { return o.measure || o.certify; }
    bool changes_topology() const {
        return o.all.topology == SimplifySettings::Topology::allow ||
               o.all.method == SimplifySettings::Method::cluster;
    }
};

PartsPlan plan_parts(const Scene& scene, const SimplifyPartsSettings& settings);

/// The settings for parts that are simplified as one: their share of the targets, in their own space.
SimplifySettings settings_for(const PartSet& set, const PartsPlan& plan);

/// Takes lengths of a part's space to the world's, where they only order the errors of parts. Rounded, so
/// that nodes which differ by a rotation have the same.
double ordering_scale(const Transform& to_world);

} // namespace facetmill::simplification
