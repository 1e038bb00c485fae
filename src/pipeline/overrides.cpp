#include "base/text/spelling.hpp"
#include "options/lists.hpp"
#include "pipeline/params.hpp"
#include "pipeline/planner.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

std::vector<std::string> split_at_dots(const std::string& text) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.size(), text.find('.', at));
        parts.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return parts;
}

/// "[0, 0, 1]" becomes a list; any other text is a scalar.
Value command_line_value(const std::string& text, const Mark& where) {
    const bool is_list = text.starts_with('[') && text.ends_with(']');
    return is_list ? list_of_words(text, where) : Value::scalar(text, where);
}

} // namespace

Overrides::Overrides(const PlanSettings& settings, Problems& problems)
    : update_baselines_(settings.update_baselines) {
    for (const auto& [key, text] : settings.sets) {
        const std::string whole = fmt::format("{}={}", key, text);
        const Mark where = command_line_mark("--set", whole);
        std::vector<std::string> path = split_at_dots(key);
        if (path.size() < 2 || std::find(path.begin(), path.end(), "") != path.end()) {
            problems.add(where, "E-SET", fmt::format("expected stage.option=value, found '{}'", whole));
            continue;
        }
        if (text.find("${") != std::string::npos) {
            problems.add(where, "E-SET", fmt::format("--set takes a plain value, found '{}'", text),
                         "declare a param, use it in the pipeline as ${name}, and set it: -D name=value");
            continue;
        }
        std::string target = path.front();
        path.erase(path.begin());
        all_.push_back({std::move(target), std::move(path),
                        command_line_value(text, command_line_mark("--set", whole, key.size() + 1)), where});
    }
}

void Overrides::apply(const std::vector<std::string>& names, const StageInfo& stage, Value& given,
                      Problems& problems) {
    const OptionRoles& roles = stage.roles;
    if (update_baselines_ && !roles.updates_baseline.empty() && given.find(roles.baseline)) {
        const Mark where = command_line_mark("--update-baseline", "");
        given.set(roles.updates_baseline, Value::scalar("true", where), where);
        any_baseline_ = true;
    }
    for (auto& change : all_) {
        if (std::find(names.begin(), names.end(), change.target) == names.end()) continue;
        change.used = true;
        const Declaration* declaration = &*stage.options;
        Value* value = &given;
        for (std::size_t i = 0; i < change.path.size(); ++i) {
            if (!value->is_map() && !value->is_null()) {
                const Option* primary = declaration ? declaration->primary() : nullptr;
                if (!primary) {
                    problems.add(
                        change.where, "E-SET",
                        fmt::format("the pipeline gives '{}' in short form, which cannot be changed in parts",
                                    i == 0 ? stage.name : change.path[i - 1]),
                        "set it as a whole");
                    break;
                }
                *value = Value::map({{primary->name, value->mark, *value}}, value->mark);
            }
            const Option* option = declaration ? declaration->find(change.path[i]) : nullptr;
            declaration = option ? option->fields.get() : nullptr;
            Value* next = value->find(change.path[i]);
            value = next ? next : &value->set(change.path[i], {}, change.where);
            if (!value->mark.known()) value->mark = change.where;
            if (i + 1 == change.path.size()) *value = change.value;
        }
    }
}

void Overrides::check_all_used(const std::set<std::string>& names, Problems& problems) const {
    constexpr std::size_t max_listed = 20;
    const std::vector<std::string> all(names.begin(), names.end());
    if (update_baselines_ && !any_baseline_)
        problems.add(command_line_mark("--update-baseline", ""), "E-BASELINE",
                     "no stage of the pipeline has a baseline", "validate: {baseline: known.json}");
    for (const auto& change : all_)
        if (!change.used)
            problems.add(change.where, "E-SET", fmt::format("the pipeline has no stage '{}'", change.target),
                         all.empty() ? ""
                         : all.size() <= max_listed
                             ? suggestion(change.target, all)
                             : did_you_mean(change.target, all, "facetmill plan lists them"));
}

} // namespace facetmill::pipeline
