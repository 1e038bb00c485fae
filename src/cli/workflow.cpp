#include "cli/workflow.hpp"

#include "base/hash.hpp"
#include "base/json.hpp"
#include "base/ordered_set.hpp"
#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "cli/depfile.hpp"
#include "docs/versions.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

std::string heading() {
    return fmt::format("# Written by facetmill {} export. Export again after adding or removing assets,\n"
                       "# or when the pipeline reads or writes other files.\n",
                       docs::release());
}

/// " run scan.yaml -D ...", for each run.
std::vector<std::string> command_lines(const Job& job) {
    std::vector<std::string> all;
    for (const auto& arguments : job.runs) {
        std::string& text = all.emplace_back();
        for (const auto& argument : arguments) text += " " + for_shell(argument);
    }
    return all;
}

/// How an engine quotes a text for the shell.
using Spelling = std::string (*)(const std::string&);

/// The job's runs as a single shell command for an engine.
using CommandOf = std::string (*)(const Job&, const std::string& program, Spelling);

/// Chains the runs so that all of them run, whichever fails. The shell variable s holds the status of the
/// last failure, and `at_end` exits with it.
std::string chain(const Job& job, const std::string& program, Spelling spell, const std::string& at_end) {
    std::string text = "s=0;";
    for (const auto& run : command_lines(job))
        text += fmt::format(" {}{} || s={};", program, spell(run), spell("$?"));
    return text + " " + spell(at_end);
}

std::string plain_command(const Job& job, const std::string& program, Spelling spell) {
    return job.runs.size() == 1 ? program + spell(command_lines(job).front())
                                : chain(job, program, spell, "exit $s");
}

/// The outputs of a failed run (its report) stay, but must count as out of date.
std::string make_command(const Job& job, const std::string& program, Spelling spell) {
    std::string outputs;
    for (const auto& output : job.outputs) outputs += " " + for_shell(output);
    return chain(job, program, spell,
                 fmt::format("[ $s = 0 ] || {{ touch -c -d @86400{}; exit $s; }}", outputs));
}

std::string snakemake_command(const Job& job, const std::string& program, Spelling spell) {
    return chain(job, program, spell, "exit $s");
}

/// A line for Make or Ninja, where a dollar sign begins a variable.
std::string with_dollars_doubled(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\n' || c == '\r')
            throw Error(ErrorKind::output, "E-DEPFILE",
                        "a workflow cannot use a path with a line break: " + text);
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
                        fmt::format("the run of {} has no output with a known name, so a workflow cannot "
                                    "check whether it is up to date",
                                    job.name),
                        "add this to the pipeline: report: \"${input.stem}.json\", or use facetmill batch");
}

/// Linux limits an argument to 131072 bytes, and the shell gets its command as a single argument. Reserves
/// space for the engine's additions, and in each run for the program's path.
void check_lengths(const std::vector<Job>& jobs, CommandOf command, std::size_t of_program) {
    constexpr std::size_t most = 131'072 - 512;
    const auto as_it_is = [](const std::string& text) { return text; };
    for (const auto& job : jobs) {
        const std::size_t length = command(job, std::string(of_program, 'p'), as_it_is).size();
        if (length <= most) continue;
        const std::size_t fit = job.runs.size() * most / length;
        throw Error(ErrorKind::usage, "E-EXPORT",
                    fmt::format("the command of {} has {} bytes, but a shell accepts at most {}", job.name,
                                length, most),
                    job.runs.size() > 1
                        ? fmt::format("--shard {}", std::max<std::size_t>(1, fit))
                        : "put long params into a --preset, or write fewer files or shorter names");
    }
}

void check_jobs(const std::vector<Job>& jobs, CommandOf command, std::size_t of_program = 40) {
    check_outputs(jobs);
    check_lengths(jobs, command, of_program);
}

/// Refuses names with characters that the engine cannot represent: reports all such inputs, or else all such
/// outputs.
void check_names(const std::vector<Job>& jobs, const char* engine, std::string_view odd, const char* hint) {
    for (const auto paths : {&Job::inputs, &Job::absent, &Job::outputs}) {
        Problems problems;
        OrderedSet<std::string> refused;
        for (const auto& job : jobs)
            for (const auto& path : job.*paths)
                if (path.find_first_of(odd) != path.npos) refused.add(path);
        for (const auto& path : refused.all()) {
            const char c = path[path.find_first_of(odd)];
            problems.add({}, "E-EXPORT",
                         fmt::format("{} does not support the {} in '{}'", engine,
                                     c == '\t' ? std::string("tab") : fmt::format("'{}'", c), path),
                         hint);
        }
        problems.throw_if_any(ErrorKind::usage);
    }
}

std::string joined(const std::vector<std::string>& paths, std::string (*quote)(const std::string&)) {
    std::string text;
    for (const auto& path : paths) text += " " + quote(path);
    return text;
}

std::uint64_t megabytes_of(const Job& job) {
    constexpr std::uint64_t megabyte = 1000000;
    return (job.memory + megabyte - 1) / megabyte;
}

