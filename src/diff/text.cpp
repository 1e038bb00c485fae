#include "base/markup.hpp"
#include "diff/comparison.hpp"
#include "geometry/deviation/deviation_fields.hpp"
#include "report/html_parts.hpp"
#include "report/markdown_parts.hpp"
#include "report/viewer.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// Whether people are shown the line, without `all`.
bool is_told(const Difference& d) { return !d.same || !d.compared || d.section == "geometry"; }

std::string text_of(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    return value.dump();
}

std::vector<const Difference*> of_section(const Comparison& comparison, const std::string& section) {
    std::vector<const Difference*> lines;
    for (const auto& d : comparison.lines)
        if (d.section == section) lines.push_back(&d);
    return lines;
}

/// "maximum 0.2 (0.05 % of the diagonal) from [1, 2, 3] of the first surface".
std::string place_text(const DeviationResult& d) {
    const bool forward = d.forward.maximum >= d.backward.maximum;
    const auto& way = forward ? d.forward : d.backward;
    if (!(way.maximum > 0) || !std::isfinite(way.maximum)) return {};
    const Vec3 &p = way.from, &q = way.to;
    return fmt::format("    farthest: {:.6g} {:.6g} {:.6g} of {}, nearest there {:.6g} {:.6g} {:.6g}\n", p.x,
                       p.y, p.z, forward ? "the first" : "the second", q.x, q.y, q.z);
}

std::string measured_text(const Comparison& comparison) {
    const DeviationResult& d = *comparison.deviation;
    std::string text = fmt::format(
        "    {} and {} samples, seed {}, and all {} and {} vertices; percentages of {:.6g}\n",
        d.forward.samples, d.backward.samples, d.seed, d.forward.vertices, d.backward.vertices, d.diagonal);
    const std::string a = comparison.geometry_a, b = comparison.geometry_b;
    if (a != "surface" || b != "surface")
        text += fmt::format("    of {} and {}; mean and rms of points are over all of them\n", a, b);
    return text;
}

std::string verdict(const Comparison& comparison) {
    if (comparison.differs()) return "differ";
    if (!comparison.complete()) return "agree in everything that was compared";
    return comparison.ignored.empty() ? "agree" : "agree in everything that was requested";
}

/// "not compared: A: the lines".
std::vector<std::string> left_out_lines(const Comparison& comparison, const std::string& name_a,
                                        const std::string& name_b) {
    std::vector<std::string> lines;
    for (const auto& left : comparison.left_out)
        lines.push_back(fmt::format("not compared: {}: {}", left.of_a ? name_a : name_b, left.what));
    return lines;
}

} // namespace

std::string to_text(const Comparison& comparison, const std::string& name_a, const std::string& name_b,
                    bool all) {
    std::string text = fmt::format("{} and {} {}\n", name_a, name_b, verdict(comparison));
    for (const auto& line : left_out_lines(comparison, name_a, name_b)) text += "  " + line + "\n";
    for (const char* section : comparison_sections) {
        const auto lines = of_section(comparison, section);
        if (lines.empty()) continue;
        const auto different = std::count_if(lines.begin(), lines.end(), [](auto* d) { return !d->same; });
        text += fmt::format("  {}: {}{}\n", section,
                            different == 0 ? "same" : fmt::format("{} different", different),
                            comparison.ignored.contains(section) ? " (ignored)" : "");
        for (const auto* d : lines)
            if (all || is_told(*d))
                text += fmt::format("    {:<23} {:<15} {:<15} {}{}\n", d->name, text_of(d->a), text_of(d->b),
                                    d->same ? "" : "differs ", d->note);
        if (section == std::string_view("geometry") && comparison.deviation)
            text += place_text(*comparison.deviation) + measured_text(comparison);
    }
    if (!comparison.hint.empty()) text += fmt::format("  hint: {}\n", comparison.hint);
    return text;
}

namespace {

/// "A and B differ", with what was not compared.
std::vector<std::string> head_lines(const Comparison& comparison, const std::string& name_a,
                                    const std::string& name_b) {
    std::vector<std::string> lines = left_out_lines(comparison, name_a, name_b);
    lines.insert(lines.begin(), verdict(comparison));
    if (!comparison.hint.empty()) lines.push_back("hint: " + comparison.hint);
    return lines;
}

std::string section_title(const Comparison& comparison, const char* section) {
    return std::string(section) + (comparison.ignored.contains(section) ? " (ignored)" : "");
}

std::string difference_rows(const Comparison& comparison, const char* section) {
    std::string rows;
    for (const auto* d : of_section(comparison, section))
        if (is_told(*d))
            rows += fmt::format("<tr>{}{}{}{}{}</tr>\n",
                                cell(fmt::format("<span class=\"{}\">{}</span>", d->same ? "good" : "bad",
                                                 d->same ? "same" : "differs")),
                                cell(code(d->name)), cell(escaped(text_of(d->a))),
                                cell(escaped(text_of(d->b))), cell(escaped(d->note)));
    return rows;
}

} // namespace

