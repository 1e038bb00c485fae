#include "stages/validate/evidence_json.hpp"

#include "base/point_json.hpp"
#include "base/random.hpp"
#include "geometry/inspect/boundary.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/bare.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

constexpr std::size_t most = 10;

bool is_about_borders(std::string_view name) {
    constexpr std::array names{"closed",           "volume",         "genus",
                               "boundary_edges",   "boundary_loops", "boundary_length",
                               "longest_boundary", "euler"};
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

Json entry_of(const Part& part, const Place& place) {
    Json entry = {{"part", part.name}, {"at", point_json(in_world(part, place.at))}};
    if (place.face != none) entry["face"] = place.face;
    if (place.with != none) entry["with"] = place.with;
    if (place.attribute != none) entry["attribute"] = part.mesh.attributes[place.attribute].name;
    return entry;
}

/// What a place is known by among those of all parts.
class PartKeys {
  public:
    explicit PartKeys(const Part& part) {
        for (const char letter : part.name) name_ = hashed(name_, static_cast<unsigned char>(letter));
    }
    std::uint64_t of(const Place& place) const { return hashed(name_, place.key); }

  private:
    std::uint64_t name_ = 7;
};

/// What the property is of each part, those first that take the sum beyond the bound.
void add_shares(Json& evidence, const Scene& scene, const Assertion& assertion) {
    const Property& property = *property_named(assertion.property);
    if (property.name == "parts")
        for (const Part& part : scene.parts)
            if (evidence.size() < most) evidence.push_back({{"part", part.name}});
    if (property.name == "materials")
        for (const Material& material : scene.materials)
            if (evidence.size() < most) evidence.push_back({{"material", material.name}});
    if (property.truth() || property.of_scene || property.kind == PropertyKind::box) return;
    std::vector<std::pair<double, const Part*>> shares;
    for (const Part& part : scene.parts)
        if (const auto value = property.get(inspect(part, Assertions{{assertion}}.settings())))
            shares.emplace_back(*value, &part);
    const bool least = property.quality && info_of(*property.quality).join == Join::least;
    std::stable_sort(shares.begin(), shares.end(), [&](const auto& a, const auto& b) {
        return least ? a.first < b.first : a.first > b.first;
    });
    shares.resize(std::min(shares.size(), most));
    const bool whole = property.kind == PropertyKind::count;
    for (const auto& [amount, part] : shares)
        evidence.push_back({{"part", part->name},
                            {"amount", whole ? Json(static_cast<std::int64_t>(amount)) : Json(amount)}});
}

/// The corners of parts' boxes that are out of the box.
void add_corners(Json& evidence, const Scene& scene, const Box& within) {
    for (const Part& part : scene.parts) {
        Box box;
        for (const Vec3& p : part.mesh.positions) box.add(in_world(part, p));
        if (box.empty()) continue;
        const auto is_out = [&](bool high) {
            for (std::size_t i = 0; i < 3; ++i)
                if (high ? !(box.max[i] <= within.max[i]) : !(box.min[i] >= within.min[i])) return true;
            return false;
        };
        for (const bool high : {false, true})
            if (is_out(high) && evidence.size() < most)
                evidence.push_back({{"part", part.name}, {"at", point_json(high ? box.max : box.min)}});
    }
}

} // namespace

std::vector<Place> places_against(const Part& part, const Assertion& assertion, std::size_t limit) {
    const Property& property = *property_named(assertion.property);
    if (!property.quality) return places_against(part.mesh, property.name, limit);
    const auto fails = [&](double value) { return !holds(assertion.bound, value); };
    if (!is_by_face(*property.quality)) return places_against(part.mesh, *property.quality, limit, fails);
    auto places = places_against(placed(part), *property.quality, limit, fails);
    for (Place& place : places) place = place_of(part.mesh, place.face);
    return places;
}

Json evidence_against(const Scene& scene, const Assertion& assertion) {
    Json evidence = Json::array();
    if (is_about_borders(assertion.property))
        for (const Part& part : scene.parts) add_loops(evidence, part);
    if (evidence.empty()) // closed surfaces may be none for edges of three faces
        for (const Part& part : scene.parts)
            for (const Place& place : places_against(part, assertion, most - evidence.size()))
                evidence.push_back(entry_of(part, place));
    if (assertion.property == "bounds") add_corners(evidence, scene, assertion.within);
    if (evidence.empty()) add_shares(evidence, scene, assertion);
    return evidence;
}

Json evidence_among(const Scene& scene, const Assertion& assertion, const std::vector<std::uint64_t>& keys) {
    Json evidence = Json::array();
    for (const Part& part : scene.parts) {
        const PartKeys known(part);
        for (const Place& place : places_against(part, assertion, most_places))
            if (evidence.size() < most && std::binary_search(keys.begin(), keys.end(), known.of(place)))
                evidence.push_back(entry_of(part, place));
    }
    return evidence;
}

std::vector<std::uint64_t> place_keys(const Scene& scene, const Assertion& assertion) {
    std::vector<std::uint64_t> keys;
    for (const Part& part : scene.parts) {
        const PartKeys known(part);
        for (const Place& place : places_against(part, assertion, most_places))
            keys.push_back(known.of(place));
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

std::optional<std::size_t> count_places(const Scene& scene, const Assertion& assertion) {
    const Property& property = *property_named(assertion.property);
    const bool joints = property.quality == Quality::joints;
    if (!property.truth() && !joints && !(property.quality && is_by_face(*property.quality))) return {};
    std::size_t count = 0;
    for (const Part& part : scene.parts) count += places_against(part, assertion, most_places).size();
    if (count == 0) return {};
    return count;
}

} // namespace facetmill
