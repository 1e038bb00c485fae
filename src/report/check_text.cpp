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
    for (const Json& x : point) text += (text.empty() ? "" : ", ") + to_string(x.get<double>());
    return "[" + text + "]";
}

std::string names_text(const Json& names) {
    std::string text;
    for (const Json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
    return text;
}

/// "face 7 and 9 of 'part' at 1 2 3"
std::string location_text(const Json& place) {
    std::string text;
    if (place.contains("face")) text += fmt::format("face {} ", place["face"].get<std::size_t>());
    if (place.contains("with")) text += fmt::format("and {} ", place["with"].get<std::size_t>());
    if (place.contains("part")) text += fmt::format("of '{}' ", place["part"].get<std::string>());
    const Json& at = place.at("at");
    text +=
        fmt::format("at {:.6g} {:.6g} {:.6g}", at[0].get<double>(), at[1].get<double>(), at[2].get<double>());
    if (place.contains("attribute")) text += fmt::format(" in {}", place["attribute"].get<std::string>());
    return text;
}

/// "part 'wheel' 1200", "image 'wood' 2048 x 1024", "extension 'KHR_a' of 'b.glb'"
std::string share_text(const Json& entry) {
    std::string text;
    for (const char* kind : {"part", "material", "image", "extension"})
        if (entry.contains(kind)) text += fmt::format("{} '{}'", kind, entry[kind].get<std::string>());
    if (entry.contains("bytes_of")) text += entry["bytes_of"].get<std::string>() + ",";
    if (entry.contains("document")) text += fmt::format(" of '{}'", entry["document"].get<std::string>());
    if (entry.contains("width"))
        text +=
            fmt::format(" {} x {}", entry["width"].get<std::size_t>(), entry["height"].get<std::size_t>());
    else if (entry.contains("amount"))
        text += fmt::format(" {:.12g}{}", entry["amount"].get<double>(),
                            entry.contains("bytes_of") ? " bytes" : "");
    return text;
}

/// The first of those that are no locations.
std::string shares_text(const Json& evidence) {
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, evidence.size()); ++i)
        text += (i == 0 ? "" : ", ") + share_text(evidence[i]);
    return evidence.size() > most ? text + " ..." : text;
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
    if (!check.evidence.is_array() || check.evidence.empty()) return {};
    const Json& first = check.evidence[0];
    if (!first.contains("at")) return shares_text(check.evidence);
    std::string text = "first ";
    const std::string count =
        check.locations ? counted(static_cast<std::size_t>(*check.locations), "location") + ", " : "";
    if (check.locations) text = count + "the first ";
    if (check.fresh && *check.fresh > 0) text = count + fmt::format("{} new, the first ", *check.fresh);
    return text + location_text(first);
}

std::vector<Vec3> failing_locations(const Check& check) {
    std::vector<Vec3> places;
    if (check.passed || !check.evidence.is_array()) return places;
    for (const Json& entry : check.evidence) {
        if (!entry.contains("at")) continue;
        const Json& at = entry["at"];
        places.push_back({at[0].get<double>(), at[1].get<double>(), at[2].get<double>()});
    }
    return places;
}

} // namespace facetmill::report