std::string to_html(const Comparison& comparison, const std::string& name_a, const std::string& name_b,
                    const ComparisonPictures& pictures) {
    std::string out = html_begin(fmt::format("{} and {}", name_a, name_b), "Compared by facetmill diff.");
    const char* kind = comparison.differs() ? "bad" : "good";
    for (const auto& line : head_lines(comparison, name_a, name_b)) {
        out += fmt::format("<p class=\"verdict {}\">{}</p>\n", kind, escaped(line));
        kind = "warn";
    }
    out += figure(picture("first", name_a, pictures.a), name_a);
    out += compared_figure(picture("second", name_b, pictures.b), "first", name_b,
                           fmt::format("{}; left of the slider {}", name_b, name_a));
    if (!pictures.distance.empty()) {
        const std::string caption =
            fmt::format("{}: the signed distance of each vertex from {}, above 0 outside", name_b, name_a);
        out += figure(picture("distance", caption, pictures.distance), caption);
    }
    out += viewer_section(pictures.view);
    for (const char* section : comparison_sections)
        out +=
            table(section_title(comparison, section), heads({"outcome", "name", "first", "second", "note"}),
                  difference_rows(comparison, section));
    return out + html_end();
}

std::string to_markdown(const Comparison& comparison, const std::string& name_a, const std::string& name_b) {
    std::string out = fmt::format("## {} and {}\n", markdown_escaped(name_a), markdown_escaped(name_b));
    for (const auto& line : head_lines(comparison, name_a, name_b))
        out += fmt::format("\n**{}**\n", markdown_escaped(line));
    for (const char* section : comparison_sections) {
        std::vector<std::vector<std::string>> rows;
        for (const auto* d : of_section(comparison, section))
            if (is_told(*d))
                rows.push_back({d->same ? "same" : "differs", markdown_escaped(d->name),
                                markdown_escaped(text_of(d->a)), markdown_escaped(text_of(d->b)),
                                markdown_escaped(d->note)});
        out += markdown_table(section_title(comparison, section),
                              {"outcome", "name", "first", "second", "note"}, rows);
    }
    return out + fmt::format("\nfacetmill {}\n", FACETMILL_VERSION);
}

Json to_json(const Comparison& comparison, const std::string& name_a, const std::string& name_b) {
    Json sections = Json::object();
    for (const char* section : comparison_sections) {
        const auto lines = of_section(comparison, section);
        if (lines.empty()) continue;
        Json list = Json::array();
        bool same = true;
        for (const auto* d : lines) {
            same &= d->same;
            list.push_back({{"name", d->name},
                            {"a", d->a},
                            {"b", d->b},
                            {"same", d->same},
                            {"compared", d->compared},
                            {"note", d->note.empty() ? Json(nullptr) : Json(d->note)}});
        }
        sections[section] = {
            {"same", same}, {"decides", !comparison.ignored.contains(section)}, {"lines", std::move(list)}};
    }
    Json left_out = Json::array();
    for (const auto& left : comparison.left_out)
        left_out.push_back({{"file", left.of_a ? "a" : "b"}, {"what", left.what}});
    return {{"a", name_a},
            {"b", name_b},
            {"same", !comparison.differs()},
            {"complete", comparison.complete()},
            {"left_out", std::move(left_out)},
            {"geometry_of", comparison.deviation
                                ? Json{{"a", comparison.geometry_a}, {"b", comparison.geometry_b}}
                                : Json(nullptr)},
            {"sections", std::move(sections)},
            {"hint", comparison.hint.empty() ? Json(nullptr) : Json(comparison.hint)},
            {"deviation", comparison.deviation ? deviation_json(*comparison.deviation) : Json(nullptr)}};
}

namespace {

Json typed(const char* type, const char* about = nullptr) {
    Json schema = {{"type", type}};
    if (about) schema["description"] = about;
    return schema;
}

Json closed_object(Json properties) {
    Json required = Json::array();
    for (const auto& [key, value] : properties.items()) required.push_back(key);
    return {{"type", "object"},
            {"required", std::move(required)},
            {"additionalProperties", false},
            {"properties", std::move(properties)}};
}

} // namespace

Json comparison_schema() {
    const Json value = {{"type", Json::array({"null", "boolean", "number", "string"})}};
    const Json line =
        closed_object({{"name", typed("string")},
                       {"a", value},
                       {"b", value},
                       {"same", typed("boolean")},
                       {"compared", typed("boolean", "False when it could not be: the note says why")},
                       {"note", {{"type", Json::array({"string", "null"})}}}});
    const Json section = closed_object({{"same", typed("boolean")},
                                        {"decides", typed("boolean", "False when ignored")},
                                        {"lines", {{"type", "array"}, {"items", line}}}});
    Json sections =
        typed("object", "By section: counts, topology, geometry, attributes, materials, parts, document");
    sections["additionalProperties"] = section;
    const Json left_out =
        closed_object({{"file", {{"enum", Json::array({"a", "b"})}}}, {"what", typed("string")}});
    const Json kind = {{"enum", Json::array({"surface", "points", "nothing"})}};
    Json geometry_of = closed_object({{"a", kind}, {"b", kind}});
    geometry_of["type"] = Json::array({"object", "null"});
    geometry_of["description"] = "What the deviation is of; null when ignored";
    Json schema = closed_object(
        {{"a", typed("string", "The first file")},
         {"b", typed("string", "The second file")},
         {"same", typed("boolean", "Nothing that decides differs: the exit code is 0")},
         {"complete", typed("boolean", "Nothing was left out, and all that decides could be compared")},
         {"left_out",
          {{"type", "array"}, {"items", left_out}, {"description", "Contents of a file that were not read"}}},
         {"geometry_of", geometry_of},
         {"sections", std::move(sections)},
         {"hint",
          {{"type", Json::array({"string", "null"})},
           {"description", "A unit or an up axis that would explain how the geometry differs"}}},
         {"deviation",
          {{"type", Json::array({"object", "null"})}, {"description", "As in reports; null when ignored"}}}});
    Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "facetmill diff"}};
    out.update(schema);
    return out;
}

} // namespace facetmill::report
