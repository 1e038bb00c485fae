#include "stage/evidence_json.hpp"

#include "base/point_json.hpp"
#include "geometry/boundary.hpp"
#include "geometry/evidence.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

constexpr std::size_t most = 10;

bool is_about_borders(std::string_view name) {
    constexpr std::array names{"closed",         "volume",          "genus",           "boundary_edges",
                               "boundary_loops", "boundary_length", "longest_boundary"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The mesh alone, where it stands in the world.
Mesh in_world(const Part& part) {
    Mesh mesh;
    mesh.positions = part.mesh.positions, mesh.wedge_vertex = part.mesh.wedge_vertex;
    mesh.corners = part.mesh.corners, mesh.face_offsets = part.mesh.face_offsets;
    if (!part.skinned)
        for (Vec3& p : mesh.positions) p = part.transform.point(p);
    return mesh;
}

void add_loops(Json& evidence, const Part& part) {
    const auto chains = boundary_chains(in_world(part));
    for (std::size_t i = 0; i < chains.size() && evidence.size() < most; ++i)
        evidence.push_back({{"part", part.name},
                            {"at", point_json(chains[i].at)},
                            {"face", chains[i].face},
                            {"loop", i},
                            {"edges", chains[i].edges},
                            {"length", chains[i].length}});
}

void add_places(Json& evidence, const Part& part, const Property& property) {
    const std::size_t room = most - evidence.size();
    for (const Place& place : property.quality ? places_against(part.mesh, *property.quality, room)
                                               : places_against(part.mesh, property.name, room)) {
        Json entry = {{"part", part.name},
                      {"at", point_json(part.skinned ? place.at : part.transform.point(place.at))}};
        if (place.face != none) entry["face"] = place.face;
        if (place.with != none) entry["with"] = place.with;
        evidence.push_back(std::move(entry));
    }
}

} // namespace

Json evidence_against(const Scene& scene, const Property& property) {
    Json evidence = Json::array();
    if (is_about_borders(property.name))
        for (const Part& part : scene.parts) add_loops(evidence, part);
    if (evidence.empty()) // closed surfaces may be none for edges of three faces
        for (const Part& part : scene.parts) add_places(evidence, part, property);
    return evidence;
}

} // namespace facetmill
