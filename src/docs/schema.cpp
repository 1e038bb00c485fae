#include "docs/schema.hpp"

#include "geometry/triangulate/face_kinds_fields.hpp"
#include "pipeline/params.hpp"
#include "report/form.hpp"
#include "report/render.hpp"
#include "stage/common_keys.hpp"
#include "stage/contract.hpp"
#include "stage/stage.hpp"

#include <algorithm>

namespace facetmill::docs {

namespace {

Json ref(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

Json with_expressions(Json schema);

/// The schema, or an expression instead.
Json or_expression(Json schema) {
    if (schema.is_boolean()) return schema; // the schema only names a property
    schema = with_expressions(std::move(schema));
    Json described;
    for (const char* annotation : {"description", "default"})
        if (schema.contains(annotation)) {
            described[annotation] = schema[annotation];
            schema.erase(annotation);
        }
    described["anyOf"] = Json::array({std::move(schema), ref("expression")});
    return described;
}

/// The schema with expressions allowed at every value inside it.
Json with_expressions(Json schema) {
    if (schema.contains("properties"))
        for (auto& [name, property] : schema["properties"].items())
            property = or_expression(std::move(property));
    if (schema.contains("items")) schema["items"] = or_expression(std::move(schema["items"]));
    for (const char* combiner : {"anyOf", "oneOf", "allOf"})
        if (schema.contains(combiner))
            for (auto& form : schema[combiner]) form = with_expressions(std::move(form));
    return schema;
}

/// A map with one stage (or branch, foreach) key, and the common keys.
Json step_schema(const std::string& key, Json value, const Json& beside = Json::object()) {
    Json properties = {{key, std::move(value)}};
    properties.update(beside);
    for (const auto& common : common_keys()) properties[common.name] = ref(common.name.c_str());
    return {{"title", key},
            {"type", "object"},
            {"required", Json::array({key})},
            {"properties", properties},
            {"additionalProperties", false}};
}

/// Whether the stage may be written without a value.
bool may_be_bare(const StageInfo& stage) {
    const auto& rules = stage.options->exclusions;
    const auto& options = stage.options->options;
    return std::none_of(options.begin(), options.end(), [](const Option& o) { return o.required; }) &&
           std::all_of(rules.begin(), rules.end(),
                       [](const Exclusion& rule) { return rule.rule == Exclusion::Rule::at_most_one; });
}

Json stage_step(const StageInfo& stage) {
    Json value = or_expression(stage.options->schema());
    if (may_be_bare(stage)) value["anyOf"].push_back({{"type", "null"}});
    value["description"] = stage.about;
    return step_schema(stage.name, std::move(value));
}

Json branch_step() {
    const Json arms = {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", ref("stages")}};
    return step_schema("branch", arms, {{"join", {{"type", "boolean"}}}});
}

Json foreach_step() {
    const Json values = {{"type", Json::array({"array", "string", "number", "boolean"})}};
    const Json variables = {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", values}};
    Json step = step_schema("foreach", variables, {{"do", ref("stages")}, {"join", {{"type", "boolean"}}}});
    step["required"].push_back("do");
    return step;
}

Json include_step() {
    return {{"title", "include"},
            {"description", "The stages of another file, which replace this item."},
            {"type", "object"},
            {"required", Json::array({"include"})},
            {"properties",
             {{"include", {{"type", "string"}, {"description", "The file, relative to this file."}}},
              {"with", {{"type", "object"}, {"description", "Values for its params."}}}}},
            {"additionalProperties", false}};
}

Json step_forms() {
    Json forms = Json::array(), bare = Json::array();
    for (const auto& s : stages())
        if (may_be_bare(s)) bare.push_back(s.name);
    forms.push_back({{"title", "stage"}, {"description", "A stage with its defaults."}, {"enum", bare}});
    for (const auto& s : stages()) forms.push_back(stage_step(s));
    forms.push_back(branch_step());
    forms.push_back(foreach_step());
    forms.push_back(include_step());
    return {{"anyOf", forms}};
}

Json param_schema() {
    const Json single = pipeline::single_param_types();
    Json all = single;
    all.push_back("list");
    const Json types = {{"enum", all}};
    const Json limit = {{"type", Json::array({"number", "string"})},
                        {"description", "A limit of the value."}};
    const Json whole = {
        {"title", "param"},
        {"type", "object"},
        {"required", Json::array({"type"})},
        {"properties",
         {{"type", types},
          {"of", {{"enum", single}, {"description", "The type of the values in the list."}}},
          {"default", {{"description", "The default value."}}},
          {"help", {{"type", "string"}, {"description", "The purpose of the parameter."}}},
          {"required", {{"type", "boolean"}, {"description", "Whether you must give a value."}}},
          {"min", limit},
          {"max", limit},
          {"choices", {{"type", "array"}, {"description", "The allowed values of a choice."}}}}},
        {"additionalProperties", false}};
    return {{"anyOf", Json::array({types, whole})}};
}

Json definitions() {
    Json all = {{"expression", {{"type", "string"}, {"pattern", "\\$\\{"}}}};
    for (const auto& key : common_keys()) all[key.name] = with_expressions(key.schema());
    all["param"] = param_schema();
    all["step"] = step_forms();
    all["stages"] = {{"title", "stages"},
                     {"description", "The steps, in order."},
                     {"type", "array"},
                     {"items", ref("step")}};
    return all;
}

} // namespace

Json pipeline_schema() {
    const Json path = {{"type", "string"}, {"minLength", 1}};
    const Json one_or_more = Json::array({path, {{"type", "array"}, {"items", path}}});
    return {
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", "facetmill pipeline, format 1"},
        {"type", "object"},
        {"required", Json::array({"facetmill", "stages"})},
        {"properties",
         {{"facetmill", {{"const", 1}, {"description", "The version of the pipeline format."}}},
          {"requires",
           {{"type", "string"}, {"description", "The releases of facetmill that may run it: \">=0.3,<2\"."}}},
          {"about", {{"type", "string"}, {"description", "The purpose of the pipeline, in one sentence."}}},
          {"params",
           {{"type", "object"},
            {"description", "The params that -D sets. Give a name and a type, or a map with type, default, "
                            "help, min, max and choices."},
            {"additionalProperties", ref("param")}}},
          {"stages", ref("stages")},
          {"allow",
           {{"anyOf", one_or_more},
            {"description", "The ids of warnings to hide. They do not fail under --strict."}}},
          {"report",
           {{"anyOf", one_or_more},
            {"description", std::string("Reports: ") + report::report_suffixes + "."}}}}},
        {"patternProperties", {{"^x-", true}}},
        {"additionalProperties", false},
        {"$defs", definitions()}};
}

Json with_single_types(Json schema) {
    if (schema.is_array())
        for (auto& item : schema) item = with_single_types(std::move(item));
    if (!schema.is_object()) return schema;
    for (auto& [key, value] : schema.items())
        if (key != "enum" && key != "const" && key != "default") value = with_single_types(std::move(value));
    const auto type = schema.find("type");
    if (type == schema.end() || !type->is_array()) return schema;
    Json forms = Json::array(), about = Json::object();
    const Json names = *type;
    schema.erase("type");
    for (const char* annotation : {"description", "title", "default"})
        if (schema.contains(annotation)) {
            about[annotation] = schema[annotation];
            schema.erase(annotation);
        }
    for (const auto& name : names) {
        Json form = name == "null" ? Json::object() : schema;
        form["type"] = name;
        forms.push_back(std::move(form));
    }
    about["anyOf"] = std::move(forms);
    return about;
}

Json info_schema() {
    Json schema = report::info_schema();
    schema["properties"]["face_kinds"] = face_kinds_fields().schema();
    return schema;
}

Json report_schema() {
    Json schema = report::schema();
    Json& definitions = schema["$defs"];
    Json forms = Json::array();
    for (const auto& stage : stages()) {
        const std::string name = "result." + stage.name;
        definitions[name] = stage.result->schema();
        definitions[name]["properties"]["deviation"] = contract_result_schema();
        // A stage that was skipped or has failed leaves no scene, and no result.
        const Json done = {{"stage", {{"const", stage.name}}}, {"after", {{"type", "object"}}}};
        forms.push_back(
            {{"if", {{"properties", done}}}, {"then", {{"properties", {{"result", ref(name.c_str())}}}}}});
    }
    definitions["stage"]["allOf"] = std::move(forms);
    return schema;
}

} // namespace facetmill::docs
