#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "pipeline/planner.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

constexpr std::size_t max_arms = 10'000;

/// A foreach variable with its values.
struct Axis {
    std::string name;
    std::vector<Value> values;
    bool over_parts = false;
};

std::string to_string(const Value& value) { return value.is_scalar() ? value.text : value.described(); }

/// Calls body with the index of each axis' value; the last axis changes fastest.
template <class Body>
void for_each_combination(const std::vector<Axis>& axes, Body&& body) {
    std::vector<std::size_t> at(axes.size(), 0);
    for (const auto& axis : axes)
        if (axis.values.empty()) return;
    for (;;) {
        body(at);
        std::size_t a = axes.size();
        while (a > 0 && ++at[a - 1] == axes[a - 1].values.size()) at[--a] = 0;
        if (a == 0) return;
    }
}

std::vector<Value> part_values(const std::optional<std::vector<std::string>>& parts, const Mark& where) {
    std::vector<Value> values;
    if (!parts) {
        values.push_back(Value::scalar("*", where, true));
        values.back().deferred = true;
        return values;
    }
    for (const auto& name : *parts) values.push_back(Value::scalar(name, where, true));
    return values;
}

} // namespace

void Planner::plan_branch(Step& step, const Value::Entry& entry, const Scope& scope, const Position& inner,
                          bool& has_scene) {
    step.kind = Step::Kind::branch;
    if (!entry.value.is_map() || entry.value.entries.empty()) {
        problems_.add(
            entry.value.mark.known() ? entry.value.mark : entry.key_mark, "E-TYPE",
            fmt::format("branch is a map of names to lists of stages, found {}", entry.value.described()),
            "branch: {near: [write: a.glb], far: [simplify: 10%, write: b.glb]}");
        return;
    }
    for (const auto& arm : entry.value.entries) {
        if (arm.key.empty() || arm.key.find_first_of("./[]") != std::string::npos)
            problems_.add(arm.key_mark, "E-NAME", fmt::format("'{}' cannot be the name of a branch", arm.key),
                          "a name has no . / [ ]");
        bool arm_has_scene = has_scene;
        const Position position{fmt::format("{}.{}", inner.path, arm.key),
                                fmt::format("{}{}/", inner.prefix, arm.key)};
        auto steps = std::make_shared<Steps>(this->steps(arm.value, scope, position, arm_has_scene));
        step.arms.push_back({arm.key, {}, {}, std::move(steps)});
    }
}

std::vector<Arm> Planner::foreach_arms(const Value& variables, const Value& body, const Scope& scope,
                                       const Position& position,
                                       const std::optional<std::vector<std::string>>& parts, bool has_scene) {
    std::vector<Axis> axes;
    double combinations = 1;
    for (const auto& entry : variables.entries) {
        const bool over_parts = entry.key == "part";
        axes.push_back({entry.key,
                        over_parts              ? part_values(parts, entry.value.mark)
                        : entry.value.is_list() ? entry.value.items
                                                : std::vector<Value>{entry.value},
                        over_parts});
        combinations *= static_cast<double>(axes.back().values.size());
    }
    std::vector<Arm> arms;
    if (combinations > static_cast<double>(max_arms)) {
        problems_.add(variables.mark, "E-FOREACH", fmt::format("more than {} combinations", max_arms));
        return arms;
    }
    for_each_combination(axes, [&](const std::vector<std::size_t>& at) {
        Arm arm;
        Scope inner = scope;
        for (std::size_t a = 0; a < axes.size(); ++a) {
            const Value& value = axes[a].values[at[a]];
            inner.push_back({axes[a].name, value, static_cast<std::int64_t>(at[a]), axes[a].over_parts});
            arm.variables.emplace_back(axes[a].name, value);
            if (axes[a].over_parts && parts) arm.part = at[a];
            const std::string shown = axes[a].over_parts && parts ? safe_name(value.text) : to_string(value);
            append_item(arm.name, fmt::format("{}={}", axes[a].name, shown), ",");
        }
        bool arm_has_scene = has_scene;
        const Position place{fmt::format("{}[{}]", position.path, arms.size()),
                             fmt::format("{}{}/", position.prefix, arm.name)};
        arm.steps = std::make_shared<Steps>(steps(body, inner, place, arm_has_scene));
        arms.push_back(std::move(arm));
    });
    return arms;
}

void Planner::plan_foreach(Step& step, const Value& item, const Value::Entry& entry, const Scope& scope,
                           const Position& inner, bool& has_scene) {
    step.kind = Step::Kind::foreach;
    const Value variables = resolved(entry.value, scope, problems_);
    const Value* body = item.find("do");
    if (!variables.is_map() || variables.entries.empty()) {
        problems_.add(
            variables.mark.known() ? variables.mark : entry.key_mark, "E-TYPE",
            fmt::format("foreach is a map of variables to their values, found {}", variables.described()),
            "foreach: {lod: [50%, 25%]}, and the key do: [...] in the same item");
        return;
    }
    if (!body) {
        problems_.add(entry.key_mark, "E-MISSING", "foreach needs 'do', the stages for each value",
                      "- foreach: {lod: [50%, 25%]}\n      do: [{simplify: \"${lod}\"}]");
        return;
    }
    bool over_parts = false;
    for (const auto& variable : variables.entries) {
        if (find_variable(scope, variable.key))
            problems_.add(variable.key_mark, "E-NAME",
                          fmt::format("a variable '{}' already exists", variable.key));
        else if (!is_variable_name(variable.key))
            problems_.add(variable.key_mark, "E-NAME",
                          fmt::format("'{}' cannot be the name of a variable", variable.key));
        if (variable.key == "part") {
            over_parts = true;
            OptionType<std::vector<std::string>>::parse(variable.value, step.parts.patterns, problems_);
        } else if (variable.value.is_map() || variable.value.is_null() ||
                   (variable.value.is_list() && variable.value.items.empty())) {
            problems_.add(variable.value.mark, "E-FOREACH",
                          fmt::format("'{}' needs a list of values, found {}", variable.key,
                                      variable.value.described()),
                          fmt::format("give values: foreach: {{{}: [50%, 25%]}}", variable.key));
        }
    }
    if (over_parts && !has_scene) {
        problems_.add(entry.key_mark, "E-ORDER",
                      "'foreach: {part: ...}' needs a scene, but nothing has been loaded before it",
                      "begin with load: FILE");
        has_scene = true;
    }
    step.given = variables;
    step.arms = foreach_arms(variables, *body, scope, inner, {}, has_scene);
    if (!over_parts) return;
    // Plans again once the names of the parts are known; the function owns copies of everything it needs.
    PlanSettings later = settings_;
    later.on_include = {}; // called once, from the planning thread
    step.arms_of_parts = [settings = std::move(later), variables, body = *body, scope, inner,
                          has_scene](const std::vector<std::string>& parts, Problems& problems) {
        Planner planner(settings, problems);
        return planner.foreach_arms(variables, body, scope, inner, parts, has_scene);
    };
}

void for_each_step(const Steps& steps, const std::function<void(const Step&)>& visit) {
    for (const Step& step : steps) {
        visit(step);
        for (const Arm& arm : step.arms) for_each_step(*arm.steps, visit);
    }
}

} // namespace facetmill::pipeline
