#include "base/text/spelling.hpp"
#include "pipeline/placeholders.hpp"
#include "pipeline/planner.hpp"
#include "stage/common_keys.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

/// Keys that may accompany a stage in an item.
bool belongs(std::string_view key, std::string_view stage) {
    const ControlItem* control = control_item(stage);
    if (is_common_key(key)) return !control || control->takes_common_keys;
    return control && std::find(control->keys.begin(), control->keys.end(), key) != control->keys.end();
}

std::vector<std::string> keys_beside(const std::string& stage) {
    std::vector<std::string> keys;
    for (const auto& common : common_keys())
        if (belongs(common.name, stage)) keys.push_back(common.name);
    if (const ControlItem* control = control_item(stage))
        keys.insert(keys.end(), control->keys.begin(), control->keys.end());
    return keys;
}

bool is_stage(std::string_view key) { return control_item(key) || stage_named(key); }

std::vector<std::string> all_stage_names() {
    auto names = stage_names();
    for (const auto& item : control_items()) names.push_back(item.name);
    return names;
}

std::string hint_of_no_stage(const std::string& name) {
    const std::size_t word_end = std::min(name.size(), name.find_first_of(" :\t\"'!"));
    const std::string word = name.substr(0, word_end);
    if (word_end < name.size() && (is_stage(word) || stage_called(word))) { // "write a.glb", "simplify:10%"
        if (name.find_first_of("!+|") != std::string::npos)
            return "leave out the quotes, so that each word is a separate argument";
        std::size_t value = name.find_first_not_of(" :\t", word_end);
        value = std::min(value, name.size());
        return fmt::format("write a colon and a space after the name: {}: {}", word, name.substr(value));
    }
    if (name.find_first_of("./") != std::string::npos)
        return fmt::format("load: {0} reads a file, write: {0} writes one", name);
    return hint_for_stage(name, all_stage_names());
}

void no_such_stage(const std::string& name, const Mark& where, Problems& problems) {
    problems.add(where, "E-STAGE", fmt::format("there is no stage '{}'", name), hint_of_no_stage(name));
}

/// A common key that is also the name of a stage, if it is alone.
bool is_key_and_stage(std::string_view key) { return is_common_key(key) && stage_named(key); }

/// The entry of the item that is its stage; null after a problem.
const Value::Entry* stage_entry(const Value& item, Problems& problems) {
    const Value::Entry* stage = nullptr;
    for (const auto& entry : item.entries)
        if (!stage && is_stage(entry.key) && !is_common_key(entry.key)) stage = &entry;
    for (const auto& entry : item.entries)
        if (!stage && is_key_and_stage(entry.key)) stage = &entry;
    bool good = true, known = true; // known: the only errors are unknown words
    for (const auto& entry : item.entries) {
        if (&entry == stage || (stage && belongs(entry.key, stage->key)) ||
            (!stage && is_common_key(entry.key)))
            continue;
        good = false;
        if (!stage || is_common_key(stage->key)) {
            no_such_stage(entry.key, entry.key_mark, problems);
            return nullptr;
        }
        if (is_stage(entry.key)) {
            problems.add(
                entry.key_mark, "E-STAGE",
                fmt::format("two stages in one item: '{}' and '{}'", stage->key, entry.key),
                fmt::format("make it two items:\n    - {}: ...\n    - {}: ...", stage->key, entry.key));
            known = false;
            continue;
        }
        const StageInfo* info = stage_named(stage->key);
        const bool is_option = info && info->options->find(entry.key);
        known &= !is_option;
        std::string hint = suggestion(entry.key, keys_beside(stage->key));
        if (is_option)
            hint = fmt::format("it is an option of {}: write {}: {{{}: ...}}, or indent it more", stage->key,
                               stage->key, entry.key);
        else if (entry.key == "if" || entry.key == "unless" || entry.key == "condition")
            hint = "a condition is written when: ...";
        else if (is_common_key(entry.key))
            hint = fmt::format("it applies to a single stage: add it to the stages of {}", stage->key);
        problems.add(entry.key_mark, "E-KEY", fmt::format("'{}' is not a key of an item", entry.key), hint);
    }
    if (!stage && good) problems.add(item.mark, "E-STAGE", "the item has no stage", "- clip: {plane: z=0}");
    return good || known ? stage : nullptr; // also checks its options
}

