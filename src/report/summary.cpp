#include "report/summary.hpp"

#include "base/readable_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::report {

namespace {

constexpr std::size_t few = 5; ///< parts or answers that are told one by one

std::string number(const Json& x) {
    if (!x.is_number()) return "-";
    const double value = x.get<double>();
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "out of range";
}

std::string point(const Json& p) {
    return p.is_array() && p.size() == 3 ? fmt::format("{} {} {}", number(p[0]), number(p[1]), number(p[2]))
                                         : "-";
}

/// "area 6 mm2, volume 1 mm3, centroid 0.5 0.5 0.5" of {shell, solid}.
std::string mass_text(const Json& m, const std::string& unit, double density) {
    const Json& solid = m["solid"];
    std::string text =
        fmt::format("area {}{}", number(m["shell"]["area"]), unit.empty() ? "" : " " + unit + "2");
    if (solid.is_null())
        return text + fmt::format(", open (no volume), centroid {}", point(m["shell"]["centroid"]));
    text += fmt::format(", volume {}{}", number(solid["volume"]), unit.empty() ? "" : " " + unit + "3");
    if (density != 1) text += ", mass " + number(solid["mass"]);
    return text + fmt::format(", centroid {}", point(solid["centroid"]));
}

/// "edges 0.1 to 2, mean 1" of {minimum, maximum, mean}; empty when nothing was counted.
std::string range_text(const char* name, const Json& s) {
    if (s.value("count", 0) == 0) return "";
    return fmt::format("{} {} to {} (mean {})", name, number(s["minimum"]), number(s["maximum"]),
                       number(s["mean"]));
}

std::string joined(const std::vector<std::string>& texts, const char* between = ", ") {
    std::string all;
    for (const auto& t : texts)
        if (!t.empty()) all += (all.empty() ? "" : between) + t;
    return all;
}

std::string name_of(const Json& part) { return part.is_string() ? part.get<std::string>() : "-"; }

std::string answer_text(const Json& a) {
    if (a.contains("side")) {
        std::string text = fmt::format("{}: {}", point(a["point"]), a["side"].get<std::string>());
        if (a["distance"].is_null()) return text;
        return text + fmt::format(", {} from {} of {} face {}", number(a["distance"]), point(a["closest"]),
                                  name_of(a["part"]), a["face"].dump());
    }
    std::string text = fmt::format("{} {} {}: ", point(a["from"]), a.contains("to") ? "to" : "along",
                                   point(a.contains("to") ? a["to"] : a["direction"]));
    if (a.contains("meeting")) return text + a["meeting"].get<std::string>();
    if (a["hits"].empty()) return text + "no hit";
    const Json& first = a["hits"][0];
    return text + fmt::format("{} hit{}, t {} at {} on {} face {}", a["hits"].size(),
                              a["hits"].size() == 1 ? "" : "s", number(first["t"]), point(first["at"]),
                              name_of(first["part"]), first["face"].dump());
}

} // namespace

std::vector<std::string> measure_summary(const Json& result) {
    const std::string given = result["unit"].get<std::string>(), unit = given == "unknown" ? "" : given;
    const double density = result["density"].get<double>();
    const Json& parts = result["parts"];
    if (parts.empty()) return {"nothing to measure"};
    std::vector<std::string> lines{mass_text(result["total"], unit, density)};
    if (parts.size() > 1) {
        for (std::size_t i = 0; i < std::min(few, parts.size()); ++i)
            lines.push_back(
                fmt::format("{}: {}", name_of(parts[i]["part"]), mass_text(parts[i], unit, density)));
        if (parts.size() > few) lines.push_back(fmt::format("and {} more parts", parts.size() - few));
        return lines;
    }
    const Json &edges = parts[0]["edges"], &faces = parts[0]["faces"];
    lines.push_back(joined({range_text("edges", edges["length"]), range_text("angles", faces["angle"])}));
    lines.push_back(fmt::format("{} convex, {} concave, {} flat and {} boundary edges, {} feature edges",
                                number(edges["convex"]), number(edges["concave"]), number(edges["flat"]),
                                number(edges["boundary"]), number(edges["feature"])));
    std::erase(lines, "");
    return lines;
}