/// The depfile of a target. Its name stays the same when other jobs come or go.
std::string depfile_of(const std::string& target) {
    constexpr std::size_t digits = 16;
    return fmt::format("{}/{}.d", depfile_folder, sha256(std::as_bytes(std::span(target))).substr(0, digits));
}

/// Lets the runs of a job write depfiles.
Job with_depfiles(Job job) {
    for (std::size_t i = 0; i < job.targets.size(); ++i)
        job.runs[i].insert(job.runs[i].end(),
                           {"--depfile", depfile_of(job.targets[i]), "--depfile-target", job.targets[i]});
    return job;
}

/// Whether Ninja reads the names of this job in a depfile, and has one depfile for it. It splits a name at
/// other characters.
bool fits_ninja_depfile(const Job& job) {
    constexpr std::string_view known = "+,/_:.~()}{%=@[]!-# ";
    const auto fits = [&](const std::string& path) {
        return std::all_of(path.begin(), path.end(), [&](char c) {
            const auto byte = static_cast<unsigned char>(c);
            return byte >= 0x80 || std::isalnum(byte) || known.find(c) != known.npos;
        });
    };
    return job.targets.size() == 1 && fits(job.targets.front()) &&
           std::all_of(job.inputs.begin(), job.inputs.end(), fits);
}

std::vector<Job> transformed(const std::vector<Job>& jobs, Job (*change)(Job)) {
    std::vector<Job> changed;
    changed.reserve(jobs.size());
    for (const Job& job : jobs) changed.push_back(change(job));
    return changed;
}

std::string make_target(const std::string& path) { return make_escaped(path, true); }
std::string make_input(const std::string& path) { return make_escaped(path, false); }
/// Empty for names that functions of Make split or end at.
std::string make_absent(const std::string& path) {
    if (path.find_first_of(" ()") != path.npos) return {};
    return "$(wildcard " + make_input(path) + ")";
}

/// Names in JSON must be UTF-8.
std::string as_json(const Json& all) {
    try {
        return all.dump(1);
    } catch (const Json::exception&) {
        throw Error(ErrorKind::usage, "E-EXPORT", "a file name is not UTF-8, but a Snakefile needs UTF-8",
                    "use --to ninja or make, or rename the file");
    }
}

} // namespace

std::vector<Job> in_shards(std::vector<Job> jobs, std::size_t size) {
    check_outputs(jobs); // checks the outputs of each run
    std::vector<Job> shards;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (size <= 1 || i % size == 0) {
            shards.push_back(std::move(jobs[i]));
            continue;
        }
        Job &shard = shards.back(), &job = jobs[i];
        shard.runs.push_back(std::move(job.runs.front()));
        for (const auto paths : {&Job::inputs, &Job::absent}) {
            OrderedSet<std::string> both;
            for (const Job* from : {&shard, &job})
                for (const auto& path : from->*paths) both.add(path);
            shard.*paths = both.all();
        }
        shard.outputs.insert(shard.outputs.end(), job.outputs.begin(), job.outputs.end());
        shard.targets.insert(shard.targets.end(), job.targets.begin(), job.targets.end());
        shard.memory = std::max(shard.memory, job.memory);
    }
    for (auto& shard : shards)
        if (shard.runs.size() > 1) shard.name += fmt::format(" and {} more", shard.runs.size() - 1);
    return shards;
}

Lanes lanes_of(const std::vector<Job>& jobs, const Resources& resources) {
    const auto slots =
        static_cast<std::size_t>(std::max(1, resources.cores / std::max(1, resources.threads)));
    std::uint64_t largest = 1, largest_small = 0;
    for (const Job& job : jobs) largest = std::max(largest, job.memory);
    if (largest <= resources.memory / slots) return {slots, 0, largest};
    // Half of the memory for each kind of job.
    Lanes lanes{slots, 1, resources.memory / 2 / slots};
    for (const Job& job : jobs)
        if (job.memory <= lanes.small_up_to) largest_small = std::max(largest_small, job.memory);
    lanes.large =
        std::clamp<std::size_t>(resources.memory / 2 / largest, 1, std::max<std::size_t>(2, slots) - 1);
    lanes.small = std::max<std::size_t>(1, slots - lanes.large);
    if (largest_small == 0) // no small jobs
        lanes.large = std::clamp<std::size_t>(resources.memory / largest, 1, slots);
    return lanes;
}

namespace {

std::string in_words(const Resources& r) {
    return fmt::format("{}, jobs of {} and {} of memory (export: --threads, --memory)",
                       counted(static_cast<std::size_t>(r.cores), "core"),
                       counted(static_cast<std::size_t>(r.threads), "thread"), sized(r.memory));
}

/// Pools for Ninja, whose -j counts jobs without their threads and memory.
std::string ninja_pools(const Lanes& lanes, const Resources& resources) {
    std::string text = fmt::format("# Jobs at a time, for {}.\npool small\n  depth = {}\n",
                                   in_words(resources), lanes.small);
    if (lanes.large > 0)
        text += fmt::format("# Jobs that need more than {} each.\npool large\n  depth = {}\n",
                            sized(lanes.small_up_to), lanes.large);
    return text;
}

} // namespace

