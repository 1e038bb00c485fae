#include "base/text/words.hpp"
#include "pipeline/document.hpp"
#include "pipeline/params.hpp"
#include "pipeline/plan.hpp"
#include "report/contents.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

std::string list_of(const std::vector<std::string>& texts) {
    return fmt::format("{}", fmt::join(texts, ", "));
}

std::string assertions_text(const Assertions& assertions) {
    std::string out;
    for (const auto& a : assertions.all) append_item(out, fmt::format("{}: {}", a.property, to_string(a)));
    return out;
}

std::string contract_text(const Contract& contract) {
    std::string out = assertions_text(contract.assertions);
    if (contract.deviation) append_item(out, "deviation: " + to_string(*contract.deviation));
    return out;
}

std::string extras(const Step& step) {
    std::string out;
    if (!step.only.patterns.empty()) out += fmt::format("  only [{}]", list_of(step.only.patterns));
    if (step.when)
        out += step.when->known ? (*step.when->known ? "" : "  skipped: its condition (when) is false")
                                : fmt::format("  when {{{}}}", assertions_text(step.when->predicates));
    if (step.ensure) out += fmt::format("  ensure {{{}}}", contract_text(*step.ensure));
    if (step.join) out += "  join";
    return out;
}

/// {"amplitude": {"given": "0.1in", "is": 2.54, "unit": "mm"}}
Json lengths_json(const Headers::Lengths& lengths) {
    Json all = report::resolved_json(lengths.all);
    for (Json& one : all) one["unit"] = to_string(lengths.unit);
    return all;
}

/// The lengths as text: "  (amplitude: 0.1in is 2.54 mm)".
std::string lengths_text(const Headers& headers, const Step& step) {
    const auto lengths = headers.lengths.find(step.path);
    if (lengths == headers.lengths.end()) return "";
    std::string out;
    for (const auto& [option, given, is] : lengths->second.all)
        append_item(out, fmt::format("{}: {} is {} {}", option, given, Json(is).dump(),
                                     to_string(lengths->second.unit)));
    return fmt::format("  ({})", out);
}

void describe(const Steps& steps, const Headers& headers, std::size_t indent, std::string& out) {
    const std::string lead(indent, ' ');
    for (const auto& step : steps) {
        if (step.kind == Step::Kind::stage) {
            const std::string options = step.given.is_null() ? "" : ": " + emit_flow(step.given);
            out += fmt::format("{}{:<16} {}{}{}{}\n", lead, step.name, step.info ? step.info->name : "",
                               options, lengths_text(headers, step), extras(step));
            continue;
        }
        out += fmt::format("{}{}{}\n", lead,
                           step.kind == Step::Kind::branch ? "branch"
                           : step.arms_of_parts            ? "foreach part"
                                                           : "foreach",
                           extras(step));
        for (const auto& arm : step.arms) {
            out += fmt::format("{}  {}:\n", lead, arm.name);
            describe(*arm.steps, headers, indent + 4, out);
        }
    }
}

Json assertions_json(const Assertions& assertions) {
    Json out = Json::object();
    for (const auto& a : assertions.all) out[a.property] = to_string(a);
    return out;
}

Json contract_json(const Contract& contract) {
    Json out = assertions_json(contract.assertions);
    if (contract.deviation) out["deviation"] = to_string(*contract.deviation);
    return out;
}

/// True if another given option excludes this option: its default then has no effect.
bool is_excluded(const Declaration& declaration, const std::string& name, const Value& given) {
    for (const auto& rule : declaration.exclusions)
        if (rule.rule != Exclusion::Rule::at_least_one &&
            std::find(rule.names.begin(), rule.names.end(), name) != rule.names.end())
            for (const auto& other : rule.names)
                if (given.find(other)) return true;
    return false;
}

} // namespace

std::map<std::string, std::string> default_texts(const Step& step) {
    std::map<std::string, std::string> texts;
    const bool is_one = !step.given.is_map() && !step.given.is_null();
    for (const auto& option : step.info->options->options) {
        const bool is_given =
            is_one ? &option == step.info->options->primary() : step.given.find(option.name) != nullptr;
        if (!is_given && !option.default_text.empty() &&
            !is_excluded(*step.info->options, option.name, step.given))
            texts.emplace(option.name, option.default_text);
    }
    return texts;
}

