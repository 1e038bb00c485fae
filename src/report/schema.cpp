#include "report/contents.hpp"
#include "report/record_fields.hpp"
#include "report/render.hpp"
#include "report/schema_forms.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// The schema of a property's value.
Json value_schema(const Property& p) {
    Json schema =
        p.truth() ? typed("boolean") : nullable(p.kind == PropertyKind::count ? "integer" : "number");
    const auto unit = unit_of(p.kind);
    schema["description"] = std::string(p.help) + (unit.empty() ? "" : fmt::format(" In {}.", unit));
    return schema;
}

/// The schema of a property whose values are words.
Json words_schema(const Property& p) {
    Json names = Json::array();
    for (const auto& word : p.words()) names.push_back(word);
    return {{"enum", std::move(names)}, {"description", p.help}};
}

/// The properties of a scene, named once in the table that info, validate, ensure and when share.
Json scene_schema() {
    Json properties = Json::object();
    for (const auto& p : property_table()) {
        if (p.on_request() || p.of_scene() || p.where_any || p.kind == PropertyKind::box) continue;
        properties[std::string(p.name)] = value_schema(p);
    }
    properties["bounds"] = box_schema();
    for (const auto& p : property_table())
        if (p.of_scene() && p.words) properties[std::string(p.name)] = words_schema(p);
    properties["attributes"] =
        list_of(attribute_fields().schema(), "The attributes of all parts, each listed once.");
    properties["materials"] = list_of(typed("string"), "The names of the materials.");
    properties["parts"] = list_of(part_fields().schema(), "The parts, in the order of the scene.");
    Json scene = closed_object(std::move(properties));
    for (const auto& p : property_table()) // present if requested, or if the scene has any
        if (p.on_request() || p.where_any) scene["properties"][std::string(p.name)] = value_schema(p);
    return scene;
}

Json definitions() {
    Json brief = brief_fields().schema();
    brief["type"] = Json::array({"object", "null"});
    return {{"diagnostic", diagnostic_fields().schema()},
            {"brief", std::move(brief)},
            {"stage", stage_fields().schema()},
            {"check", check_fields().schema()},
            {"scene", scene_schema()}};
}

} // namespace

Json schema() {
    Json out = {{"$schema", schema_dialect}, {"title", "facetmill report"}};
    out.update(run_fields().schema());
    out["$defs"] = definitions();
    return out;
}

Json info_schema() {
    Json out = {{"$schema", schema_dialect}, {"title", "facetmill info"}};
    Json scene = scene_schema();
    const Json error = closed_object(
        {{"id", typed("string")}, {"message", typed("string")}, {"exit_code", typed("integer")}});
    scene["properties"]["file"] = typed("string", "The path of the file, as given.");
    Json drawn = box_schema();
    drawn["description"] =
        "The bounding box of the drawn contents: skinned and morphed parts in their default pose, animated "
        "nodes at their largest scale, without hidden parts and levels.";
    scene["properties"]["drawn_bounds"] = std::move(drawn);
    scene["properties"]["drawn_area"] =
        nullable("number", "The area of all parts, with skinned and morphed parts in their default pose.");
    scene["properties"]["error"] = {
        {"anyOf", Json::array({error, typed("null")})},
        {"description", "Why the file cannot be read. Other keys are then missing."}};
    // An entry is complete, or has an error.
    Json named = Json::object();
    for (const Json& key : scene["required"]) named[key.get<std::string>()] = Json::object();
    scene["if"] = {{"properties", {{"error", {{"type", "null"}}}}}};
    scene["then"] = {{"required", scene["required"]}, {"properties", std::move(named)}};
    scene["required"] = {"file", "error"};
    scene["properties"]["components_detail"] =
        list_of(component_fields().schema(), "The components with the most faces, largest first.");
    scene["properties"]["components_omitted"] =
        typed("integer", "The number of components that components_detail does not list.");
    out.update(scene);
    return out;
}

Json timings_schema() {
    Json schema = timings_fields().schema();
    schema["$schema"] = schema_dialect;
    schema["title"] = "facetmill timings, format 1";
    schema["description"] = "Values that differ from run to run. Reports leave them out.";
    return schema;
}

} // namespace facetmill::report
