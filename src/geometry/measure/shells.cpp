#include "geometry/measure/measure.hpp"

#include "geometry/clean/clean.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/orient/orient.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/face.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

/// Whether the boxes of two components meet.
bool any_overlap(const Mesh& mesh, const Components& components) {
    std::vector<Box> boxes(components.count);
    for (Index f = 0; f < mesh.face_count(); ++f) add_corners(boxes[components.of_face[f]], mesh, f);
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i)
        if (tree.any_of(boxes[i], [&](Index other) { return other != i; })) return true;
    return false;
}

bool pass_through(const Mesh& mesh, const Components& components) {
    const auto found =
        find_self_intersections(mesh, {.limit = std::size_t{1} << 20, .separate_touching = true});
    return std::any_of(found.pairs.begin(), found.pairs.end(), [&](const auto& pair) {
        return components.of_face[pair.first] != components.of_face[pair.second];
    });
}

} // namespace

std::optional<OverlappingShells> overlapping_shells(const Mesh& mesh, double volume) {
    if (!(volume > 0)) return {};
    const Components components = face_components(mesh, false);
    if (components.count < 2 || !any_overlap(mesh, components)) return {};
    OverlappingShells shells{pass_through(mesh, components), {}};
    Mesh sound = orient(bare(mesh), {}).mesh;
    if (shells.unites) {
        CleanSettings settings;
        settings.self_intersections = Untangle::unite;
        CleanResult united = clean(std::move(sound), settings);
        if (!united.not_done.empty()) return shells;
        sound = std::move(united.mesh);
    }
    shells.solid = measure_mass(sound).solid;
    constexpr double rounding = 1e-9; // of sums over millions of faces, and of new vertices of the union
    if (shells.solid && std::abs(shells.solid->volume - volume) <= rounding * std::abs(volume)) return {};
    return shells;
}

} // namespace facetmill
