#include "pipeline/plan.hpp"

#include "base/math/numbers.hpp"
#include "base/message_ids.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "facetmill_version.hpp"
#include "io/bytes.hpp"
#include "pipeline/document.hpp"
#include "pipeline/params.hpp"
#include "pipeline/planner.hpp"
#include "pipeline/yaml_text.hpp"
#include "report/form.hpp"

#include <array>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

using Version = std::array<std::int64_t, 3>;

/// "1", "1.2" or "1.2.3"; a suffix after '-' (a prerelease) is ignored.
std::optional<Version> parse_version(std::string_view text) {
    Version version{0, 0, 0};
    text = text.substr(0, text.find('-'));
    for (std::size_t i = 0; i < version.size(); ++i) {
        const auto dot = text.find('.');
        const auto number = parse_integer(text.substr(0, dot));
        if (!number || *number < 0) return {};
        version[i] = *number;
        if (dot == std::string_view::npos) return version;
        text.remove_prefix(dot + 1);
    }
    return {};
}

std::optional<bool> satisfies_one(const Version& version, std::string_view comparator) {
    for (const std::string_view op : {">=", "<=", "==", ">", "<", "="}) {
        if (!comparator.starts_with(op)) continue;
        const auto limit = parse_version(trimmed(comparator.substr(op.size())));
        if (!limit) return {};
        if (op == ">=") return version >= *limit;
        if (op == "<=") return version <= *limit;
        if (op == ">") return version > *limit;
        return op == "<" ? version < *limit : version == *limit;
    }
    const auto exact = parse_version(comparator);
    return exact ? std::optional<bool>(version == *exact) : std::nullopt;
}

} // namespace

std::optional<bool> satisfies(const std::string& version, const std::string& range) {
    const auto own = parse_version(version);
    if (!own) return {};
    const auto comparators = split_at_commas(range);
    if (comparators.empty()) return {};
    bool all = true;
    for (const std::string_view one : comparators) {
        const auto holds = satisfies_one(*own, one);
        if (!holds) return {};
        all = all && *holds;
    }
    return all;
}

// --- plan

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> top_level_keys = {"facetmill", "requires", "about", "params",
                                                 "stages",    "report",   "allow"};

void check_keys(const Value& document, const std::vector<std::string>& keys, Problems& problems) {
    for (const auto& entry : document.entries) {
        if (entry.key.starts_with("x-") || std::find(keys.begin(), keys.end(), entry.key) != keys.end())
            continue;
        const bool of_pipelines =
            std::find(top_level_keys.begin(), top_level_keys.end(), entry.key) != top_level_keys.end();
        if (of_pipelines)
            problems.add(entry.key_mark, "E-KEY", fmt::format("an included file cannot have '{}'", entry.key),
                         "it belongs to the pipeline that includes it");
        else
            problems.add(entry.key_mark, "E-KEY", fmt::format("a pipeline has no key '{}'", entry.key),
                         suggestion(entry.key, keys) + "; names of your own keys begin with x-");
    }
}

void check_format(const Value& document, Problems& problems) {
    const Value* format = document.find("facetmill");
    if (!format)
        return problems.add(document.mark, "E-FORMAT-VERSION", "the pipeline does not state its format",
                            "begin with: facetmill: 1");
    if (format->as_integer() != 1)
        problems.add(
            format->mark, "E-FORMAT-VERSION",
            fmt::format("facetmill {} reads format 1, found {}", FACETMILL_VERSION, format->described()),
            format->as_integer() ? "a newer facetmill may read it" : "write: facetmill: 1");
}

void check_requires(const Value& document, Problems& problems) {
    const Value* range = document.find("requires");
    if (!range) return;
    const auto holds = range->is_scalar() ? satisfies(FACETMILL_VERSION, range->text) : std::nullopt;
    if (!holds)
        problems.add(range->mark, "E-REQUIRES",
                     fmt::format("expected a range of versions, found {}", range->described()),
                     "requires: \">=0.3,<2\"");
    else if (!*holds)
        problems.add(
            range->mark, "E-REQUIRES",
            fmt::format("the pipeline requires facetmill {}, this is {}", range->text, FACETMILL_VERSION));
}

/// The files of `report` and --report, with the rules of Folders::output; also adds them to files.
std::vector<std::string> read_reports(const Value* report, const Scope& scope, const PlanSettings& settings,
                                      std::vector<PlannedFile>& files, Problems& problems) {
    std::vector<std::string> reports;
    const auto add = [&](const std::string& path, const Mark& where) {
        try {
            report::form_of(path);
        } catch (Error& e) {
            problems.add(e.at(where));
            return; // the same problem would be reported again
        }
        const fs::path target = settings.places.output(path);
        for (const auto& known : reports) // given in the pipeline and on the command line: once is enough
            if (settings.places.output(known).lexically_normal() == target.lexically_normal()) return;
        reports.push_back(path);
        files.push_back({target, where, true});
    };
    if (report && !report->is_null()) {
        const Value paths = resolved(*report, scope, problems);
        const Value list = paths.is_list() ? paths : Value::list({paths}, paths.mark);
        for (const auto& item : list.items) {
            PathText path;
            if (OptionType<PathText>::parse(item, path, problems) && !item.deferred)
                add(path.text, item.mark);
        }
    }
    for (const auto& path : settings.extra_reports) add(path, command_line_mark("--report", path));
    return reports;
}

