#include "base/ordered_set.hpp"
#include "base/text/glob.hpp"
#include "base/text/spelling.hpp"
#include "io/codec.hpp"
#include "io/other_formats.hpp"
#include "io/outputs/output_files.hpp"
#include "pipeline/placeholders.hpp"
#include "pipeline/plan.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

namespace {

/// The mark of the text in the options, or null.
const Mark* find_text(const Value& value, const std::string& text) {
    if (value.is_scalar()) return value.text == text ? &value.mark : nullptr;
    for (const auto& item : value.items)
        if (const Mark* mark = find_text(item, text)) return mark;
    for (const auto& entry : value.entries)
        if (const Mark* mark = find_text(entry.value, text)) return mark;
    return nullptr;
}

void add_files(const Step& step, const Folders& places, std::vector<PlannedFile>& files) {
    if (!step.stage) return;
    const StageFiles named = step.stage->files();
    const auto where = [&](const PathText& path) {
        const Mark* mark = find_text(step.given, path.text);
        return mark ? *mark : step.where;
    };
    for (const auto& input : named.inputs) {
        if (input.text.empty()) continue; // known only at run time
        const fs::path path = places.input(input.text);
        const auto matches = expand_glob(path);
        PlannedFile file{path, where(input), false};
        if (is_glob(path.generic_string())) file.pattern = path;
        if (matches.empty()) files.push_back(file);
        for (const auto& match : matches) {
            file.path = match;
            files.push_back(file);
        }
    }
    for (const auto& output : named.outputs)
        if (!output.text.empty()) files.push_back({places.output(output.text), where(output), true});
}

/// The most similar file name in the folder. For a mesh, only names of meshes; for an unsupported format, the
/// same name in a supported format.
std::string nearest_file(const fs::path& path) {
    const std::string suffix = path.extension().generic_string(), foreign = io::hint_for_reading(path);
    const bool mesh = io::codec_for(path) != nullptr || !foreign.empty();
    std::vector<std::string> names;
    std::error_code ignored;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        const fs::path name = entry.path().filename();
        if (mesh && name.extension() != suffix && !io::codec_for(name)) continue;
        if (!foreign.empty() && name.stem() != path.stem()) continue;
        names.push_back(name.generic_string());
        if (names.size() > 1000) break;
    }
    if (ignored) return fmt::format("there is no folder '{}' either", folder.generic_string());
    std::sort(names.begin(), names.end());
    return did_you_mean(path.filename().generic_string(), names, foreign);
}

OrderedSet<fs::path> paths_of(const Plan& plan, bool written, const std::vector<fs::path>& more) {
    OrderedSet<fs::path> paths;
    for (const auto& file : planned_files(plan.steps, plan.places))
        if (file.written == written) paths.add(file.path);
    for (const auto& path : more) paths.add(path);
    return paths;
}

} // namespace

namespace {

std::vector<PlannedFile> files_of_arms(const std::vector<Arm>& arms, const Folders& places) {
    std::vector<PlannedFile> files;
    for (const auto& arm : arms)
        for (auto& file : planned_files(*arm.steps, places)) {
            file.variables.insert(file.variables.begin(), arm.variables.begin(), arm.variables.end());
            files.push_back(std::move(file));
        }
    return files;
}

} // namespace

std::vector<PlannedFile> planned_files(const Steps& steps, const Folders& places) {
    std::vector<PlannedFile> files;
    for (const auto& step : steps) {
        if (step.when && step.when->known == false) continue;
        add_files(step, places, files);
        for (auto& file : files_of_arms(step.arms, places)) files.push_back(std::move(file));
    }
    return files;
}

std::vector<fs::path> asset_roots_of(const Steps& steps, const Folders& places) {
    OrderedSet<fs::path> folders;
    for (const auto& folder : places.asset_roots) folders.add(folder);
    for_each_step(steps, [&](const Step& step) {
        if (!step.stage) return;
        for (const auto& folder : step.stage->files().asset_roots)
            if (!folder.text.empty()) folders.add(places.input(folder.text));
    });
    return folders.all();
}

namespace {

/// Uses of the same file.
using SameFiles = std::vector<const PlannedFile*>;

bool is_at_one_place(const PlannedFile& a, const PlannedFile& b) {
    return to_string(a.where) == to_string(b.where);
}

/// The text at a mark, without quotes; empty if it is not a plain name.
std::string written_at(const Mark& mark) {
    if (!mark.known() || mark.line < 1 || mark.column < 1) return {};
    std::string_view text = mark.source->text;
    for (int line = 1; line < mark.line && text.find('\n') != text.npos; ++line)
        text.remove_prefix(text.find('\n') + 1);
    text = text.substr(0, text.find('\n'));
    const auto begin = static_cast<std::size_t>(mark.column - 1);
    if (begin >= text.size() || mark.length < 3) return {};
    text = text.substr(begin, static_cast<std::size_t>(mark.length));
    const char quote = text.front();
    if ((quote == '"' || quote == '\'') && text.back() == quote) text = text.substr(1, text.size() - 2);
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) { // columns count characters
        return c > ' ' && c <= '~' && c != '\\' && c != '"' && c != '\'' && c != ',';
    });
    return plain ? std::string(text) : "";
}

