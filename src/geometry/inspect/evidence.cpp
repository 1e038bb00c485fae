// Finds evidence against a property: its locations, the chains of a boundary, or the contributions of the
// parts.
#include "geometry/inspect/evidence.hpp"

#include "geometry/inspect/measures.hpp"
#include "mesh/placement.hpp"
#include "mesh/power_scale.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Only the mesh, in world space, like inspect. A mirrored part's faces are not reversed, so that both start
/// at the same corner.
Mesh placed(const Part& part) {
    Mesh mesh = bare(part.mesh);
    for (Vec3& p : mesh.positions) p = in_world(part, p);
    return mesh;
}

/// The faces with the worst values that fail, the worst first.
std::vector<Index> worst_faces(const Mesh& mesh, const Property& property, const LocationQuery& query) {
    const auto values = face_values(mesh, property);
    std::vector<Index> order;
    for (Index f = 0; f < values.size(); ++f)
        if (!query.fails || query.fails(values[f])) order.push_back(f);
    const bool least = property.join == Join::least;
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(std::min(query.limit, order.size()));
    std::partial_sort(order.begin(), end, order.end(), [&](Index a, Index b) {
        return values[a] != values[b] ? (values[a] < values[b]) == least : a < b;
    });
    order.erase(end, order.end());
    return order;
}

bool is_out(const Box& box, const Box& within, bool high) {
    for (std::size_t i = 0; i < 3; ++i)
        if (high ? !(box.max[i] <= within.max[i]) : !(box.min[i] >= within.min[i])) return true;
    return false;
}

/// The value of the property for each part, sorted by influence on the total value.
std::vector<Evidence> amounts_of_parts(const Scene& scene, const EvidenceQuery& query) {
    const Property& property = query.property;
    if (property.truth()) return {};
    InspectSettings settings;
    settings.request(property);
    std::vector<Evidence> found;
    for (const Part& part : scene.parts)
        if (const auto value = property.get(inspect(part, settings)))
            found.push_back({.part = part.name, .amount = *value});
    std::stable_sort(found.begin(), found.end(), [&](const Evidence& a, const Evidence& b) {
        return property.join == Join::least ? *a.amount < *b.amount : *a.amount > *b.amount;
    });
    found.resize(std::min(found.size(), query.limit));
    return found;
}

} // namespace

std::vector<BoundaryChain> boundary_chains(const Mesh& mesh) {
    const EdgeTable edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    DisjointSets sets(mesh.vertex_count());
    std::vector<Index> boundary;
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() == 1) {
            boundary.push_back(e);
            sets.join(edges.edges[e].low, edges.edges[e].high);
        }
    std::vector<Index> number(mesh.vertex_count(), none); // number of the chain, by the root of its set
    std::vector<BoundaryChain> chains;
    const PowerScale scale = even_scale(mesh.bounds());
    for (const Index e : boundary) { // ascending by lower vertex
        const Vec3 &a = mesh.positions[edges.edges[e].low], &b = mesh.positions[edges.edges[e].high];
        Index& chain = number[sets.find(edges.edges[e].low)];
        if (chain == none) {
            chain = static_cast<Index>(chains.size());
            chains.push_back({0, 0, faces[edges.corners_of(e)[0]], mix(a, b, 0.5)});
        }
        ++chains[chain].edges;
        chains[chain].length += scale.none() ? length(b - a) : length(scale(b) - scale(a));
    }
    for (BoundaryChain& c : chains) c.length = unscaled(c.length, scale.powers[0]);
    return chains;
}

std::vector<Location> locations_against(const Mesh& mesh, const Property& property,
                                        const LocationQuery& query) {
    if (property.of_faces) return inspect_room::locations_of_faces(mesh, worst_faces(mesh, property, query));
    return property.locations ? property.locations(mesh, query) : std::vector<Location>{};
}

std::vector<Location> locations_against(const Part& part, const Property& property,
                                        const LocationQuery& query) {
    if (property.of_faces)
        return inspect_room::locations_of_faces(part.mesh, worst_faces(placed(part), property, query));
    return locations_against(part.mesh, property, query);
}

Evidence evidence_of(const Part& part, Location location) {
    Evidence evidence{.part = part.name};
    if (location.attribute != none) evidence.attribute = part.mesh.attributes[location.attribute].name;
    location.at = in_world(part, location.at);
    evidence.location = location;
    return evidence;
}

std::vector<Evidence> evidence_against(const Scene& scene, const EvidenceQuery& query) {
    return (query.property.evidence ? query.property.evidence : inspect_room::by_locations)(scene, query);
}

namespace inspect_room {

std::vector<Location> locations_of_faces(const Mesh& mesh, const std::vector<Index>& faces) {
    std::vector<Location> found;
    found.reserve(faces.size());
    for (const Index f : faces) found.push_back(location_of(mesh, f));
    return found;
}

std::vector<Evidence> by_locations(const Scene& scene, const EvidenceQuery& query) {
    std::vector<Evidence> found;
    for (const Part& part : scene.parts)
        for (const Location& location :
             locations_against(part, query.property, {query.limit - found.size(), query.fails}))
            found.push_back(evidence_of(part, location));
    return found.empty() ? amounts_of_parts(scene, query) : found;
}

std::vector<Evidence> by_boundary(const Scene& scene, const EvidenceQuery& query) {
    std::vector<Evidence> found;
    for (const Part& part : scene.parts) {
        const auto chains = boundary_chains(placed(part));
        for (std::size_t i = 0; i < chains.size() && found.size() < query.limit; ++i)
            found.push_back({.part = part.name,
                             .location = Location{.face = chains[i].face, .at = chains[i].at},
                             .loop = i,
                             .chain = chains[i]});
    }
    return found.empty() ? by_locations(scene, query)
                         : found; // no chain may exist for edges with three faces
}

std::vector<Evidence> by_box_corners(const Scene& scene, const EvidenceQuery& query) {
    std::vector<Evidence> found;
    for (const Part& part : scene.parts) {
        Box box;
        for (const Vec3& p : part.mesh.positions) box.add(in_world(part, p));
        if (box.empty()) continue;
        for (const bool high : {false, true})
            if (is_out(box, query.within, high) && found.size() < query.limit)
                found.push_back({.part = part.name, .location = Location{.at = high ? box.max : box.min}});
    }
    return found;
}

std::vector<Evidence> by_part_names(const Scene& scene, const EvidenceQuery& query) {
    std::vector<Evidence> found;
    for (const Part& part : scene.parts)
        if (found.size() < query.limit) found.push_back({.part = part.name});
    return found;
}

std::vector<Evidence> by_material_names(const Scene& scene, const EvidenceQuery& query) {
    std::vector<Evidence> found;
    for (const Material& material : scene.materials)
        if (found.size() < query.limit) found.push_back({.material = material.name});
    return found;
}

std::vector<Evidence> no_evidence(const Scene&, const EvidenceQuery&) { return {}; }

} // namespace inspect_room

} // namespace facetmill