Json options_json(const Step& step) {
    Json out = Json::object();
    const bool is_map = step.given.is_map();
    const Option* primary = step.info->options->primary();
    const auto defaults = default_texts(step);
    for (const auto& option : step.info->options->options) {
        const Value* given = is_map ? step.given.find(option.name) : nullptr;
        if (!is_map && !step.given.is_null() && &option == primary) given = &step.given;
        if (given)
            out[option.name] = value_json(*given);
        else if (const auto text = defaults.find(option.name); text != defaults.end())
            out[option.name] = value_json(Value::scalar(text->second, {}));
    }
    if (is_map) // keys such as property names are not declared options
        for (const auto& entry : step.given.entries)
            if (!out.contains(entry.key)) out[entry.key] = value_json(entry.value);
    return out;
}

namespace {

Json steps_json(const Steps& steps, const Headers& headers) {
    Json all = Json::array();
    for (const auto& step : steps) {
        Json one = {{"name", step.name}, {"path", step.path}};
        if (step.info) {
            one["stage"] = step.info->name;
            one["options"] = options_json(step);
        } else
            one["stage"] = step.kind == Step::Kind::branch ? "branch" : "foreach";
        if (const auto lengths = headers.lengths.find(step.path); lengths != headers.lengths.end())
            one["resolved"] = lengths_json(lengths->second);
        if (!step.only.patterns.empty()) one["only"] = step.only.patterns;
        if (step.when)
            one["when"] = step.when->known ? Json(*step.when->known) : assertions_json(step.when->predicates);
        if (step.ensure) one["ensure"] = contract_json(*step.ensure);
        if (step.join) one["join"] = true;
        for (const auto& arm : step.arms)
            one["arms"].push_back({{"name", arm.name}, {"stages", steps_json(*arm.steps, headers)}});
        all.push_back(std::move(one));
    }
    return all;
}

Json paths_json(const std::vector<std::filesystem::path>& paths) {
    Json all = Json::array();
    for (const auto& path : paths) all.push_back(path.generic_string());
    return all;
}

std::vector<std::filesystem::path> report_paths(const Plan& plan) {
    std::vector<std::filesystem::path> paths;
    for (const auto& report : plan.reports) paths.push_back(plan.places.output(report));
    return paths;
}

const InputHeader* header_of(const Headers& headers, const std::filesystem::path& path) {
    for (const auto& header : headers.inputs)
        if (header.path == path) return &header;
    return nullptr;
}

/// The header as text: "  (glb, in m, y up; parts: hull, mast)".
std::string header_text(const Headers& headers, const std::filesystem::path& path) {
    const InputHeader* input = header_of(headers, path);
    if (!input) return "";
    const io::FileHeader& header = input->header;
    std::string text = header.format;
    text += header.unit == Unit::unknown ? ", no unit" : fmt::format(", in {}", to_string(header.unit));
    if (header.up != UpAxis::unknown) text += fmt::format(", {} up", to_string(header.up));
    constexpr std::size_t max_parts = 8;
    const std::vector<std::string> named(header.parts.begin(),
                                         header.parts.begin() + std::min(max_parts, header.parts.size()));
    if (!named.empty()) text += "; parts: " + list_of(named);
    if (header.parts.size() > max_parts) text += fmt::format(" and {} more", header.parts.size() - max_parts);
    return fmt::format("  ({})", text);
}

Json headers_json(const Headers& headers) {
    Json all = Json::array();
    for (const auto& [path, header] : headers.inputs)
        all.push_back({{"path", path.generic_string()},
                       {"format", header.format},
                       {"unit", to_string(header.unit)},
                       {"up", to_string(header.up)},
                       {"parts", header.parts}});
    return all;
}

} // namespace

std::string describe(const Plan& plan, const Headers& headers) {
    std::string out = plan.name + (plan.about.empty() ? "" : ": " + plan.about) + "\n";
    for (const auto& [name, value] : plan.params.items())
        out += fmt::format("  {} = {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
    out += "stages:\n";
    describe(plan.steps, headers, 2, out);
    const auto files = [&](const char* title, const std::vector<std::filesystem::path>& paths) {
        if (!paths.empty()) out += fmt::format("{}:\n", title);
        for (const auto& path : paths)
            out += fmt::format("  {}{}\n", path.generic_string(), header_text(headers, path));
    };
    files("reads", planned_inputs(plan, headers));
    files("writes", planned_outputs(plan, headers));
    return out;
}

Json describe_json(const Plan& plan, const Headers& headers) {
    return {{"pipeline", plan.name},
            {"about", plan.about},
            {"params", plan.params},
            {"stages", steps_json(plan.steps, headers)},
            {"inputs", paths_json(planned_inputs(plan, headers))},
            {"headers", headers_json(headers)},
            {"outputs", paths_json(planned_outputs(plan, headers))},
            {"reports", paths_json(report_paths(plan))}};
}

} // namespace facetmill::pipeline