/// A hint for a second use of the same file. The first use is elsewhere in the pipeline, or in the same place
/// for other values of a foreach. In the latter case the name must include the variables that differ between
/// all uses in this place.
std::string hint_of_duplicate(const SameFiles& same, const PlannedFile& file) {
    const PlannedFile& first = *same.front();
    if (!is_at_one_place(first, file) || file.variables.empty())
        return fmt::format("the first is at {}", to_string(first.where));
    std::string all, differing;
    for (std::size_t i = 0; i < std::min(first.variables.size(), file.variables.size()); ++i) {
        const auto& [name, value] = file.variables[i];
        const std::string part = name == "part" ? "${part}" : fmt::format("${{{}.index}}", name);
        all += "." + part;
        const bool differs = std::any_of(same.begin(), same.end(), [&](const PlannedFile* other) {
            return is_at_one_place(first, *other) && i < other->variables.size() &&
                   other->variables[i].second.text != first.variables[i].second.text;
        });
        if (differs) differing += "." + part;
    }
    const std::string written = written_at(file.where), suffix = file.path.extension().generic_string();
    const std::string name = written.ends_with(suffix) ? written : file.path.filename().generic_string();
    return fmt::format("foreach writes it for every value: {}{}{}",
                       name.substr(0, name.size() - suffix.size()), differing.empty() ? all : differing,
                       suffix);
}

bool check_inputs(const std::vector<PlannedFile>& files, std::map<std::string, const PlannedFile*>& inputs,
                  Problems& problems) {
    bool good = true;
    for (const auto& file : files) {
        if (file.written) continue;
        const auto [first, is_new] = inputs.emplace(io::identity(file.path).generic_string(), &file);
        if (is_new || file.path != "-") continue;
        good = false;
        problems.add(file.where, "E-DUPLICATE-INPUT", "standard input can be read only once",
                     fmt::format("the first is at {}", to_string(first->second->where)));
    }
    return good;
}

} // namespace

bool check_collisions(const std::vector<PlannedFile>& files, Problems& problems) {
    std::map<std::string, const PlannedFile*> inputs;
    std::map<std::string, SameFiles> outputs;
    for (const auto& file : files)
        if (file.written) outputs[lower_case(io::identity(file.path).generic_string())].push_back(&file);
    bool good = check_inputs(files, inputs, problems);
    std::set<std::string> told; // positions
    for (const auto& file : files) {
        if (!file.written) continue;
        const std::string path = io::identity(file.path).generic_string();
        if (const auto input = inputs.find(path); input != inputs.end() && path != "-") {
            good = false;
            problems.add(file.where, "E-OVERWRITE",
                         fmt::format("'{}' would overwrite an input", file.path.generic_string()),
                         input->second->where.known()
                             ? fmt::format("it is read at {}; give the output another name",
                                           to_string(input->second->where))
                             : "it is the pipeline itself; give the output another name");
        }
        const SameFiles& same = outputs.at(lower_case(path));
        const PlannedFile& first = *same.front();
        if (&first == &file) continue;
        good = false;
        // All values of a foreach have the same problem: only one name must change.
        if (is_at_one_place(first, file) && !told.insert(to_string(file.where)).second) continue;
        const bool spelled_alike = io::identity(first.path).generic_string() == path;
        problems.add(file.where, "E-DUPLICATE-OUTPUT",
                     spelled_alike ? fmt::format("'{}' is written twice", file.path.generic_string())
                                   : fmt::format("'{}' and '{}' are the same file if case is ignored",
                                                 first.path.generic_string(), file.path.generic_string()),
                     hint_of_duplicate(same, file));
    }
    return good;
}

void check_new_files(const Plan& plan, const Step& step, const std::vector<Arm>& arms, Problems& problems) {
    auto files = planned_files(plan.steps, plan.places);
    files.insert(files.end(), plan.others.begin(), plan.others.end());
    // The plan has an arm for parts of unknown names, which the new arms replace.
    for (const auto& planned : files_of_arms(step.arms, plan.places)) {
        const auto same = [&](const PlannedFile& file) {
            return file.written && file.path == planned.path && is_at_one_place(file, planned);
        };
        if (const auto old = std::find_if(files.begin(), files.end(), same); old != files.end())
            files.erase(old);
    }
    for (auto& file : files_of_arms(arms, plan.places)) {
        const bool is_known = std::any_of(files.begin(), files.end(),
                                          [&](const auto& f) { return !f.written && f.path == file.path; });
        if (file.written || !is_known) files.push_back(std::move(file));
    }
    check_collisions(files, problems);
}

