#include "base/numbers.hpp"
#include "pipeline/planner.hpp"

#include <array>

namespace facetmill::pipeline {

namespace {

using Version = std::array<std::int64_t, 3>;

/// "1", "1.2" or "1.2.3"; a suffix after '-' (a prerelease) is ignored.
std::optional<Version> parse_version(std::string_view text) {
    Version version{0, 0, 0};
    text = text.substr(0, text.find('-'));
    for (std::size_t i = 0; i < version.size(); ++i) {
        const auto dot = text.find('.');
        const auto number = parse_integer(text.substr(0, dot));
        if (!number || *number < 0) return {};
        version[i] = *number;
        if (dot == std::string_view::npos) return version;
        text.remove_prefix(dot + 1);
    }
    return {};
}

std::optional<bool> satisfies_one(const Version& version, std::string_view comparator) {
    for (const std::string_view op : {">=", "<=", "==", ">", "<", "="}) {
        if (!comparator.starts_with(op)) continue;
        std::string_view number = comparator.substr(op.size());
        while (number.starts_with(' ')) number.remove_prefix(1);
        const auto limit = parse_version(number);
        if (!limit) return {};
        if (op == ">=") return version >= *limit;
        if (op == "<=") return version <= *limit;
        if (op == ">") return version > *limit;
        return op == "<" ? version < *limit : version == *limit;
    }
    const auto exact = parse_version(comparator);
    return exact ? std::optional<bool>(version == *exact) : std::nullopt;
}

} // namespace

std::optional<bool> satisfies(const std::string& version, const std::string& range) {
    const auto own = parse_version(version);
    if (!own) return {};
    bool all = true;
    for (std::size_t at = 0; at <= range.size();) {
        const std::size_t end = std::min(range.size(), range.find(',', at));
        std::string_view one = std::string_view(range).substr(at, end - at);
        while (one.starts_with(' ')) one.remove_prefix(1);
        while (one.ends_with(' ')) one.remove_suffix(1);
        const auto holds = satisfies_one(*own, one);
        if (!holds) return {};
        all = all && *holds;
        at = end + 1;
    }
    return all;
}

} // namespace facetmill::pipeline