std::vector<std::string> probe_summary(const Json& result) {
    std::vector<std::string> counts;
    for (const char* kind : {"inside", "outside", "on", "unknown", "hit", "missed"})
        if (result.contains(kind) && result[kind] != 0)
            counts.push_back(fmt::format("{} {}", grouped(result[kind].get<std::uint64_t>()), kind));
    if (result.contains("meetings")) {
        counts.clear();
        for (const auto& [kind, count] : result["meetings"].items())
            counts.push_back(fmt::format("{} {}", grouped(count.get<std::uint64_t>()), kind));
    }
    std::string line = joined(counts);
    if (result.contains("distance")) line = joined({line, range_text("distance", result["distance"])}, "; ");
    std::vector<std::string> lines{line.empty() ? "nothing was queried" : line};
    const Json& answers = result["answers"];
    for (std::size_t i = 0; i < std::min(few, answers.size()); ++i) lines.push_back(answer_text(answers[i]));
    const auto count = result["count"].get<std::size_t>();
    if (count > few) lines.push_back(fmt::format("and {} more", grouped(count - few)));
    return lines;
}

std::vector<std::string> section_summary(const Json& result, const std::string& unit) {
    const auto planes = result["planes"].get<std::uint64_t>(), empty = result["empty"].get<std::uint64_t>(),
               contours = result["contours"].get<std::uint64_t>(),
               holes = result["holes"].get<std::uint64_t>(), open = result["open"].get<std::uint64_t>();
    const auto count = [](std::uint64_t n, const char* one, const char* several) {
        return n == 0 ? std::string() : fmt::format("{} {}", grouped(n), n == 1 ? one : several);
    };
    const std::string in = unit == "unknown" ? "" : " " + unit;
    std::string what = count(contours, "contour", "contours");
    const std::string of = joined({count(holes, "hole", "holes"), count(open, "open", "open")});
    if (!of.empty()) what += " (" + of + ")";
    if (empty > 0) what = joined({what, fmt::format("{} empty", grouped(empty))});
    std::vector<std::string> lines{fmt::format("{}: area {}{}{}, {}", count(planes, "section", "sections"),
                                               number(result["area"]), in, in.empty() ? "" : "2", what)};
    const Json& first = result["sections"][0];
    if (planes == 1 && first.contains("parts") && first["parts"].size() == 1 &&
        !first["parts"][0]["centroid"].is_null()) {
        const Json& part = first["parts"][0];
        lines.push_back(fmt::format("centroid {}, second moments about it {} to {}{}{}",
                                    point(part["centroid"]["world"]),
                                    number(part["principal_axes"]["smallest"]),
                                    number(part["principal_axes"]["largest"]), in, in.empty() ? "" : "4"));
    }
    if (result.contains("spacing")) {
        std::string line = fmt::format("areas times spacing {}", number(result["area_times_spacing"]));
        if (!result["volume"].is_null()) line += fmt::format(", volume {}", number(result["volume"]));
        lines.push_back(line);
    }
    return lines;
}

std::string counts_summary(const Json& result, const std::string& nothing) {
    std::vector<std::string> names;
    std::map<std::string, std::uint64_t> sums;
    for (const Json& part : result["parts"])
        for (const auto& [name, value] : part.items())
            if (value.is_number_integer() && value > 0) {
                if (!sums.contains(name)) names.push_back(name);
                sums[name] += value.get<std::uint64_t>();
            }
    std::vector<std::string> texts;
    for (const auto& name : names) {
        std::string words = name;
        std::replace(words.begin(), words.end(), '_', ' ');
        texts.push_back(fmt::format("{} {}", words, grouped(sums[name])));
    }
    return texts.empty() ? nothing : joined(texts);
}

} // namespace facetmill::report
