#include "cli/confine.hpp"

#include "base/text/glob.hpp"
#include "cli/arguments.hpp"
#include "io/images/ktx_workers.hpp"
#include "io/import/import.hpp"
#include "io/outputs/early_folders.hpp"
#include "io/outputs/output_files.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace fs = std::filesystem;

void add_sandbox_option(Arguments& arguments, SandboxOptions& options) {
    arguments.add("--no-sandbox", &options.off,
                  "Turns the sandbox off. By default, facetmill can only access the files in the plan\nand "
                  "the system calls "
                  "that it needs.");
}

void add_asset_root_option(Arguments& arguments, std::vector<std::string>& folders) {
    arguments.add("--asset-root", &folders,
                  "A folder. Mesh files may use images, buffers and materials anywhere below "
                  "it\n(../textures/wood.png), not only in their own folder. May be repeated.");
}

io::ReadSettings read_settings(const std::vector<std::string>& asset_roots) {
    io::ReadSettings settings;
    settings.asset_roots.assign(asset_roots.begin(), asset_roots.end());
    return settings;
}

void allow_input(AllowedFiles& allowed, const fs::path& input) {
    if (input == "-") return;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(input, ignored))) allowed.read.push_back(input); // anywhere
    fs::path folder = input.parent_path();
    // The path before the wildcards.
    while (is_glob(folder.generic_string())) folder = folder.parent_path();
    allowed.read.push_back(folder.empty() ? "." : folder);
}

void allow_output(AllowedFiles& allowed, const fs::path& output) {
    if (output == "-") return;
    if (io::is_stream(output)) return allowed.written.push_back(output);
    const fs::path folder = output.parent_path();
    allowed.written.push_back(folder.empty() ? "." : folder);
    // Writing follows a link, so its target's folder is written.
    std::error_code ignored;
    if (!fs::is_symlink(fs::symlink_status(output, ignored))) return;
    const fs::path target = io::followed(output).parent_path();
    allowed.written.push_back(target.empty() ? "." : target);
}

namespace {

/// Allows files known only at run time: a text with an expression without a value yet.
void allow_deferred(AllowedFiles& allowed, const Value& value, const Folders& places) {
    for (const auto& item : value.items) allow_deferred(allowed, item, places);
    for (const auto& entry : value.entries) allow_deferred(allowed, entry.value, places);
    if (!value.is_scalar() || !value.deferred) return;
    const std::string known = value.text.substr(0, value.text.find("${")) + "x";
    allow_input(allowed, places.input(known));
    allow_output(allowed, places.output(known));
}

void allow_steps(AllowedFiles& allowed, const pipeline::Steps& steps, const Folders& places) {
    pipeline::for_each_step(steps, [&](const pipeline::Step& step) {
        if (!step.info || !step.info->names_files) return;
        allow_deferred(allowed, step.given, places);
        if (const auto evidence = step.stage->files().evidence)
            allow_output(allowed, places.output(evidence->text));
    });
}

std::string told(const Protections& on) {
    const std::string files = on.files > 0 ? fmt::format("files (Landlock, version {})", on.files) : "";
    const std::string calls = on.calls ? "system calls (seccomp)" : "";
    if (on.mitigations)
        return "the sandbox forbids new code and new processes (Windows mitigation policies), and leaves "
               "files "
               "accessible";
    return on.any() ? fmt::format("the sandbox limits {}{}{}", files, on.files > 0 && on.calls ? " and " : "",
                                  calls)
                    : "there is no sandbox: this kernel or this build does not support it";
}

} // namespace

void allow_plan(AllowedFiles& allowed, const pipeline::Plan& plan) {
    for (const auto& file : pipeline::planned_files(plan.steps, plan.places)) {
        if (file.written) {
            allow_output(allowed, file.path);
            continue;
        }
        allow_input(allowed, file.path);
        if (!file.pattern.empty()) allow_input(allowed, file.pattern);
    }
    for (const auto& file : plan.others) {
        if (file.written)
            allow_output(allowed, file.path);
        else
            allowed.read.push_back(file.path);
    }
    for (const auto& folder : pipeline::asset_roots_of(plan.steps, plan.places))
        allowed.read.push_back(folder);
    for (const auto& report : plan.reports) allow_output(allowed, plan.places.output(report));
    allow_steps(allowed, plan.steps, plan.places);
}

namespace {

bool names_ktx2(const Value& value) {
    const auto entry_names = [](const Value::Entry& entry) { return names_ktx2(entry.value); };
    return (value.is_scalar() && value.text == "ktx2") ||
           std::any_of(value.items.begin(), value.items.end(),
                       [](const Value& v) { return names_ktx2(v); }) ||
           std::any_of(value.entries.begin(), value.entries.end(), entry_names);
}

bool names_ktx2(const pipeline::Steps& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const pipeline::Step& step) {
        return names_ktx2(step.given) ||
               std::any_of(step.arms.begin(), step.arms.end(),
                           [](const pipeline::Arm& arm) { return names_ktx2(*arm.steps); });
    });
}

} // namespace

void start_programs(const pipeline::Plan& plan) {
    if (names_ktx2(plan.steps)) io::start_ktx_workers();
}

void confine(AllowedFiles allowed, const SandboxOptions& options, const Console& console) {
    io::start_import_workers();
    if (!allowed.read_all) io::limit_import_workers(allowed.read);
    if (options.off) return;
    if (offered_protections().files > 0) {
        static io::EarlyFolders folders; // removed at the end, unless files were written to them
        std::error_code ignored;
        for (const auto& path : allowed.written)
            if (!fs::exists(path, ignored) || fs::is_directory(path, ignored)) folders.make(path);
        allowed.folders_made = folders.made_in();
        confine_files(allowed);
    }
    confine_calls();
    if (console.verbose) console.say(told(active_protections()));
}

void confine_calls_only(const SandboxOptions& options) {
    io::start_ktx_workers(); // a later plan may need them
    io::start_import_workers();
    if (!options.off) confine_calls();
}

} // namespace facetmill::cli
