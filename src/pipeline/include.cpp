// Plans an item `include`: the stages of another file, with its own params.

#include "io/bytes.hpp"
#include "pipeline/built_in.hpp"
#include "pipeline/document.hpp"
#include "pipeline/params.hpp"
#include "pipeline/planner.hpp"
#include "pipeline/rebase.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

/// The values of `with`, resolved in the includer's scope.
Value given_values(const Value& item, const Scope& scope, Problems& problems) {
    const Value* with = item.find("with");
    if (!with || with->is_null()) return Value::map({}, item.mark);
    Value values = resolved(*with, scope, problems);
    if (values.is_map()) return values;
    problems.add(with->mark, "E-TYPE",
                 fmt::format("with is a map of params to their values, found {}", values.described()),
                 "- include: finish.yaml\n      with: {ratio: 10%}");
    return Value::map({}, item.mark);
}

/// Paths among the values are relative to the folder of the file that contains them.
void rebase_given(const Value& document, const Value& item, const fs::path& prefix, Value& given) {
    const Value* params = document.find("params");
    if (!params || prefix == ".") return;
    for (auto& entry : given.entries) {
        const Value* param = params->find(entry.key);
        const Value* type = param && param->is_map() ? param->find("type") : param;
        const Value* given = item.find("with")->find(entry.key);
        const Value* of = type && type->text == "list" ? param->find("of") : type;
        if (of && of->text == "path" && given && !given->text.starts_with("${"))
            rebase(entry.value, prefix, RunTimePaths::kept);
    }
}

} // namespace

std::shared_ptr<const SourceText> Planner::text_of(const fs::path& file, const Mark& where) {
    included_.push_back({file, where, false, {}, true});
    if (settings_.on_include) settings_.on_include(file);
    try {
        const auto input = io::Input::open(file);
        return std::make_shared<const SourceText>(
            SourceText{file.generic_string(), std::string(io::as_text(input.bytes()))});
    } catch (Error& e) {
        throw e.at(where);
    }
}

const Value* Planner::fragment(const fs::path& file, const Mark& where, std::string_view built_in) {
    if (const auto known = fragments_.find(file); known != fragments_.end()) return &known->second;
    auto source =
        built_in.empty()
            ? text_of(file, where)
            : std::make_shared<const SourceText>(SourceText{file.generic_string(), std::string(built_in)});
    Problems found;
    Value document = parse_yaml(std::move(source), found);
    for (const auto& d : found.all()) problems_.add(d.where, d.id, d.message, d.hint);
    if (found.any_errors()) return nullptr;
    if (!document.is_map()) {
        problems_.add(document.mark, "E-TYPE",
                      fmt::format("an included file is a map with facetmill and stages, found {}",
                                  document.described()),
                      "facetmill: 1\n    stages:\n      - relax: 3");
        return nullptr;
    }
    std::vector<std::string> keys{"facetmill", "requires", "about", "params", "stages"};
    if (!built_in.empty()) // the including pipeline has its own
        for (const char* key : {"report", "allow"}) keys.emplace_back(key);
    check_head(document, keys, problems_);
    if (!built_in.empty()) return &fragments_.emplace(file, std::move(document)).first->second;
    rebase_inputs(document, file.parent_path(), settings_.places.input_base, RunTimePaths::kept);
    return &fragments_.emplace(file, std::move(document)).first->second;
}

std::vector<fs::path> Planner::chain_to(const fs::path& file) const {
    if (const auto open = std::find(open_.begin(), open_.end(), file); open != open_.end())
        return {open, open_.end()};
    const auto is_pipeline = [&](const PlannedFile& other) { // other reads are includes or presets
        return !other.written && !other.shapes && other.path.lexically_normal() == file;
    };
    if (std::none_of(settings_.others.begin(), settings_.others.end(), is_pipeline)) return {};
    std::vector<fs::path> all{file};
    all.insert(all.end(), open_.begin(), open_.end());
    return all;
}

bool Planner::may_include(const fs::path& file, const Mark& where) {
    constexpr std::size_t longest_chain = 32;
    if (const auto files = chain_to(file); !files.empty()) {
        std::string chain;
        for (const auto& one : files) chain += fmt::format("{} -> ", one.generic_string());
        problems_.add(where, "E-INCLUDE", fmt::format("'{}' includes itself", file.generic_string()),
                      fmt::format("{}{}", chain, file.generic_string()));
        return false;
    }
    if (open_.size() < longest_chain) return true;
    problems_.add(where, "E-INCLUDE",
                  fmt::format("'{}' is included through more than {} other files", file.generic_string(),
                              longest_chain),
                  "reduce the number of files between the pipeline and this include");
    return false;
}

Steps Planner::include(const Value& item, const Value::Entry& entry, const Scope& scope,
                       const Position& position, bool& has_scene) {
    const Value path = resolved(entry.value, scope, problems_);
    PathText text;
    if (!OptionType<PathText>::parse(path, text, problems_) || is_deferred(path)) {
        has_scene = true; // the included file may load a scene, so do not report missing scenes
        return {};
    }
    fs::path file = settings_.places.input(text.text).lexically_normal();
    const std::string_view built_in = fs::is_regular_file(file) ? "" : built_in_pipeline(text.text);
    if (!built_in.empty()) file = text.text;
    if (!may_include(file, path.mark)) {
        has_scene = true; // its effect is unknown
        return {};
    }
    const Value* document = fragment(file, path.mark, built_in);
    if (!document) {
        has_scene = true;
        return {};
    }
    Value given = given_values(item, scope, problems_);
    if (!open_.empty() && built_in.empty())
        rebase_given(*document, item, way(settings_.places.input_base, open_.back().parent_path()), given);
    const Scope own = fragment_params(*document, given, settings_, problems_);
    const Value* stages = document->find("stages");
    if (!stages || stages->is_null()) {
        problems_.add(document->mark, "E-MISSING", "an included file needs stages", "stages: [{relax: 3}]");
        return {};
    }
    const std::string name = unique_name(file.stem().generic_string(), position.prefix, {});
    open_.push_back(file);
    Steps all = steps(*stages, own, {position.path + ".include", name + "/"}, has_scene);
    open_.pop_back();
    return all;
}

} // namespace facetmill::pipeline
