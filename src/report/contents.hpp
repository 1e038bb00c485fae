#pragma once
// The data of a scene in info and reports besides its properties, as plain structs. Their field declarations
// produce JSON and its schema.

#include "geometry/inspect/inspect.hpp"
#include "options/fields.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// The brief data of a scene, before or after a stage.
[[nodiscard]] Brief brief_of(const Scene& scene);
const Fields& brief_fields();

/// The found value of a check in reports and baselines: a box is {min, max}, no value is null.
[[nodiscard]] Json found_json(const Found& found);
/// The inverse of found_json; none for other JSON.
[[nodiscard]] std::optional<Found> found_of(const Json& json);
/// The lengths as JSON: {"amplitude": {"given": "0.2%", "is": 0.03}}.
[[nodiscard]] Json resolved_json(const std::vector<ResolvedLength>& lengths);

/// The box as {min, max}; null for an empty box.
[[nodiscard]] Json box_json(const Box& box);
/// The schema of a box that may be empty.
[[nodiscard]] Json box_schema();

/// An attribute that at least one part has.
struct AttributeEntry {
    std::string name;
    Domain domain = Domain::vertex;
    std::string type;
    std::size_t components = 0;

    bool operator==(const AttributeEntry&) const = default;
};
/// Each attribute once, in order of first appearance.
[[nodiscard]] std::vector<AttributeEntry> attributes_of(const Scene& scene);
const Fields& attribute_fields();
/// "vertex", "wedge" and "face".
[[nodiscard]] std::vector<NamedChoice<Domain>> domain_choices();

struct PartEntry {
    std::string name;
    std::size_t vertices = 0, wedges = 0, faces = 0;
};
[[nodiscard]] std::vector<PartEntry> parts_of(const Scene& scene);
const Fields& part_fields();

/// A component of a part.
struct Component {
    std::string part;
    Properties properties;
};
/// The components with the most faces in a scene with these properties, the largest first.
[[nodiscard]] std::vector<Component> largest_components(const Scene& scene, const Properties& properties,
                                                        std::size_t limit);
const Fields& component_fields();

/// The evidence as [{part, at, face}], with the keys that the entries have; null without evidence.
[[nodiscard]] Json evidence_json(const std::optional<CheckEvidence>& evidence);
[[nodiscard]] Json evidence_json(const EvidenceEntry& entry);

/// The records of a list, by their declared fields.
template <class Record>
[[nodiscard]] Json list_json(const std::vector<Record>& records, const Fields& fields) {
    Json list = Json::array();
    for (const Record& record : records) list.push_back(fields.json(&record));
    return list;
}

} // namespace facetmill::report
