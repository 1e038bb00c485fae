#include "report/check_text.hpp"

#include "base/numbers.hpp"
#include "base/words.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

const char* outcome(const Check& check) {
    if (check.waived) return "known";
    if (check.passed) return "passed";
    return check.severity == Severity::error ? "failed" : "warned";
}

namespace {

/// "[0, 0, 0]"
std::string point_text(const Json& point) {
    std::string text;
    for (const Json& x : point) append_item(text, to_string(x.get<double>()));
    return "[" + text + "]";
}

std::string names_text(const Json& names) {
    std::string text;
    for (const Json& name : names) append_item(text, name.get<std::string>());
    return text;
}

/// "face 7 and 9 of 'part' at 1 2 3"
std::string location_text(const EvidenceEntry& e) {
    std::string text;
    if (e.face) text += fmt::format("face {} ", *e.face);
    if (e.with) text += fmt::format("and {} ", *e.with);
    if (e.of == EvidenceEntry::Of::part) text += fmt::format("of '{}' ", e.name);
    text += fmt::format("at {:.6g} {:.6g} {:.6g}", e.at->x, e.at->y, e.at->z);
    if (!e.attribute.empty()) text += fmt::format(" in {}", e.attribute);
    return text;
}

/// "part 'wheel' 1200", "image 'wood' 2048 x 1024", "extension 'KHR_a' of 'b.glb'"
std::string share_text(const EvidenceEntry& e) {
    using Of = EvidenceEntry::Of;
    const std::string amount = e.amount ? fmt::format(" {:.12g}", *e.amount) : "";
    switch (e.of) {
    case Of::place:
        return amount;
    case Of::part:
        return fmt::format("part '{}'{}", e.name, amount);
    case Of::material:
        return fmt::format("material '{}'{}", e.name, amount);
    case Of::image:
        return fmt::format("image '{}' {} x {}", e.name, e.width, e.height);
    case Of::extension:
        return fmt::format("extension '{}' of '{}'", e.name, e.document);
    case Of::bytes:
        return fmt::format("{},{} bytes", e.name, amount);
    }
    return {};
}

/// The first of those that are no locations.
std::string shares_text(const CheckEvidence& evidence) {
    constexpr std::size_t max_shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(max_shown, evidence.size()); ++i)
        append_item(text, share_text(evidence[i]));
    return evidence.size() > max_shown ? text + " ..." : text;
}

} // namespace

std::string found_text(const Check& check) {
    const Json& found = check.found;
    if (!check.found_words.empty()) return check.found_words;
    if (found.is_null()) return "not applicable";
    if (found.is_boolean()) return found.get<bool>() ? "true" : "false";
    if (found.is_number()) return to_string(found.get<double>());
    if (found.is_array()) return names_text(found);
    if (found.is_object()) return point_text(found["min"]) + " to " + point_text(found["max"]);
    return found.get<std::string>();
}

std::string locations_text(const Check& check) {
    if (!check.evidence || check.evidence->empty()) return {};
    const EvidenceEntry& first = check.evidence->front();
    if (!first.at) return shares_text(*check.evidence);
    std::string text = "first ";
    const std::string count =
        check.locations ? counted(static_cast<std::size_t>(*check.locations), "location") + ", " : "";
    if (check.locations) text = count + "the first ";
    if (check.fresh && *check.fresh > 0) text = count + fmt::format("{} new, the first ", *check.fresh);
    return text + location_text(first);
}

std::vector<Vec3> failing_locations(const Check& check) {
    std::vector<Vec3> places;
    if (check.passed || !check.evidence) return places;
    for (const EvidenceEntry& entry : *check.evidence)
        if (entry.at) places.push_back(*entry.at);
    return places;
}

} // namespace facetmill::report
