#pragma once
// Building blocks for the JSON Schemas of reports.

#include "base/json.hpp"

#include <initializer_list>
#include <string>

namespace facetmill::report {

[[nodiscard]] inline Json typed(const char* type, const char* about = nullptr) {
    Json schema = {{"type", type}};
    if (about) schema["description"] = about;
    return schema;
}

[[nodiscard]] inline Json nullable(const char* type, const char* about = nullptr) {
    Json schema = {{"type", Json::array({type, "null"})}};
    if (about) schema["description"] = about;
    return schema;
}

[[nodiscard]] inline Json choice(std::initializer_list<const char*> names) {
    Json all = Json::array();
    for (const char* name : names) all.push_back(name);
    return {{"enum", all}};
}

/// An object with exactly these keys.
[[nodiscard]] inline Json closed_object(Json properties) {
    Json required = Json::array();
    for (const auto& [name, schema] : properties.items()) required.push_back(name);
    return {{"type", "object"},
            {"properties", std::move(properties)},
            {"required", std::move(required)},
            {"additionalProperties", false}};
}

[[nodiscard]] inline Json list_of(Json items, const char* about) {
    return {{"type", "array"}, {"items", std::move(items)}, {"description", about}};
}
[[nodiscard]] inline Json reference(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

inline constexpr const char* schema_dialect = "https://json-schema.org/draft/2020-12/schema";

} // namespace facetmill::report
