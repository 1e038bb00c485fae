#pragma once
// Random options of any stage: ranges, choices and groups come from its declaration, everything else from
// its JSON Schema. New stages and options therefore need no change here.

#include "base/math/numbers.hpp"
#include "docs/schema.hpp"
#include "options/declaration.hpp"
#include "support/draw.hpp"
#include "support/run_stage.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::test {

/// A number in the range: usually small, often at the ends, sometimes very large.
inline double random_number(Draw& draw, const Range& range, bool whole) {
    const double low = range.min.value_or(whole ? 0 : -10),
                 high = range.max.value_or(std::max(10.0, 2 * low + 10));
    double x = 0;
    switch (draw.below(8)) {
    case 0:
        x = low;
        break;
    case 1:
        x = whole ? low + 1 : range.max ? high : 1e-3;
        break;
    case 2:
        x = whole             ? low + static_cast<double>(draw.below(40))
            : draw.once_in(3) ? 1e30
                              : draw.between(low, high);
        break;
    case 3:
        x = whole ? low + static_cast<double>(draw.below(12)) : std::max(low, 1e-9);
        break;
    default:
        x = whole ? low + static_cast<double>(draw.below(5)) : draw.between(low, std::min(high, low + 5));
    }
    if (range.max) x = std::min(x, high);
    return whole ? std::floor(x) : x;
}

inline std::string spelled_number(double x) { return facetmill::to_string(x); }

inline std::string random_length(Draw& draw, const Range& range) {
    const std::string number = spelled_number(random_number(draw, range, false));
    return number + draw.word({"", "", "%", "%", "%", "% of part", "% of load", "mm", "in"});
}

/// A random text: names in the test's scenes and folders, and texts with a meaning for options.
inline std::string random_word(Draw& draw) {
    return draw.word({"part",       "*",      "b",           "!b",         "x.lod1",
                      "material b", "NORMAL", "quality",     "TEXCOORD_0", "COLOR_0",
                      "group",      "_THREE", "x",           "xyz",        "z",
                      "z=50%",      "x=0.1",  "y=centre",    "closed",     "faces",
                      "corner",     "front",  "turntable",   "auto",       "off",
                      "all",        "1",      "0.5",         "a b",        "[1, 2, 3]",
                      "glb",        "50%",    "1,0,0;0,1,1", "KHR_*",      "POLYGON((0 0,1 0,0 1,0 0))"});
}

/// A random file name: existing files of the test's folder, and outputs of every kind.
inline std::string random_path(Draw& draw) {
    return draw.word({"in.ply", "in.obj", "in.glb", "in.stl", "no.ply", "out.ply", "out.obj", "out.stl",
                      "out.off", "out.glb", "out.gltf", "out.svg", "out.dxf", "out.json", "out.csv",
                      "out.png"});
}

Value from_schema(Draw& draw, const Json& schema, const Range& range = {});

inline Value from_object(Draw& draw, const Json& schema) {
    Value map = Value::map({});
    const Json required = schema.value("required", Json::array());
    const Json properties = schema.value("properties", Json::object());
    const std::size_t rate = 2 + draw.below(4);
    for (const auto& [name, property] : properties.items()) {
        const bool needed = std::find(required.begin(), required.end(), Json(name)) != required.end();
        if (needed || draw.once_in(rate)) map.set(name, from_schema(draw, property));
    }
    return map;
}

inline Value from_pattern(Draw& draw, const std::string& pattern, const Range& range) {
    const std::string number = spelled_number(random_number(draw, range, false));
    if (pattern.find("um|") != std::string::npos) return Value::scalar(random_length(draw, range));
    if (pattern.find("deg") != std::string::npos)
        return Value::scalar(number + draw.word({"deg", "rad", ""}));
    if (pattern.find("iB") != std::string::npos) return Value::scalar(number + draw.word({"kB", "MiB", "B"}));
    if (pattern.find("[xyz]") != std::string::npos)
        return Value::scalar(draw.word({"x=", "y=", "z="}) +
                             (draw.once_in(3) ? "centre" : random_length(draw, {})));
    if (pattern.find("cent") != std::string::npos && draw.once_in(2)) return Value::scalar("centre");
    return Value::scalar(spelled_number(100 * random_number(draw, range, false)) + "%");
}

inline Value from_type(Draw& draw, const std::string& type, const Json& schema, Range range) {
    if (schema.contains("minimum")) range.min = schema["minimum"].get<double>();
    if (schema.contains("exclusiveMinimum")) range.min = schema["exclusiveMinimum"].get<double>();
    if (schema.contains("maximum")) range.max = schema["maximum"].get<double>();
    if (type == "boolean") return Value::scalar(draw.once_in(2) ? "true" : "false");
    if (type == "integer" || type == "number")
        return Value::scalar(spelled_number(random_number(draw, range, type == "integer")));
    if (type == "object") return from_object(draw, schema);
    if (type == "array") {
        std::size_t count = schema.value("minItems", std::size_t{0});
        count = std::min(count + draw.below(4), schema.value("maxItems", std::size_t{8}));
        std::vector<Value> items;
        for (; count > 0; --count) items.push_back(from_schema(draw, schema.value("items", Json::object())));
        return Value::list(std::move(items));
    }
    if (schema.contains("pattern")) return from_pattern(draw, schema["pattern"], range);
    return Value::scalar(random_word(draw));
}

