#include "report/html_stages.hpp"

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/check_text.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// A value in readable form.
std::string told(const Json& value) {
    if (value.is_null()) return "-";
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_number_integer() && value >= 0) return grouped(value.get<std::uint64_t>());
    if (value.is_number_float()) return readable(value.get<double>());
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string items;
    for (const Json& item : value) append_item(items, told(item));
    if (value.empty()) return "none";
    return value.size() > 1 || items.empty() ? "[" + items + "]" : items;
}

bool is_list_of_objects(const Json& value) {
    return value.is_array() &&
           std::any_of(value.begin(), value.end(), [](const Json& item) { return item.is_object(); });
}

using NamedTexts = std::vector<std::pair<std::string, std::string>>;

/// The values of an object by name; nested objects as a.b.
void flatten(const Json& object, const std::string& before, NamedTexts& out) {
    for (const auto& [name, value] : object.items()) {
        if (value.is_object())
            flatten(value, before + name + ".", out);
        else if (!is_list_of_objects(value))
            out.emplace_back(before + name, told(value));
    }
}

NamedTexts flattened(const Json& object) {
    NamedTexts out;
    if (object.is_object()) flatten(object, "", out);
    return out;
}

/// A table of a list of objects, one per row; for a single object, one row per value.
std::string list_table(const std::string& title, const Json& list) {
    if (list.size() == 1) return subtable(title, heads({"name", "value"}), value_rows(list.front()));
    constexpr std::size_t most = 50;
    std::vector<std::string> names;
    std::vector<NamedTexts> rows;
    for (const Json& item : list) {
        if (rows.size() == most) break;
        rows.push_back(flattened(item));
        for (const auto& [name, value] : rows.back())
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    std::string header, body;
    for (const auto& name : names) header += fmt::format("<th>{}</th>", escaped(name));
    for (const NamedTexts& row : rows) {
        body += "<tr>";
        for (const auto& name : names) {
            const auto at =
                std::find_if(row.begin(), row.end(), [&](const auto& entry) { return entry.first == name; });
            body += cell(at == row.end() ? "" : escaped(at->second));
        }
        body += "</tr>\n";
    }
    const std::string rest =
        list.size() > most
            ? fmt::format("<p class=\"soft\">{} more rows are in the JSON report.</p>\n", list.size() - most)
            : "";
    return subtable(title, header, body) + rest;
}

/// A table for each list of objects in an object.
std::string list_tables(const Json& object, const std::string& before) {
    std::string out;
    for (const auto& [name, value] : object.items()) {
        if (value.is_object()) out += list_tables(value, fmt::format("{}{}.", before, name));
        if (is_list_of_objects(value)) out += list_table(fmt::format("Result: {}{}", before, name), value);
    }
    return out;
}

std::string option_rows(const StageRecord& stage) {
    std::string rows = value_rows(stage.options);
    for (const auto& [option, given, is] : stage.resolved)
        rows += fmt::format("<tr>{}{}</tr>\n", cell(code(option)),
                            cell(fmt::format("{} = {}", escaped(given), readable(is))));
    return rows;
}

std::string attribute_change_rows(const StageRecord& stage) {
    std::string rows;
    for (const auto& [part, change] : stage.attribute_changes)
        rows += fmt::format("<tr>{}{}{}{}{}</tr>\n", cell(escaped(part)), cell(code(change.attribute)),
                            cell(to_string(change.domain)),
                            cell(fmt::format("<span class=\"{}\">{}</span>",
                                             change.kind == AttributeChange::Kind::dropped ? "warn" : "",
                                             to_string(change.kind))),
                            cell(escaped(change.why)));
    return rows;
}

std::string details(const StageRecord& stage) {
    const std::string head = heads({"name", "value"});
    std::string out = subtable("Options", head, option_rows(stage));
    out += subtable("Result", head, value_rows(stage.result));
    if (stage.result.is_object()) out += list_tables(stage.result, "");
    out += subtable("Attributes", heads({"part", "attribute", "domain", "change", "why"}),
                    attribute_change_rows(stage));
    if (out.empty()) return out;
    return fmt::format("<details><summary>options, result, attributes</summary>\n{}</details>\n", out);
}

/// "232,484 -> 23,308 faces (10 %), 11,656 vertices"
std::string counts(const StageRecord& stage) {
    if (stage.skipped) return "skipped: its condition (when) was false";
    if (!stage.after) return stage.before ? grouped(stage.before->faces) + " faces, then failed" : "failed";
    const std::size_t before = stage.before ? stage.before->faces : 0, after = stage.after->faces;
    const std::string vertices = grouped(stage.after->vertices) + " vertices";
    if (before == after) return fmt::format("{} faces, {}", grouped(after), vertices);
    if (before == 0) return fmt::format("&rarr; {} faces, {}", grouped(after), vertices);
    return fmt::format("{} &rarr; {} faces ({}), {}", grouped(before), grouped(after),
                       percentage(100.0 * static_cast<double>(after) / static_cast<double>(before)),
                       vertices);
}

std::string picture_id(std::size_t stage) { return fmt::format("picture-{}", stage); }

/// The picture of a stage, with a slider to the previous picture if that has the same camera.
std::string picture_of(const RunRecord& record, std::size_t number, std::size_t& last) {
    const StageRecord& stage = record.stages[number];
    if (stage.picture.empty()) return {};
    const StageRecord* before = last < number ? &record.stages[last] : nullptr;
    const std::string before_id = picture_id(last);
    last = number;
    const auto shown = [&](const std::string& caption) {
        return picture(picture_id(number), caption, stage.picture);
    };
    const std::string caption = fmt::format("{}: {}", stage.name,
                                            !stage.after || stage.after->faces > 0
                                                ? grouped(stage.after ? stage.after->faces : 0) + " faces"
                                                : grouped(stage.after->vertices) + " vertices");
    if (!before || stage.camera == 0 || stage.camera != before->camera)
        return figure(shown(caption), caption);
    return compared_figure(shown(caption), before_id, stage.name,
                           fmt::format("{}; left of the slider: after {}", caption, before->name));
}

std::string section(const RunRecord& record, std::size_t number, std::size_t& last) {
    const StageRecord& stage = record.stages[number];
    std::string told = fmt::format("<h3>{0} {1}</h3>\n<p>{2}</p>\n", escaped(stage.name),
                                   stage.name == stage.stage ? "" : code(stage.stage), counts(stage));
    for (const auto& line : stage.said) told += fmt::format("<p>{}</p>\n", escaped(line));
    for (const auto& w : stage.warnings)
        told += fmt::format("<p class=\"warn\">{}: {}{}</p>\n", escaped(w.id), escaped(w.message),
                            w.hint.empty() ? "" : "<br>hint: " + escaped(w.hint));
    const std::string shown = picture_of(record, number, last);
    std::string out = fmt::format("<section class=\"stage{}\">\n", shown.empty() ? "" : " pictured");
    if (!shown.empty()) out += fmt::format("<div class=\"shown\">{}</div>\n", shown);
    out += fmt::format("<div class=\"told\">{}{}</div>\n", told, details(stage));
    if (stage.deviation)
        out += "<div class=\"wide\">" +
               deviation_html(*stage.deviation, fmt::format("stage-{}", number), stage.name) + "</div>\n";
    return out + "</section>\n";
}

} // namespace

std::string value_rows(const Json& object) {
    std::string rows;
    for (const auto& [name, value] : flattened(object))
        rows += fmt::format("<tr>{}{}</tr>\n", cell(code(name)), cell(escaped(value)));
    return rows;
}

std::string stage_sections(const RunRecord& record) {
    std::string out;
    std::size_t last = record.stages.size(); // the stage with the last picture
    for (std::size_t i = 0; i < record.stages.size(); ++i) out += section(record, i, last);
    if (out.empty()) return out;
    out += not_drawn_html(record.not_drawn);
    return fmt::format(
        "<h2>Stages</h2>\n{}<p class=\"soft\">Each stage that changed the visible scene has a picture. "
        "The inside of a surface is orange. Distances of a single stage are shown for scenes of up to "
        "500,000 faces.{}{}</p>\n",
        out, record.pictures_shrunk ? " Later pictures are smaller, so that the page stays below 3 MB." : "",
        record.pictures_left_out > 0
            ? fmt::format(" {} left out for the same reason.",
                          counted(record.pictures_left_out, "picture is", "pictures are"))
            : "");
}

} // namespace facetmill::report