/// If a whole path is a name from a file ("${part}"), it becomes a safe file name instead of a path. given:
/// the value with its expressions resolved.
Value with_safe_paths(const Value& value, Value given, const StageInfo& stage, const Scope& scope) {
    const auto make_safe = [&](const Value& before, Value& after) {
        if (after.is_scalar() && is_name_from_file(before, scope)) after.text = safe_name(after.text);
    };
    const Option* primary = stage.options->primary();
    if (value.is_scalar() && primary && primary->kind == OptionKind::path) make_safe(value, given);
    if (!value.is_map() || !given.is_map()) return given;
    for (auto& entry : given.entries) {
        const Option* option = stage.options->find(entry.key);
        const Value* before = value.find(entry.key);
        if (option && before && option->kind == OptionKind::path) make_safe(*before, entry.value);
    }
    return given;
}

} // namespace

Steps Planner::steps(const Value& list, const Scope& scope, const Position& position, bool& has_scene) {
    Steps all;
    if (list.is_null()) return all;
    if (!list.is_list()) {
        problems_.add(list.mark, "E-TYPE",
                      fmt::format("expected a list of stages, found {}", list.described()),
                      "begin every stage with '- '");
        return all;
    }
    for (std::size_t i = 0; i < list.items.size() && count_step(list.items[i].mark); ++i)
        step(list.items[i], scope, {fmt::format("{}[{}]", position.path, i), position.prefix}, has_scene,
             all);
    return all;
}

bool Planner::count_step(const Mark& where) {
    constexpr std::size_t max_steps = 50'000;
    if (steps_ > max_steps) return false; // reported once
    if (++steps_ <= max_steps) return true;
    problems_.add(where, "E-FOREACH",
                  fmt::format("with every foreach expanded, the pipeline has more than {} stages", max_steps),
                  "a foreach inside a foreach multiplies the stages; use fewer values");
    return false;
}

void Planner::step(const Value& item, const Scope& scope, const Position& position, bool& has_scene,
                   Steps& steps) {
    Value as_map = item;
    if (item.is_scalar()) {
        if (!is_stage(item.text)) {
            no_such_stage(item.text, item.mark, problems_);
            return;
        }
        as_map = Value::map({{item.text, item.mark, Value{}}}, item.mark);
        as_map.entries[0].value.mark = item.mark;
    }
    if (!as_map.is_map()) {
        problems_.add(item.mark, "E-TYPE", fmt::format("expected a stage, found {}", item.described()),
                      "- clip: {plane: z=0}");
        return;
    }
    const Value::Entry* entry = stage_entry(as_map, problems_);
    if (!entry) {
        has_scene = true; // the faulty step may be a load, so do not report missing scenes
        return;
    }
    const ControlItem* control = control_item(entry->key);
    if (control && control->kind == ControlItem::Kind::include) {
        for (auto& one : include(as_map, *entry, scope, position, has_scene)) steps.push_back(std::move(one));
        return;
    }
    Step step;
    step.where = entry->key_mark;
    step.path = position.path;
    common_keys(step, as_map, scope, entry->key, position);
    const bool auto_named = step.name == position.prefix + entry->key;
    const Position inner{step.path + "." + entry->key, auto_named ? position.prefix : step.name + "/"};
    if (!control)
        plan_stage(step, *entry, scope, has_scene);
    else if (control->kind == ControlItem::Kind::branch)
        plan_branch(step, *entry, scope, inner, has_scene);
    else
        plan_foreach(step, as_map, *entry, scope, inner, has_scene);
    if (const Value* join = as_map.find("join"); join && step.kind != Step::Kind::stage) {
        OptionType<bool>::parse(resolved(*join, scope, problems_), step.join, problems_);
        has_scene = has_scene || step.join;
    }
    steps.push_back(std::move(step));
}

