#include "cli/workflow.hpp"

#include "base/json.hpp"
#include "cli/depfile.hpp"
#include "docs/versions.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

std::string heading() {
    return fmt::format("# Written by facetmill {} export: a job for each asset. Export again when assets "
                       "come or go, or when\n"
                       "# the pipeline reads or writes other files.\n",
                       docs::release());
}

/// For sh: as it is when nothing in it has a meaning, else in single quotes.
std::string for_shell(const std::string& text) {
    static constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._/=:,%+@";
    if (!text.empty() && text.find_first_not_of(plain) == text.npos) return text;
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string command_line(const Job& job) {
    std::string text;
    for (const auto& argument : job.arguments) text += " " + for_shell(argument);
    return text;
}

/// A line of Make or Ninja, whose variables begin with a dollar sign.
std::string with_dollars_doubled(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\n' || c == '\r')
            throw Error(ErrorKind::output, "E-DEPFILE",
                        "a workflow cannot name a path with a line break: " + text);
        out += c;
        if (c == '$') out += c;
    }
    return out;
}

std::string ninja_path(const std::string& path) {
    std::string out;
    for (const char c : with_dollars_doubled(path)) {
        if (c == ' ' || c == ':') out += '$';
        out += c;
    }
    return out;
}

void check_outputs(const std::vector<Job>& jobs) {
    for (const auto& job : jobs)
        if (job.outputs.empty())
            throw Error(ErrorKind::usage, "E-EXPORT",
                        fmt::format("the run of {} writes no file that is known before it, so no engine can "
                                    "tell whether it is due",
                                    job.name),
                        "give the pipeline a report: \"${input.stem}.json\", or use facetmill batch");
}

/// Names with these cannot be spelled.
void check_names(const std::vector<Job>& jobs, const char* engine, std::string_view odd, const char* hint) {
    for (const auto& job : jobs)
        for (const auto* paths : {&job.inputs, &job.outputs})
            for (const auto& path : *paths)
                if (const auto at = path.find_first_of(odd); at != path.npos)
                    throw Error(
                        ErrorKind::usage, "E-EXPORT",
                        fmt::format("{} cannot work with the {} in '{}'", engine,
                                    path[at] == '\t' ? std::string("tab") : fmt::format("'{}'", path[at]),
                                    path),
                        hint);
}

std::string joined(const std::vector<std::string>& paths, std::string (*spelled)(const std::string&)) {
    std::string text;
    for (const auto& path : paths) text += " " + spelled(path);
    return text;
}

std::string make_target(const std::string& path) { return make_spelling(path, true); }
std::string make_input(const std::string& path) { return make_spelling(path, false); }

/// JSON has names in UTF-8 only.
std::string as_json(const Json& all) {
    try {
        return all.dump(1);
    } catch (const Json::exception&) {
        throw Error(ErrorKind::usage, "E-EXPORT",
                    "a name of a file is no UTF-8, which a Snakefile cannot hold",
                    "use --to ninja or make, or rename the file");
    }
}

} // namespace

std::string ninja_workflow(const std::vector<Job>& jobs) {
    check_outputs(jobs);
    check_names(jobs, "Ninja", "|\t", "rename the file");
    std::string text = heading() + "facetmill = facetmill\n\nrule mill\n  command = $facetmill $arguments\n  "
                                   "description = MILL $asset\n";
    for (const auto& job : jobs)
        text += fmt::format("\nbuild{}: mill{}\n  asset = {}\n  arguments ={}\n",
                            joined(job.outputs, ninja_path), joined(job.inputs, ninja_path),
                            with_dollars_doubled(job.name), with_dollars_doubled(command_line(job)));
    return text;
}

std::string make_workflow(const std::vector<Job>& jobs) {
    check_outputs(jobs);
    check_names(jobs, "Make", "|;=*?[]~\t", "use --to ninja, or rename the file");
    std::string rules, all;
    for (const auto& job : jobs) {
        const std::string outputs = joined(job.outputs, make_target);
        all += " \\\n " + joined(job.outputs, make_input);
        // "&:" is one rule for all of them: GNU make 4.3. What a run that failed has written (its report)
        // stays, and is out of date.
        std::string old;
        for (const auto& output : job.outputs) old += " " + for_shell(output);
        rules += fmt::format("\n{} &:{}\n\t$(FACETMILL){} || {{ s=$$?; touch -c -d @86400{}; exit $$s; }}\n",
                             outputs.substr(1), joined(job.inputs, make_input),
                             with_dollars_doubled(command_line(job)), with_dollars_doubled(old));
    }
    return heading() + "FACETMILL ?= facetmill\n\n.PHONY: all\nall:" + all + "\n" + rules;
}

std::string snakemake_workflow(const std::vector<Job>& jobs, int threads) {
    check_outputs(jobs);
    // It takes braces for a wildcard, and has no way to say that they are none.
    check_names(jobs, "Snakemake", "{}", "rename the file");
    Json all = Json::array();
    constexpr std::uint64_t megabyte = 1000000;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const Job& job = jobs[i];
        all.push_back({{"name", fmt::format("asset_{}", i + 1)},
                       {"asset", job.name},
                       {"arguments", command_line(job)},
                       {"inputs", job.inputs},
                       {"outputs", job.outputs},
                       {"megabytes", (job.memory + megabyte - 1) / megabyte}});
    }
    return heading() + fmt::format(R"(FACETMILL = config.get("facetmill", "facetmill")
JOBS = {}


rule all:
    input: [path for job in JOBS for path in job["outputs"]]


for job in JOBS:
    rule:
        name: job["name"]
        input: job["inputs"]
        output: job["outputs"]
        message: "Milling " + job["asset"].replace("{{", "{{{{").replace("}}", "}}}}")
        params: command=FACETMILL + job["arguments"]
        threads: {}
        resources: mem_mb=job["megabytes"]
        shell: "{{params.command}}"
)",
                                   as_json(all), threads);
}

} // namespace facetmill::cli
