#include "pipeline/rebase.hpp"

#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

fs::path way(const fs::path& from, const fs::path& to) {
    const auto whole = [](const fs::path& folder) { // the working directory for a file without a folder
        return fs::weakly_canonical(folder.empty() ? fs::current_path() : fs::absolute(folder));
    };
    return fs::proximate(whole(to), whole(from));
}

void rebase(Value& path, const fs::path& prefix, RunTimePaths run_time) {
    for (auto& item : path.items) rebase(item, prefix, run_time);
    if (!path.is_scalar() || path.text == "-" || path.text.empty() || fs::path(path.text).is_absolute())
        return;
    if (path.text.starts_with("${")) {
        if (run_time == RunTimePaths::kept) return;
        throw Error(ErrorKind::usage, "E-SAVE",
                    fmt::format("the files that '{}' reads are known only at run time", path.text),
                    "save the pipeline in the working directory", path.mark);
    }
    path.text = (prefix / path.text).lexically_normal().generic_string();
}

namespace {

/// True if an option of a stage names input files. It tests the stage with a probe path.
bool reads_path(const StageInfo& stage, const Option& option) {
    if (!stage.names_files) return false;
    const auto use = stage.made();
    Problems ignored;
    if (!option.parse(option, Value::scalar("probe"), use->target(), ignored)) return false;
    const StageFiles files = use->files();
    const auto has_probe = [](const std::vector<PathText>& paths) {
        return std::find(paths.begin(), paths.end(), PathText{"probe"}) != paths.end();
    };
    return has_probe(files.inputs) || has_probe(files.asset_roots);
}

class Rebase {
  public:
    Rebase(fs::path prefix, RunTimePaths run_time) : prefix_(std::move(prefix)), run_time_(run_time) {}

    void steps(Value& list) const {
        for (auto& step : list.items)
            for (auto& entry : step.entries) {
                if (entry.key == "include")
                    path(entry.value);
                else if (entry.key == "do")
                    steps(entry.value);
                else if (entry.key == "branch")
                    for (auto& arm : entry.value.entries) steps(arm.value);
                else if (const auto* known = stage_named(entry.key))
                    stage(*known, entry.value);
            }
    }

    /// A param is either a type, or a map with a type and a default.
    void param(Value& declaration) const {
        const Value* type = declaration.is_map() ? declaration.find("type") : nullptr;
        Value* value = declaration.is_map() ? declaration.find("default") : nullptr;
        const Value* of = type && type->text == "list" ? declaration.find("of") : type;
        if (of && value && of->text == "path") path(*value);
    }

  private:
    void path(Value& value) const { rebase(value, prefix_, run_time_); }

    void stage(const StageInfo& stage, Value& given) const {
        for (const auto& option : stage.options->options) {
            if (option.kind != OptionKind::path && option.kind != OptionKind::list) continue;
            Value* value = given.is_map()                       ? given.find(option.name)
                           : option.primary && !given.is_null() ? &given
                                                                : nullptr;
            if (value && reads_path(stage, option)) path(*value);
        }
    }

    fs::path prefix_;
    RunTimePaths run_time_;
};

} // namespace

void rebase_inputs(Value& document, const fs::path& from, const fs::path& to, RunTimePaths run_time) {
    const fs::path prefix = way(to, from);
    if (prefix == ".") return;
    const Rebase all(prefix, run_time);
    if (Value* params = document.find("params"))
        for (auto& entry : params->entries) all.param(entry.value);
    if (Value* steps = document.find("stages")) all.steps(*steps);
}

} // namespace facetmill::pipeline
