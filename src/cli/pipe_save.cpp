#include "cli/pipe_syntax.hpp"

#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace fs = std::filesystem;

namespace {

/// Whether an option of a stage names files that it reads: the stage itself is asked, with a probe for a
/// path.
bool reads_path(const StageInfo& stage, const Option& option) {
    if (!stage.files) return false;
    const auto options = stage.make_options();
    Problems ignored;
    if (!option.parse(option, Value::scalar("probe"), options.get(), ignored)) return false;
    const auto inputs = stage.files(options.get()).inputs;
    return std::find(inputs.begin(), inputs.end(), PathText{"probe"}) != inputs.end();
}

void rebase(Value& path, const fs::path& prefix) {
    for (auto& item : path.items) rebase(item, prefix);
    if (!path.is_scalar() || path.text == "-" || path.text.empty() || fs::path(path.text).is_absolute())
        return;
    if (path.text.starts_with("${"))
        throw Error(ErrorKind::usage, "E-SAVE",
                    fmt::format("what '{}' reads is known only at run time", path.text),
                    "save the pipeline in the working directory", path.mark);
    path.text = (prefix / path.text).lexically_normal().generic_string();
}

void rebase_stage(const StageInfo& stage, Value& given, const fs::path& prefix) {
    for (const auto& option : stage.options.options) {
        if (option.type != "path" && option.type != "list") continue;
        Value* path = given.is_map()                       ? given.find(option.name)
                      : option.primary && !given.is_null() ? &given
                                                           : nullptr;
        if (path && reads_path(stage, option)) rebase(*path, prefix);
    }
}

void rebase_steps(Value& steps, const fs::path& prefix) {
    for (auto& step : steps.items)
        for (auto& entry : step.entries) {
            if (entry.key == "do")
                rebase_steps(entry.value, prefix);
            else if (entry.key == "branch")
                for (auto& arm : entry.value.entries) rebase_steps(arm.value, prefix);
            else if (const auto* stage = stage_named(entry.key))
                rebase_stage(*stage, entry.value, prefix);
        }
}

} // namespace

void rebase_inputs(Value& document, const fs::path& from, const fs::path& to) {
    const auto prefix = fs::proximate(fs::weakly_canonical(from), fs::weakly_canonical(to));
    if (prefix == ".") return;
    if (Value* steps = document.find("stages")) rebase_steps(*steps, prefix);
}

} // namespace facetmill::cli