/// The warnings of `allow`, appended to --allow.
std::vector<std::string> read_allowed(const Value* allow, const PlanSettings& settings, Problems& problems) {
    std::vector<std::string> allowed = settings.allowed;
    if (!allow || allow->is_null()) return allowed;
    const Value list = allow->is_list() ? *allow : Value::list({*allow}, allow->mark);
    const auto known = warning_ids();
    for (const auto& item : list.items) {
        std::string id;
        if (!OptionType<std::string>::parse(item, id, problems)) continue;
        if (std::find(known.begin(), known.end(), id) == known.end())
            problems.add(item.mark, "E-CHOICE", fmt::format("there is no warning '{}'", id),
                         did_you_mean(id, known, "facetmill explain lists the warnings"));
        allowed.push_back(std::move(id));
    }
    return allowed;
}

/// Adds E-LIMITS for each step that judges written files before any `write`. written: a write came before the
/// steps. Returns true if a write came before their end.
bool check_judged_files(const Steps& steps, bool written, Problems& problems) {
    for (const Step& step : steps) {
        if (step.when && step.when->known && !*step.when->known) continue;
        if (step.kind != Step::Kind::stage) {
            bool any = written;
            for (const Arm& arm : step.arms) any |= check_judged_files(*arm.steps, written, problems);
            written = any;
            continue;
        }
        written |= step.info->writes_scene;
        const std::string option = step.stage->judges_written();
        if (option.empty() || written) continue;
        const auto dot = option.find('.');
        const Value* group = step.given.find(option.substr(0, dot));
        const Value* value = group ? group->find(option.substr(dot + 1)) : nullptr;
        problems.add(value ? value->mark : step.where, "E-LIMITS",
                     fmt::format("{}: '{}' limits written files, and no file is written before it",
                                 step.info->name, option),
                     fmt::format("put write: out.glb before {}", step.name));
    }
    return written;
}

} // namespace

void check_head(const Value& document, const std::vector<std::string>& keys, Problems& problems) {
    check_format(document, problems);
    check_requires(document, problems);
    check_keys(document, keys, problems);
}

Plan make_plan(const Value& document, const PlanSettings& settings, Problems& problems) {
    Plan plan;
    plan.name = settings.name;
    plan.command = settings.command;
    plan.places = settings.places;
    plan.others = settings.others;
    plan.allowed = settings.allowed;
    if (!document.is_map()) {
        plan.reports = read_reports(nullptr, {}, settings, plan.others, problems);
        const std::string mesh = hint_for_no_pipeline(settings.name);
        problems.add(
            document.mark, "E-TYPE",
            fmt::format("a pipeline is a map with facetmill and stages, found {}", document.described()),
            mesh.empty() ? "facetmill: 1\n    stages:\n      - load: scan.ply" : mesh);
        return plan;
    }
    check_head(document, top_level_keys, problems);
    if (const Value* about = document.find("about"))
        OptionType<std::string>::parse(*about, plan.about, problems);
    plan.allowed = read_allowed(document.find("allow"), settings, problems);
    const Scope scope = read_params(document.find("params"), settings, plan.params, problems);
    Planner planner(settings, problems);
    bool has_scene = false;
    if (const Value* stages = document.find("stages"))
        plan.steps = planner.steps(*stages, scope, {"stages", ""}, has_scene);
    if (const Value* stages = document.find("stages"); !stages || stages->is_null())
        problems.add(stages ? stages->mark : document.mark, "E-MISSING", "a pipeline needs stages",
                     "stages: [{load: scan.ply}]");
    planner.finish();
    if (!problems.any_errors()) check_judged_files(plan.steps, false, problems);
    plan.others.insert(plan.others.end(), planner.included().begin(), planner.included().end());
    plan.reports = read_reports(document.find("report"), scope, settings, plan.others, problems);
    auto files = planned_files(plan.steps, plan.places);
    files.insert(files.end(), plan.others.begin(), plan.others.end());
    plan.files_collide = !check_collisions(files, problems);
    for (const auto& d : problems.all())
        if (d.severity == Severity::warning) plan.warnings.push_back(d);
    return plan;
}

Plan plan_text(std::string text, const PlanSettings& settings, Problems& problems) {
    auto source = std::make_shared<const SourceText>(SourceText{settings.name, std::move(text)});
    const Value document = parse_yaml(source, problems);
    // After an error, only a complete tree is worth planning.
    if (problems.any_errors() && !document.is_map()) {
        Plan nothing;
        nothing.name = settings.name;
        nothing.places = settings.places;
        nothing.reports = read_reports(nullptr, {}, settings, nothing.others, problems);
        nothing.text = source->text;
        return nothing;
    }
    Plan plan = make_plan(document, settings, problems);
    plan.text = source->text;
    return plan;
}

PipelineSource read_pipeline(const fs::path& file) {
    const auto input = io::Input::open(file);
    return {std::string(io::as_text(input.bytes())), file};
}

Plan plan_source(const PipelineSource& source, PlanSettings settings, Problems& problems) {
    const fs::path& file = source.file;
    if (file.empty()) return plan_text(source.text, settings, problems);
    const bool streamed = file == "-";
    if (!streamed) settings.others.push_back({file, {}, false});
    if (settings.name.empty()) settings.name = streamed ? "standard input" : file.generic_string();
    if (settings.places.input_base.empty() && !streamed) settings.places.input_base = file.parent_path();
    Plan plan = plan_text(source.text, settings, problems);
    for (const auto& read : planned_files(plan.steps, plan.places))
        if (streamed && !read.written && read.path == "-") {
            plan.files_collide = true;
            problems.add(read.where, "E-DUPLICATE-INPUT",
                         "standard input holds the pipeline, so no mesh can come from it",
                         "give one of the two as a file");
        }
    return plan;
}

} // namespace facetmill::pipeline