void Planner::common_keys(Step& step, const Value& item, const Scope& scope, const std::string& base,
                          const Position& position) {
    for (const CommonKey& key : facetmill::common_keys()) {
        const Value* value = key.name == base ? nullptr : item.find(key.name); // the key is the stage itself
        switch (key.use) {
        case CommonKey::Use::names:
            name_step(step, value, scope, base, position);
            break;
        case CommonKey::Use::conditions:
            if (value) step.when = read_condition(*value, scope, problems_);
            break;
        case CommonKey::Use::selects:
            if (value) read_only(*value, scope, step.only);
            break;
        case CommonKey::Use::ensures:
            if (value) parse_contract(resolved(*value, scope, problems_), step.ensure.emplace(), problems_);
            break;
        }
    }
}

void Planner::name_step(Step& step, const Value* given, const Scope& scope, const std::string& base,
                        const Position& position) {
    std::string name = base;
    if (given) {
        OptionType<std::string>::parse(resolved(*given, scope, problems_), name, problems_);
        if (name.empty() || name.find_first_of("./[]") != std::string::npos)
            problems_.add(given->mark, "E-NAME", fmt::format("'{}' cannot be the name of a stage", name),
                          "a name has no . / [ ]");
    }
    step.name = unique_name(name, position.prefix, given ? given->mark : Mark{});
    names_.insert({base, step.name});
}

void Planner::read_only(const Value& only, const Scope& scope, PartFilter& filter) {
    const Value names = resolved(only, scope, problems_);
    OptionType<std::vector<std::string>>::parse(names, filter.patterns, problems_);
    if (names.is_list() && names.items.empty())
        problems_.add(only.mark, "E-MISSING", "'only' lists no part or material",
                      "only: wheel, only: [\"tree*\", \"!tree_9\"], or leave it out for all");
}

std::string Planner::unique_name(const std::string& base, const std::string& prefix,
                                 const Mark& explicit_at) {
    const std::string name = prefix + base;
    std::string unique = used_names_.add(name);
    if (unique != name && explicit_at.known())
        problems_.add(explicit_at, "E-NAME", fmt::format("two stages have the name '{}'", name),
                      "names are unique, so that --set and the report can use them");
    return unique;
}

void Planner::plan_stage(Step& step, const Value::Entry& entry, const Scope& scope, bool& has_scene) {
    step.info = stage_named(entry.key);
    if (!step.info->loads && !has_scene) {
        problems_.add(entry.key_mark, "E-ORDER",
                      fmt::format("'{}' needs a scene, but nothing has been loaded before it", entry.key),
                      "begin with load: FILE");
        has_scene = true; // reported once
    }
    has_scene = has_scene || step.info->loads;
    step.given = with_safe_paths(entry.value, resolved(entry.value, scope, problems_), *step.info, scope);
    if (!step.given.mark.known()) step.given.mark = entry.key_mark;
    std::vector<std::string> names = {entry.key, step.name};
    const auto slash = step.name.rfind('/');
    if (slash != std::string::npos) names.push_back(step.name.substr(slash + 1));
    overrides_.apply(names, *step.info, step.given, problems_);
    step.stage = step.info->made();
    const bool good = step.info->options->parse(step.given, step.stage->target(), entry.key, problems_);
    if (good) {
        std::vector<std::string> outputs;
        for (const PathText& path : step.stage->files().outputs) outputs.push_back(path.text);
        warn_of_placeholders(entry.value, outputs, scope, problems_);
    }
    if (good && !is_deferred(step.given)) step.stage->verify(step.given, problems_);
}

} // namespace facetmill::pipeline