namespace {

/// Input files that do not exist.
std::vector<PlannedFile> missing_files(const Plan& plan) {
    auto files = planned_files(plan.steps, plan.places);
    std::erase_if(files, [](const PlannedFile& file) {
        std::error_code error;
        return file.written || file.path == "-" || fs::exists(file.path, error);
    });
    return files;
}

std::string hint_of_missing(const fs::path& path) {
    if (const auto found = placeholder_in(path.filename().generic_string(), {}))
        return fmt::format("for the value of a param or variable write {}", found->expression);
    return nearest_file(path);
}

Diagnostic about_missing(const PlannedFile& file) {
    if (!file.pattern.empty())
        return {Severity::error,
                "E-FILE",
                fmt::format("no file matches '{}'", file.pattern.generic_string()),
                file.where,
                {}};
    return {Severity::error, "E-FILE", fmt::format("there is no file '{}'", file.path.generic_string()),
            file.where, hint_of_missing(file.path)};
}

} // namespace

std::vector<Diagnostic> missing_inputs(const Plan& plan) {
    std::vector<Diagnostic> missing;
    for (const auto& file : missing_files(plan)) missing.push_back(about_missing(file));
    return missing;
}

std::vector<Error> input_errors(const Plan& plan, const Headers& headers) {
    std::vector<Error> errors;
    for (const auto& file : missing_files(plan))
        if (!file.pattern.empty())
            errors.emplace_back(ErrorKind::missing, std::vector<Diagnostic>{about_missing(file)});
    errors.insert(errors.end(), headers.errors.begin(), headers.errors.end());
    return errors;
}

namespace {

/// True if a step has an effect besides the scene.
bool has_effect(const Steps& steps) {
    return std::any_of(steps.begin(), steps.end(), [](const Step& step) {
        if (step.ensure) return true;
        if (step.info) return step.info->checks || step.info->tells;
        return std::any_of(step.arms.begin(), step.arms.end(),
                           [](const Arm& arm) { return has_effect(*arm.steps); });
    });
}

} // namespace

std::optional<Diagnostic> without_effect(const Plan& plan) {
    if (plan.steps.empty() || !plan.reports.empty() || has_effect(plan.steps)) return {};
    Diagnostic warning{Severity::warning, "W-NOTHING",
                       "the pipeline writes nothing and checks nothing, so its result would be lost",
                       plan.steps.back().where,
                       "end it with write: FILE, or with validate, or ask for a --report"};
    if (is_allowed(warning, plan.allowed)) return {};
    return warning;
}

Diagnostic about_input(const std::vector<fs::path>& inputs, Diagnostic diagnostic) {
    const std::string place = diagnostic.where.known() ? diagnostic.where.source->name : "";
    const auto is_named = [&](const fs::path& input) {
        return diagnostic.message.find(input.generic_string()) != std::string::npos ||
               place == input.generic_string();
    };
    if (inputs.empty() || std::any_of(inputs.begin(), inputs.end(), is_named)) return diagnostic;
    const std::string first = inputs.front() == "-" ? "standard input" : inputs.front().generic_string();
    const std::string more = inputs.size() > 1 ? fmt::format(" and {} more", inputs.size() - 1) : "";
    diagnostic.message = fmt::format("{}{}: {}", first, more, diagnostic.message);
    return diagnostic;
}

std::vector<fs::path> inputs_of_steps(const Plan& plan) { return paths_of(plan, false, {}).all(); }

std::vector<fs::path> planned_inputs(const Plan& plan, const Headers& headers) {
    auto paths = paths_of(plan, false, headers.more_inputs);
    for (const auto& file : plan.others)
        if (file.shapes) paths.add(file.path);
    return paths.all();
}

std::vector<fs::path> planned_patterns(const Plan& plan) {
    OrderedSet<fs::path> patterns;
    for (const auto& file : planned_files(plan.steps, plan.places))
        if (!file.pattern.empty()) patterns.add(file.pattern);
    return patterns.all();
}

std::vector<fs::path> planned_outputs(const Plan& plan, const Headers& headers) {
    auto paths = paths_of(plan, true, headers.more_outputs);
    for (const auto& report : plan.reports) paths.add(plan.places.output(report));
    return paths.all();
}

} // namespace facetmill::pipeline
