#include "report/contents.hpp"
#include "report/render.hpp"
#include "report/schema_forms.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

Json file(bool read_back) {
    Json properties = {{"path", typed("string")},
                       {"bytes", {{"type", "integer"}, {"minimum", 0}}},
                       {"sha256", {{"type", "string"}, {"pattern", "^([0-9a-f]{64})?$"}}}};
    if (read_back) properties["read_back"] = {{"description", "The result of reading the written file back"}};
    return closed_object(std::move(properties));
}

/// What a check found, by the kind of its property.
Json found() {
    return {{"description", "A number, a truth, a word, a box {min, max} or names; null: it does not apply"},
            {"type", Json::array({"integer", "number", "boolean", "string", "object", "array", "null"})}};
}

/// One value of a property.
Json value_schema(const Property& p) {
    Json schema =
        p.truth() ? typed("boolean") : nullable(p.kind == PropertyKind::count ? "integer" : "number");
    const auto unit = unit_of(p.kind);
    schema["description"] = std::string(p.help) + (unit.empty() ? "" : fmt::format(" In {}.", unit));
    return schema;
}

/// Of a property whose values are words.
Json words_schema(const Property& p) {
    Json names = Json::array();
    for (const auto& word : p.words()) names.push_back(word);
    return {{"enum", std::move(names)}, {"description", p.help}};
}

/// The properties of a scene, named once in the table that info, validate, ensure and when share.
Json scene_schema() {
    Json properties = Json::object();
    for (const auto& p : property_table()) {
        if (p.on_request() || p.of_scene() || p.kind == PropertyKind::box) continue;
        properties[std::string(p.name)] = value_schema(p);
    }
    properties["bounds"] = box_schema();
    for (const auto& p : property_table())
        if (p.of_scene() && p.words) properties[std::string(p.name)] = words_schema(p);
    properties["attributes"] = list_of(attribute_fields().schema(), "Each attribute once");
    properties["materials"] = list_of(typed("string"), "Names of the materials");
    properties["parts"] = list_of(part_fields().schema(), "The parts, in order");
    Json scene = closed_object(std::move(properties));
    for (const auto& p : property_table()) // there when they were asked for
        if (p.on_request()) scene["properties"][std::string(p.name)] = value_schema(p);
    return scene;
}

Json stage_schema() {
    const Json changes = closed_object({{"part", typed("string")},
                                        {"attribute", typed("string")},
                                        {"domain", choice({"vertex", "wedge", "face"})},
                                        {"change", choice({"kept", "interpolated", "recomputed", "dropped"})},
                                        {"why", nullable("string")}});
    return closed_object({{"name", typed("string", "Unique in the run")},
                          {"stage", typed("string")},
                          {"path", typed("string", "Where in the pipeline: stages[5].branch.far[0]")},
                          {"skipped", typed("boolean", "Its `when` did not hold")},
                          {"before", reference("brief")},
                          {"after", reference("brief")},
                          {"resolved", typed("object", "Lengths that depended on the scene")},
                          {"attribute_changes", list_of(changes, "What each attribute went through")},
                          {"warnings", list_of(reference("diagnostic"), "What the stage warned of")},
                          {"result", typed("object", "What the stage itself reports")}});
}

Json definitions() {
    Json brief = brief_fields().schema();
    brief["type"] = Json::array({"object", "null"});
    return {{"diagnostic", diagnostic_schema()},
            {"brief", std::move(brief)},
            {"stage", stage_schema()},
            {"check",
             closed_object(
                 {{"name", typed("string", "The property")},
                  {"stage", typed("string")},
                  {"passed", typed("boolean")},
                  {"severity", choice({"error", "warning", "note"})},
                  {"expected", typed("string")},
                  {"found", found()},
                  {"hint", nullable("string", "When it failed: the stage that fixes it")},
                  {"part", nullable("string", "The part that it refers to; null: the scene")},
                  {"where", nullable("string", "Its position in the pipeline")},
                  {"waived", typed("boolean", "It failed, and the baseline lists the failure")},
                  {"locations", nullable("integer", "The number of locations that violate it")},
                  {"new_locations", nullable("integer", "The number of them that are not in the baseline")},
                  {"evidence", nullable("array", "The first locations, or the worst values")}})},
            {"scene", scene_schema()}};
}

} // namespace

Json schema() {
    Json properties = closed_object(
        {{"format", {{"const", 1}}},
         {"tool", closed_object({{"name", {{"const", "facetmill"}}}, {"version", typed("string")}})},
         {"pipeline", typed("string")},
         {"about", nullable("string")},
         {"passed", typed("boolean")},
         {"exit_code", typed("integer")},
         {"errors", list_of(reference("diagnostic"), "Why it failed")},
         {"warnings", list_of(reference("diagnostic"), "Of the run as a whole")},
         {"params", typed("object")},
         {"inputs", list_of(file(false), "Files that were read")},
         {"stages", list_of(reference("stage"), "In the order they ran")},
         {"checks", list_of(reference("check"), "What validate and ensure asked")},
         {"outputs", list_of(file(true), "Files that were written; none when the run failed")},
         {"properties",
          {{"anyOf", Json::array({reference("scene"), typed("null")})},
           {"description", "Of the scene at the end; null when the run failed before it"}}}});
    Json out = {{"$schema", schema_dialect}, {"title", "facetmill report"}};
    out.update(properties);
    out["$defs"] = definitions();
    return out;
}

Json info_schema() {
    Json out = {{"$schema", schema_dialect}, {"title", "facetmill info"}};
    Json scene = scene_schema();
    scene["properties"]["components_detail"] =
        list_of(component_fields().schema(), "The components with most faces, the largest first");
    scene["properties"]["components_omitted"] =
        typed("integer", "How many components there are beyond those of components_detail");
    out.update(scene);
    return out;
}

Json timings_schema() {
    Json schema = closed_object(
        {{"format", {{"const", 1}}},
         {"pipeline", typed("string")},
         {"seconds", typed("number")},
         {"peak_memory", typed("integer", "Bytes")},
         {"threads", typed("integer")},
         {"stages", list_of(closed_object({{"name", typed("string")}, {"seconds", typed("number")}}),
                            "In the order of the report's stages")}});
    schema["$schema"] = schema_dialect;
    schema["title"] = "facetmill timings, format 1";
    schema["description"] = "What differs from run to run, and is in no report for that reason.";
    return schema;
}

} // namespace facetmill::report
