#include "pipeline/trace.hpp"

#include "cache/state.hpp"
#include "pipeline/plan.hpp"
#include "platform/build_id.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

using Way = TracedStep::Way;

/// The name of the last run of this pipeline file with the same outputs.
std::string name_of_last(const Plan& plan, const std::string& pipeline_file) {
    std::vector<std::string> texts{
        pipeline_file.empty() ? plan.name : fs::absolute(pipeline_file).lexically_normal().generic_string()};
    for (const auto& output : planned_outputs(plan))
        texts.push_back(fs::absolute(output).lexically_normal().generic_string());
    return cache::key_of(texts);
}

Json as_json(const TracedStep& step) {
    return {{"name", step.name},     {"stage", step.stage},   {"options", step.options},
            {"inputs", step.inputs}, {"before", step.before}, {"key", step.key}};
}

bool is_step(const Json& step) {
    const auto has = [&](const char* key, bool (Json::*is)() const noexcept) {
        return step.contains(key) && (step[key].*is)();
    };
    const auto is_pair = [](const Json& input) {
        return input.is_array() && input.size() == 2 && input[0].is_string() && input[1].is_string();
    };
    return step.is_object() && has("name", &Json::is_string) && has("stage", &Json::is_string) &&
           has("options", &Json::is_object) && has("inputs", &Json::is_array) &&
           has("before", &Json::is_string) && has("key", &Json::is_string) &&
           std::all_of(step["inputs"].begin(), step["inputs"].end(), is_pair);
}

bool is_last(const Json& last) {
    return last.is_object() && last.contains("format") && last["format"] == 1 && last.contains("code") &&
           last.contains("steps") && last["steps"].is_array() &&
           std::all_of(last["steps"].begin(), last["steps"].end(), is_step);
}

/// A damaged entry counts as missing.
Json last_of(const std::string& name, cache::Store& store) {
    const auto bytes = store.get(name, cache::Kind::last_run);
    if (!bytes) return {};
    Json last = parse_json(io::as_text(*bytes), Broken::discarded);
    return is_last(last) ? last : Json();
}

const Json* step_named(const Json& last, const std::string& name) {
    if (last.is_null()) return nullptr;
    for (const auto& step : last["steps"])
        if (step["name"] == name) return &step;
    return nullptr;
}

std::string shown(const Json* value) {
    if (!value || value->is_null()) return "none";
    return value->is_string() ? value->get<std::string>() : value->dump();
}

const Json* member(const Json& object, const std::string& key) {
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

void compare_options(const Json& before, const Json& now, std::vector<std::string>& out) {
    for (const auto& [key, value] : now.items()) {
        const Json* old = member(before, key);
        if (!old || *old != value) out.push_back(fmt::format("{} {} -> {}", key, shown(old), shown(&value)));
    }
    for (const auto& [key, value] : before.items())
        if (!now.contains(key)) out.push_back(fmt::format("{} {} -> none", key, shown(&value)));
}

void compare_inputs(const Json& before, const TracedStep& now, std::vector<std::string>& out) {
    const auto sum_before = [&](const std::string& path) -> const Json* {
        for (const auto& input : before)
            if (input[0] == path) return &input[1];
        return nullptr;
    };
    for (const auto& [path, sum] : now.inputs) {
        const Json* old = sum_before(path);
        if (!old)
            out.push_back(fmt::format("{} is read now", path));
        else if (*old != sum)
            out.push_back(fmt::format("{} changed", path));
    }
}

/// The reason why a step ran that could have been recalled.
std::string reason(const TracedStep& step, const Json& last) {
    const Json* before = step_named(last, step.name);
    if (last.is_null()) return "no earlier run wrote these outputs";
    if (!before) return "it is new";
    if ((*before)["stage"] != step.stage)
        return fmt::format("{} -> {}", shown(&(*before)["stage"]), step.stage);
    std::vector<std::string> reasons;
    compare_options((*before)["options"], step.options, reasons);
    compare_inputs((*before)["inputs"], step, reasons);
    if (!reasons.empty()) return fmt::format("{}", fmt::join(reasons, ", "));
    if (last["code"] != code_id()) return "facetmill or one of its libraries changed";
    if ((*before)["before"] != step.before) return "the scene before it changed";
    if ((*before)["key"] != step.key) return "its options are written differently";
    return "its result was not stored or was removed";
}

std::string line_of(const TracedStep& step, const Json& last) {
    switch (step.way) {
    case Way::recalled:
        return fmt::format("{}: from the cache", step.name);
    case Way::again:
        return fmt::format("{} reruns: only the report of its result was stored", step.name);
    case Way::always:
        return fmt::format("{}: runs every time", step.name);
    case Way::skipped:
        return fmt::format("{}: skipped", step.name);
    case Way::ran:
        break;
    }
    const bool first = last.is_null() || !step_named(last, step.name);
    return fmt::format("{} {}: {}", step.name, first ? "runs" : "reruns", reason(step, last));
}

} // namespace

std::vector<std::string> explained(const Trace& trace, const Plan& plan, const std::string& pipeline_file,
                                   cache::Store& store) {
    const Json last = last_of(name_of_last(plan, pipeline_file), store);
    std::vector<std::string> lines;
    for (const auto& step : trace) lines.push_back(line_of(step, last));
    return lines;
}

void remember(const Trace& trace, const Plan& plan, const std::string& pipeline_file, bool whole,
              cache::Store& store) {
    const std::string name = name_of_last(plan, pipeline_file);
    const Json before = whole ? Json() : last_of(name, store);
    Json last = {{"format", 1}, {"code", code_id()}, {"steps", Json::array()}};
    for (const auto& step : trace) last["steps"].push_back(as_json(step));
    const Json reached = last;
    if (!before.is_null())
        for (const auto& step : before["steps"])
            if (!step_named(reached, step["name"].get<std::string>())) last["steps"].push_back(step);
    const std::string text = last.dump(-1, ' ', false, Json::error_handler_t::replace);
    store.put(name, cache::Kind::last_run, std::as_bytes(std::span(text)));
}

} // namespace facetmill::pipeline
