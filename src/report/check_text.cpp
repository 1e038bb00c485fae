#include "report/check_text.hpp"

#include "base/math/numbers.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

std::string verdict_text(const RunRecord& record) {
    if (record.exit_code == 0) return "passed: all checks held and all outputs were written";
    return fmt::format("failed with exit code {}{}", record.exit_code,
                       record.outputs.empty() ? ": no output was written" : "");
}

std::string passed_text(const RunRecord& record) {
    const auto passed = std::count_if(record.checks.begin(), record.checks.end(),
                                      [](const Check& check) { return check.passed; });
    return fmt::format("{} of {}", passed, record.checks.size());
}

std::string subject_text(const Check& check) {
    if (check.file.empty() || check.part.empty()) return check.part + check.file;
    return check.part + " in " + check.file;
}

const char* outcome(const Check& check) {
    if (check.waived) return "known";
    if (check.passed) return "passed";
    return check.severity == Severity::error ? "failed" : "warned";
}

namespace {

/// For example "[0, 0, 0]".
std::string point_text(const Vec3& p) {
    return fmt::format("[{}, {}, {}]", to_string(p.x), to_string(p.y), to_string(p.z));
}

struct FoundText {
    std::string operator()(std::monostate) const { return "not applicable"; }
    std::string operator()(bool truth) const { return truth ? "true" : "false"; }
    std::string operator()(std::int64_t count) const { return to_string(static_cast<double>(count)); }
    std::string operator()(double number) const { return to_string(number); }
    std::string operator()(const std::string& word) const { return word; }
    std::string operator()(const Corners& box) const {
        return point_text(box.min) + " to " + point_text(box.max);
    }
    std::string operator()(const std::vector<std::string>& names) const { return join_texts(names); }
};

/// For example "face 7 and 9 of 'part' at 1 2 3".
std::string location_text(const EvidenceEntry& e) {
    std::string text;
    if (e.face) text += fmt::format("face {} ", *e.face);
    if (e.with) text += fmt::format("and {} ", *e.with);
    if (e.of == EvidenceEntry::Of::part) text += fmt::format("of '{}' ", e.name);
    text += "at " + readable(*e.at);
    if (!e.attribute.empty()) text += fmt::format(" in {}", e.attribute);
    return text;
}

/// For example "part 'wheel' 1200", "image 'wood' 2048 x 1024", "extension 'KHR_a' of 'b.glb'".
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

/// The first entry that is not a location.
std::string shares_text(const CheckEvidence& evidence) {
    constexpr std::size_t max_shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(max_shown, evidence.size()); ++i)
        append_item(text, share_text(evidence[i]));
    return evidence.size() > max_shown ? text + " ..." : text;
}

} // namespace

std::string found_text(const Check& check) {
    return check.found_words.empty() ? std::visit(FoundText(), check.found) : check.found_words;
}

std::string evidence_text(const EvidenceEntry& entry) {
    return entry.at ? location_text(entry) : share_text(entry);
}

std::string margin_text(const Check& check) {
    double found = 0;
    const auto* count = std::get_if<std::int64_t>(&check.found);
    if (count)
        found = static_cast<double>(*count);
    else if (const auto* number = std::get_if<double>(&check.found))
        found = *number;
    else
        return {};
    if (!check.min && !check.max) return {};
    const double below = check.max ? *check.max - found : HUGE_VAL;
    const double above = check.min ? found - *check.min : HUGE_VAL;
    const double margin = std::min(below, above), limit = below <= above ? *check.max : *check.min;
    if (!std::isfinite(margin)) return {};
    constexpr double most_percent = 999; // beyond this, the amount alone is easier to read
    const double percent = limit != 0 ? 100 * std::abs(margin / limit) : HUGE_VAL;
    const std::string share = percent > most_percent ? "" : percentage(percent);
    const std::string amount = count ? grouped(static_cast<std::uint64_t>(std::abs(margin)))
                                     : fmt::format("{:.6g}", std::abs(margin));
    if (margin == 0) return "exactly at the limit";
    const bool of_maximum = below <= above;
    if (margin > 0)
        return fmt::format("{} {} the limit{}", amount, of_maximum ? "below" : "above",
                           share.empty() ? "" : fmt::format(" (by {})", share));
    const char* word = count ? (of_maximum ? "many" : "few") : of_maximum ? "much" : "little";
    const std::string beyond =
        share.empty() ? "" : fmt::format(" ({} {} the limit)", share, of_maximum ? "above" : "below");
    return fmt::format("{} too {}{}", amount, word, beyond);
}

std::string locations_text(const Check& check) {
    if (!check.evidence || check.evidence->empty()) return {};
    const EvidenceEntry& first = check.evidence->front();
    if (!first.at) return shares_text(*check.evidence);
    std::string text = "first: ";
    const std::string count =
        check.locations ? counted(static_cast<std::size_t>(*check.locations), "location") + ", " : "";
    if (check.locations) text = count + "first: ";
    if (check.fresh && *check.fresh > 0) text = count + fmt::format("{} new, first: ", *check.fresh);
    return text + location_text(first);
}

std::vector<Vec3> failing_locations(const Check& check) {
    std::vector<Vec3> locations;
    if (check.passed || !check.evidence) return locations;
    for (const EvidenceEntry& entry : *check.evidence)
        if (entry.at) locations.push_back(*entry.at);
    return locations;
}

} // namespace facetmill::report
