#include "stage/evidence_json.hpp"

#include "base/point_json.hpp"
#include "geometry/boundary.hpp"
#include "geometry/evidence.hpp"
#include "mesh/bare.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

constexpr std::size_t most = 10;

bool is_about_borders(std::string_view name) {
    constexpr std::array names{"closed",           "volume",         "genus",
                               "boundary_edges",   "boundary_loops", "boundary_length",
                               "longest_boundary", "euler",          "euler"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The mesh alone where it stands in the world, as inspect looks at it: a mirrored part's faces are not
/// turned round, so that both see the same corner first.
Mesh placed(const Part& part) {
    Mesh mesh = bare(part.mesh);
    for (Vec3& p : mesh.positions) p = in_world(part, p);
    return mesh;
}

void add_loops(Json& evidence, const Part& part) {
    const auto chains = boundary_chains(placed(part));
    for (std::size_t i = 0; i < chains.size() && evidence.size() < most; ++i)
        evidence.push_back({{"part", part.name},
                            {"at", point_json(chains[i].at)},
                            {"face", chains[i].face},
                            {"loop", i},
                            {"edges", chains[i].edges},
                            {"length", chains[i].length}});
}

void add_places(Json& evidence, const Part& part, const Assertion& assertion) {
    for (const Place& place : places_against(part, assertion, most - evidence.size())) {
        Json entry = {{"part", part.name}, {"at", point_json(in_world(part, place.at))}};
        if (place.face != none) entry["face"] = place.face;
        if (place.with != none) entry["with"] = place.with;
        evidence.push_back(std::move(entry));
    }
}

Vec3 middle(const Mesh& mesh, Index f) {
    Vec3 sum;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) sum += mesh.point(c);
    return sum / mesh.face_size(f);
}

} // namespace

std::vector<Place> places_against(const Part& part, const Assertion& assertion, std::size_t limit) {
    const Property& property = *property_named(assertion.property);
    if (!property.quality) return places_against(part.mesh, property.name, limit);
    if (!is_by_face(*property.quality)) return places_against(part.mesh, *property.quality, limit);
    const auto fails = [&](double value) { return !holds(assertion.bound, value); };
    auto places = places_against(placed(part), *property.quality, limit, fails);
    for (Place& place : places)
        if (place.face != none) place.at = middle(part.mesh, place.face);
    return places;
}

Json evidence_against(const Scene& scene, const Assertion& assertion) {
    Json evidence = Json::array();
    if (is_about_borders(assertion.property))
        for (const Part& part : scene.parts) add_loops(evidence, part);
    if (evidence.empty()) // closed surfaces may be none for edges of three faces
        for (const Part& part : scene.parts) add_places(evidence, part, assertion);
    return evidence;
}

std::optional<std::size_t> count_places(const Scene& scene, const Assertion& assertion) {
    const Property& property = *property_named(assertion.property);
    if (!property.truth() && !(property.quality && is_by_face(*property.quality))) return {};
    std::size_t count = 0;
    for (const Part& part : scene.parts) count += places_against(part, assertion, SIZE_MAX).size();
    if (count == 0) return {};
    return count;
}

} // namespace facetmill