/// A value that the schema usually allows. The stage checks rules that the schema states only in words.
inline Value from_schema(Draw& draw, const Json& schema, const Range& range) {
    if (!schema.is_object() || schema.empty()) return Value::scalar(random_word(draw));
    for (const char* forms : {"anyOf", "oneOf"})
        if (schema.contains(forms))
            return from_schema(draw, schema[forms][draw.below(schema[forms].size())], range);
    if (schema.contains("enum")) {
        const Json& one = schema["enum"][draw.below(schema["enum"].size())];
        return Value::scalar(one.is_string() ? one.get<std::string>() : one.dump());
    }
    if (schema.contains("const")) return Value::scalar(schema["const"].dump());
    if (!schema.contains("type")) return Value::scalar(random_word(draw));
    const Json& type = schema["type"];
    return from_type(draw, type.is_array() ? type[draw.below(type.size())] : type, schema, range);
}

Value from_declaration(Draw& draw, const Declaration& declaration);

inline Value random_value(Draw& draw, const Option& option) {
    switch (option.kind) {
    case OptionKind::path:
        return Value::scalar(random_path(draw));
    case OptionKind::ratio: {
        const double x =
            random_number(draw, {option.range.min.value_or(0), option.range.max.value_or(1)}, false);
        return Value::scalar(spelled_number(100 * x) + "%");
    }
    case OptionKind::length:
        return Value::scalar(random_length(draw, option.range));
    case OptionKind::angle:
        return Value::scalar(spelled_number(random_number(draw, option.range, false)) +
                             draw.word({"deg", ""}));
    case OptionKind::group:
        if (option.fields && !draw.once_in(3)) return from_declaration(draw, *option.fields);
        break;
    case OptionKind::list:
        if (option.one == OptionKind::path) return Value::scalar(random_path(draw));
        break;
    default:
        break;
    }
    return from_schema(draw, option.schema, option.range);
}

/// A subset of the options, at most one of each exclusive group.
inline Value from_declaration(Draw& draw, const Declaration& declaration) {
    std::vector<std::string> taken, left_out;
    for (const auto& rule : declaration.exclusions) {
        if (rule.rule == Exclusion::Rule::at_least_one) {
            taken.push_back(draw.one_of(rule.names));
            continue;
        }
        const std::string one = draw.one_of(rule.names);
        if (rule.rule == Exclusion::Rule::exactly_one) taken.push_back(one);
        for (const auto& name : rule.names)
            if (name != one) left_out.push_back(name);
    }
    const auto among = [](const std::vector<std::string>& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    Value map = Value::map({});
    const std::size_t rate = 2 + draw.below(6);
    for (const auto& option : declaration.options) {
        if (among(left_out, option.name) && !option.required) continue;
        if (option.required || among(taken, option.name) || draw.once_in(rate))
            map.set(option.name, random_value(draw, option));
    }
    return map;
}

/// The options in an example of the stage, "relax: {iterations: 3}", without the common keys.
inline Value from_example(Draw& draw, const StageInfo& stage) {
    Problems problems;
    const auto text = std::make_shared<const SourceText>(SourceText{"example", draw.one_of(stage.examples)});
    const Value step = pipeline::parse_yaml(text, problems);
    const Value* value = step.find(stage.name);
    return value ? *value : Value{};
}

/// Options that the stage accepts; none if it refuses all drawn options.
inline std::optional<Value> random_options(Draw& draw, const StageInfo& stage) {
    for (int tries = 0; tries < 12; ++tries) {
        Value value = draw.once_in(6) && !stage.examples.empty() ? from_example(draw, stage)
                                                                 : from_declaration(draw, *stage.options);
        Problems problems;
        use_of(stage, value, problems);
        if (!problems.any_errors()) return value;
    }
    return {};
}

/// The value as written in a pipeline.
inline std::string text_of(const Value& value) {
    std::string text;
    if (value.is_scalar())
        return value.text.find_first_of(",:[]{}!*'% ") == std::string::npos ? value.text
                                                                            : "'" + value.text + "'";
    for (const auto& item : value.items) text += (text.empty() ? "" : ", ") + text_of(item);
    if (value.is_list()) return "[" + text + "]";
    for (const auto& e : value.entries) text += (text.empty() ? "" : ", ") + e.key + ": " + text_of(e.value);
    return value.is_map() ? "{" + text + "}" : "";
}

} // namespace facetmill::test
