#include "stages/validate/check_evidence.hpp"

#include "base/math/random.hpp"

#include <algorithm>

namespace facetmill::validate_stage {

namespace {

constexpr std::size_t max_locations = std::size_t{1} << 22;

const Property& property_of(const Assertion& assertion) { return *property_named(assertion.property); }

std::function<bool(double)> failing(const Assertion& assertion) {
    return [bound = assertion.bound](double value) { return !holds(bound, value); };
}

report::EvidenceEntry entry_of(const Property& property, const Evidence& e) {
    using Of = report::EvidenceEntry::Of;
    report::EvidenceEntry entry;
    entry.of = e.material.empty() ? Of::part : Of::material;
    entry.name = e.material.empty() ? e.part : e.material;
    if (e.location) {
        entry.at = e.location->at;
        if (e.location->face != none) entry.face = e.location->face;
        if (e.location->with != none) entry.with = e.location->with;
    }
    entry.attribute = e.attribute;
    entry.loop = e.loop;
    entry.edges = e.chain.edges;
    entry.length = e.chain.length;
    entry.amount = e.amount;
    entry.is_count = property.kind == PropertyKind::count;
    return entry;
}

/// Gives the locations of a part keys that are unique among all parts.
class PartKeys {
  public:
    explicit PartKeys(const Part& part) {
        for (const char letter : part.name) name_ = hashed(name_, static_cast<unsigned char>(letter));
    }
    std::uint64_t of(const Location& location) const { return hashed(name_, location.key); }

  private:
    std::uint64_t name_ = 7;
};

} // namespace

std::vector<Location> locations_against(const Part& part, const Assertion& assertion) {
    return locations_against(part, property_of(assertion), {max_locations, failing(assertion)});
}

report::CheckEvidence evidence_against(const Scene& scene, const Assertion& assertion) {
    const Property& property = property_of(assertion);
    report::CheckEvidence evidence;
    for (const Evidence& e :
         evidence_against(scene, EvidenceQuery{property, failing(assertion), assertion.within, max_evidence}))
        evidence.push_back(entry_of(property, e));
    return evidence;
}

Findings findings_against(const Scene& scene, const Assertion& assertion) {
    const Property& property = property_of(assertion);
    const bool of_faces = property.of_faces && !property.evidence && property.counts_locations;
    Findings found;
    std::size_t count = 0;
    for (std::size_t i = 0; of_faces && i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const std::vector<Location> all = locations_against(part, assertion); // the worst first
        count += all.size();
        for (std::size_t k = 0; k < all.size() && found.evidence.size() < max_evidence; ++k)
            found.evidence.push_back(entry_of(property, evidence_of(part, all[k])));
    }
    if (count > 0)
        found.locations = count;
    else
        found = {evidence_against(scene, assertion), count_locations(scene, assertion)};
    return found;
}

report::CheckEvidence evidence_among(const Scene& scene, const Assertion& assertion,
                                     const std::vector<std::uint64_t>& keys) {
    const Property& property = property_of(assertion);
    report::CheckEvidence evidence;
    for (const Part& part : scene.parts) {
        const PartKeys known(part);
        for (const Location& location : locations_against(part, assertion))
            if (evidence.size() < max_evidence &&
                std::binary_search(keys.begin(), keys.end(), known.of(location)))
                evidence.push_back(entry_of(property, evidence_of(part, location)));
    }
    return evidence;
}

std::vector<std::uint64_t> location_keys(const Scene& scene, const Assertion& assertion) {
    std::vector<std::uint64_t> keys;
    for (const Part& part : scene.parts) {
        const PartKeys known(part);
        for (const Location& location : locations_against(part, assertion))
            keys.push_back(known.of(location));
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

std::optional<std::size_t> count_locations(const Scene& scene, const Assertion& assertion) {
    if (!property_of(assertion).counts_locations) return {};
    std::size_t count = 0;
    for (const Part& part : scene.parts) count += locations_against(part, assertion).size();
    if (count == 0) return {};
    return count;
}

} // namespace facetmill::validate_stage
