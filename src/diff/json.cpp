#include "diff/lines.hpp"
#include "geometry/deviation/deviation_fields.hpp"
#include "report/render.hpp"

namespace facetmill::report {

namespace {

Json size_json(const std::optional<SizeOnDisk>& size) {
    if (!size) return nullptr;
    return {{"all", size->bytes},
            {"geometry", size->kinds.geometry},
            {"textures", size->kinds.textures},
            {"json", size->kinds.json}};
}

/// Parts and materials that are not equal.
Json changes_json(const Comparison& comparison) {
    Json list = Json::array();
    for (const ItemChange& item : comparison.items)
        if (item.change != ItemChange::Change::same)
            list.push_back({{"of", item.is_part ? "part" : "material"},
                            {"name", item.name},
                            {"change", to_string(item.change)},
                            {"note", item.note.empty() ? Json(nullptr) : Json(item.note)}});
    return list;
}

} // namespace

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
    return {
        {"a", name_a},
        {"b", name_b},
        {"same", !comparison.differs()},
        {"complete", comparison.complete()},
        {"left_out", std::move(left_out)},
        {"geometry_of", comparison.deviation
                            ? Json{{"a", comparison.geometry_a}, {"b", comparison.geometry_b}}
                            : Json(nullptr)},
        {"sections", std::move(sections)},
        {"properties",
         {{"a", properties_json(comparison.properties_a)}, {"b", properties_json(comparison.properties_b)}}},
        {"bytes", {{"a", size_json(comparison.size_a)}, {"b", size_json(comparison.size_b)}}},
        {"changes", changes_json(comparison)},
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
    const Json line = closed_object(
        {{"name", typed("string")},
         {"a", value},
         {"b", value},
         {"same", typed("boolean")},
         {"compared",
          typed("boolean", "False when the values could not be compared; the note gives the reason.")},
         {"note", {{"type", Json::array({"string", "null"})}}}});
    const Json section = closed_object(
        {{"same", typed("boolean")},
         {"decides", typed("boolean", "Whether differences in this section change the exit code.")},
         {"lines", {{"type", "array"}, {"items", line}}}});
    Json sections =
        typed("object", "The sections: counts, topology, geometry, attributes, materials, parts, document.");
    sections["additionalProperties"] = section;
    const Json left_out =
        closed_object({{"file", {{"enum", Json::array({"a", "b"})}}}, {"what", typed("string")}});
    const Json kind = {{"enum", Json::array({"surface", "points", "nothing"})}};
    Json geometry_of = closed_object({{"a", kind}, {"b", kind}});
    geometry_of["type"] = Json::array({"object", "null"});
    geometry_of["description"] = "The geometry that was measured. Null when geometry is ignored.";
    const Json change = closed_object({{"of", {{"enum", Json::array({"part", "material"})}}},
                                       {"name", typed("string")},
                                       {"change", {{"enum", Json::array({"added", "removed", "changed"})}}},
                                       {"note", {{"type", Json::array({"string", "null"})}}}});
    Json size = closed_object({{"all", typed("integer")},
                               {"geometry", typed("integer")},
                               {"textures", typed("integer")},
                               {"json", typed("integer")}});
    size["type"] = Json::array({"object", "null"});
    size["description"] =
        "The size of the file and the files that it refers to, in bytes. Null for standard input.";
    const Json properties = typed("object", "The properties, as in facetmill info.");
    Json schema = closed_object(
        {{"a", typed("string", "The first file.")},
         {"bytes", closed_object({{"a", size}, {"b", size}})},
         {"properties", closed_object({{"a", properties}, {"b", properties}})},
         {"changes",
          {{"type", "array"},
           {"items", change},
           {"description", "Parts and materials that differ, matched by name."}}},
         {"b", typed("string", "The second file.")},
         {"same",
          typed("boolean",
                "Whether the files are the same, apart from ignored sections. The exit code is then 0.")},
         {"complete",
          typed("boolean", "Whether both files were read completely and every deciding value was compared.")},
         {"left_out",
          {{"type", "array"},
           {"items", left_out},
           {"description", "Contents of a file that could not be read."}}},
         {"geometry_of", geometry_of},
         {"sections", std::move(sections)},
         {"hint",
          {{"type", Json::array({"string", "null"})},
           {"description", "A unit or up axis that would explain the difference in geometry."}}},
         {"deviation",
          {{"type", Json::array({"object", "null"})},
           {"description", "The deviation, as in reports. Null when geometry is ignored."}}}});
    Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "facetmill diff"}};
    out.update(schema);
    return out;
}

} // namespace facetmill::report