std::string ninja_workflow(const std::vector<Job>& given, const Resources& resources) {
    const auto jobs = transformed(
        given, [](Job job) { return fits_ninja_depfile(job) ? with_depfiles(std::move(job)) : job; });
    check_jobs(jobs, plain_command, for_shell(resources.program).size());
    check_names(jobs, "Ninja", "|\t", "rename the file");
    const Lanes lanes = lanes_of(jobs, resources);
    std::string text =
        heading() + fmt::format("# The executable, as a command and as a file.\nfacetmill = {}\n"
                                "program = {}\n\n",
                                with_dollars_doubled(for_shell(resources.program)),
                                with_dollars_doubled(resources.program));
    text += ninja_pools(lanes, resources) +
            "\nrule mill\n  command = $work\n  description = MILL $asset\n  pool = small\n";
    for (const auto& job : jobs) {
        const std::string work = plain_command(job, "$facetmill", with_dollars_doubled);
        text += fmt::format("\nbuild{}: mill{} | $program\n  asset = {}\n  work = {}\n",
                            joined(job.outputs, ninja_path), joined(job.inputs, ninja_path),
                            with_dollars_doubled(job.name), work);
        text += fmt::format("  threads = {}\n  megabytes = {}\n", resources.threads, megabytes_of(job));
        if (fits_ninja_depfile(job))
            text += fmt::format("  depfile = {}\n  deps = gcc\n", depfile_of(job.targets.front()));
        if (lanes.large > 0 && job.memory > lanes.small_up_to) text += "  pool = large\n";
    }
    return text;
}

std::string make_workflow(const std::vector<Job>& given, const Resources& resources) {
    const auto jobs = transformed(given, with_depfiles);
    check_jobs(jobs, make_command);
    check_names(jobs, "Make", "|;=*?[]~\t", "use --to ninja, or rename the file");
    std::string rules, all;
    for (const auto& job : jobs) {
        const std::string outputs = joined(job.outputs, make_target);
        all += " \\\n " + joined(job.outputs, make_input);
        // "&:" groups targets into a single rule: GNU make 4.3.
        rules +=
            fmt::format("\n# {}, about {} MB\n{} &:{} $(PROGRAM)\n\t{}\n",
                        counted(static_cast<std::size_t>(resources.threads), "thread"), megabytes_of(job),
                        outputs.substr(1), joined(job.inputs, make_input) + joined(job.absent, make_absent),
                        make_command(job, "$(FACETMILL)", with_dollars_doubled));
        for (const auto& target : job.targets) rules += fmt::format("-include {}\n", depfile_of(target));
    }
    const Lanes lanes = lanes_of(jobs, resources);
    const std::size_t most = lanes.large > 0 ? lanes.large : lanes.small;
    const std::string advice = fmt::format(
        "# make runs as many jobs at a time as -j allows, regardless of their memory and threads.\n"
        "# -j{} suits {}.\n",
        most, in_words(resources));
    return heading() + advice +
           "FACETMILL ?= facetmill\n# The executable as a file, on which all outputs depend.\n"
           "PROGRAM := $(subst $() ,\\ ,$(shell command -v $(FACETMILL) 2>/dev/null))\n\n.PHONY: all\nall:" +
           all + "\n" + rules;
}

std::string snakemake_workflow(const std::vector<Job>& jobs, const Resources& resources) {
    check_jobs(jobs, snakemake_command);
    // Snakemake takes braces for wildcards and cannot escape them here.
    check_names(jobs, "Snakemake", "{}", "rename the file");
    Json all = Json::array();
    for (const Job& job : jobs)
        all.push_back(
            {{"name",
              "job_" + std::filesystem::path(depfile_of(job.outputs.front())).stem().generic_string()},
             {"asset", job.name},
             {"runs", command_lines(job)},
             {"inputs", job.inputs},
             {"absent", job.absent},
             {"outputs", job.outputs},
             {"megabytes", megabytes_of(job)}});
    return heading() + fmt::format(R"(import os
import shutil

FACETMILL = config.get("facetmill", "facetmill")
PROGRAM = [path for path in [shutil.which(FACETMILL)] if path]
JOBS = {}


rule all:
    input: [path for job in JOBS for path in job["outputs"]]


for job in JOBS:
    rule:
        name: job["name"]
        input: job["inputs"] + PROGRAM + [path for path in job["absent"] if os.path.exists(path)]
        output: job["outputs"]
        message: "Processing " + job["asset"].replace("{{", "{{{{").replace("}}", "}}}}")
        params: command=lambda wildcards, job=job: "s=0;" + "".join(f" {{FACETMILL}}{{run}} || s=$?;" for run in job["runs"]) + " exit $s"
        threads: {}
        resources: mem_mb=job["megabytes"]
        shell: "{{params.command}}"
)",
                                   as_json(all), resources.threads);
}

} // namespace facetmill::cli
