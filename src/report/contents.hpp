#pragma once
// The data of a scene for info and reports, in addition to its properties, and the declaration of its
// fields, from which JSON and its schema derive.

#include "geometry/inspect/inspect.hpp"
#include "options/fields.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// Before or after a stage.
Brief brief_of(const Scene& scene);
const Fields& brief_fields();

/// The value found by a check, as JSON for reports and baselines: a box is {min, max}, none is null.
Json found_json(const Found& found);
/// The inverse of found_json; none for other JSON.
std::optional<Found> found_of(const Json& json);
/// {"amplitude": {"given": "0.2%", "is": 0.03}}
Json resolved_json(const std::vector<ResolvedLength>& lengths);

/// {min, max}; null of an empty box.
Json box_json(const Box& box);
/// The schema of a box that may be empty.
Json box_schema();

/// An attribute that some part has.
struct AttributeEntry {
    std::string name;
    Domain domain = Domain::vertex;
    std::string type;
    std::size_t components = 0;

    bool operator==(const AttributeEntry&) const = default;
};
/// Each attribute once, in order of first appearance.
std::vector<AttributeEntry> attributes_of(const Scene& scene);
const Fields& attribute_fields();
/// "vertex", "wedge" and "face".
std::vector<NamedChoice<Domain>> domain_choices();

struct PartEntry {
    std::string name;
    std::size_t vertices = 0, wedges = 0, faces = 0;
};
std::vector<PartEntry> parts_of(const Scene& scene);
const Fields& part_fields();

/// A component of a part.
struct Component {
    std::string part;
    Properties properties;
};
/// The components of a scene of these properties with most faces, the largest first.
std::vector<Component> largest_components(const Scene& scene, const Properties& properties,
                                          std::size_t limit);
const Fields& component_fields();

/// [{part, at, face}], with the keys that the entries have; null of none.
Json evidence_json(const std::optional<CheckEvidence>& evidence);
Json evidence_json(const EvidenceEntry& entry);

/// The records of a list, as their fields say.
template <class Record>
Json list_json(const std::vector<Record>& records, const Fields& fields) {
    Json list = Json::array();
    for (const Record& record : records) list.push_back(fields.json(&record));
    return list;
}

} // namespace facetmill::report
