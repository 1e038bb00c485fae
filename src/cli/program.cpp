#include "base/json.hpp"
#include "base/text/spelling.hpp"
#include "cli/command.hpp"
#include "cli/stage_commands.hpp"
#include "docs/ready.hpp"
#include "docs/stages.hpp"
#include "docs/versions.hpp"
#include "io/images/avif.hpp"
#include "platform/sandbox.hpp"
#include "stage/common_keys.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace facetmill::cli {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        convert_command(), view_command(),   fix_command(),     run_command(),    batch_command(),
        export_command(),  plan_command(),   pipe_command(),    new_command(),    check_command(),
        info_command(),    render_command(), diff_command(),    stages_command(), schema_command(),
        formats_command(), cache_command(),  explain_command(), docs_command(),   completions_command()};
    return all;
}

std::string version_text(bool json) {
    if (!json) return fmt::format("facetmill {}\n", docs::release());
    Json libraries = Json::object();
    for (const auto& library : docs::library_versions())
        libraries[std::string(library.name)] = library.version;
    const Protections here = offered_protections();
    Json all = {{"name", "facetmill"},
                {"version", docs::release()},
                {"format", 1},
                {"libraries", libraries},
                {"optional", {{"avif", io::has_avif()}}},
                {"sandbox", {{"landlock", here.files}, {"seccomp", here.calls}}}};
    if (here.mitigations) all["sandbox"]["mitigations"] = true;
    for (const auto& source : docs::linked_sources())
        all["sources"][std::string(source.name)] =
            fmt::format("https://sources.debian.org/src/{}/{}/", source.name, source.version);
    return all.dump(2) + "\n";
}

namespace {

constexpr const char* help_begin =
    R"(facetmill processes polygon meshes with declarative pipelines and writes checked glTF.

Usage: facetmill COMMAND ...

Commands
)";

constexpr const char* help_end = R"(
  --help, --version, --version --json, and help TOPIC, which is short for facetmill docs TOPIC

Examples
  facetmill convert part.stl part.glb
  facetmill view part.stl
  facetmill fix part.stl
  facetmill pipe load scan.ply ! simplify 25% ! write web.glb
  facetmill run pipeline.yaml -D input=scan.ply --output-dir out
  facetmill batch pipeline.yaml --input 'scans/**/*.ply' --output-dir out
  facetmill info scan.ply
  facetmill diff scan.ply web.glb --unit mm --max 0.5%
  facetmill stages simplify

See also facetmill COMMAND --help, facetmill docs, and the manual pages facetmill(1), facetmill-pipeline(5),
facetmill-stages(7) and facetmill-messages(7).

Exit codes: 0 success, 1 a check failed, 2 error in the command line or pipeline, 3 an input is missing, 4 an
output cannot be written, 5 a stage cannot process its input, 6 an input is malformed, 7 a limit was exceeded or
memory ran out, 70 a bug in facetmill, 128+n ended by signal n.)";

std::string help_text() {
    std::string text = help_begin;
    for (const auto& c : commands()) text += fmt::format("  {:<11}  {}\n", c.name, c.about);
    return text + help_end;
}

/// A hint for a word that is not a command: a mesh file, a word of other tools, a built-in pipeline, or a
/// similar command.
std::string hint_for(const std::vector<std::string>& words, const std::vector<std::string>& names) {
    const std::string& name = words[0];
    if (name.find_first_of("./\\") != name.npos)
        return "use facetmill convert IN OUT to convert a mesh file, or facetmill view IN to look at it";
    if (docs::ready_pipeline(name))
        return fmt::format("use facetmill run {} -D input=FILE to run a pipeline", name);
    if (const StageInfo* stage = stage_called(name)) return as_pipe(stage->name, words);
    return suggestion(name, names);
}

/// A hint for an option before its command.
std::string option_first(const std::vector<std::string>& words, const std::vector<std::string>& names) {
    const auto command = std::find_first_of(words.begin() + 1, words.end(), names.begin(), names.end());
    return fmt::format("options come after the command: facetmill {} {} ...",
                       command == words.end() ? "run" : *command, words[0]);
}

/// The stage whose help is requested as if it were a command, or null.
const StageInfo* help_of_stage(const std::vector<std::string>& words) {
    const auto is_command = [&](const Command& c) { return c.name == words[0]; };
    const bool wanted = std::any_of(words.begin() + 1, words.end(),
                                    [](const std::string& word) { return word == "--help" || word == "-h"; });
    return wanted && std::none_of(commands().begin(), commands().end(), is_command) ? stage_named(words[0])
                                                                                    : nullptr;
}

const Command& command_named(const std::string& name, const CommandLine& line) {
    std::vector<std::string> names;
    for (const auto& c : commands()) {
        if (c.name == name) return c;
        names.push_back(c.name);
    }
    if (stage_named(name) || is_control_item(name))
        throw Error(ErrorKind::usage, "E-COMMAND", fmt::format("'{}' is a stage, not a command", name),
                    stage_named(name) ? as_pipe(name, line.arguments()) : "facetmill pipe --help",
                    line.mark(0));
    if (name.starts_with("-"))
        throw Error(ErrorKind::usage, "E-OPTION", fmt::format("facetmill itself has no option '{}'", name),
                    option_first(line.arguments(), names), line.mark(0));
    throw Error(ErrorKind::usage, "E-COMMAND", fmt::format("command '{}' does not exist", name),
                hint_for(line.arguments(), names), line.mark(0));
}

std::string option_hint(const Command& command, const Arguments& arguments, const std::string& given) {
    // Without dashes, because these would make any two options similar.
    const std::string near =
        nearest(given.substr(std::min(given.size(), given.find_first_not_of('-'))), arguments.long_names());
    return near.empty() ? fmt::format("see facetmill {} --help", command.name)
                        : fmt::format("did you mean '--{}'?", near);
}

/// A hint for an extra value. For commands that take a pipeline, it may be stages in pipe's notation (batch
/// a.obj ! simplify 50%), or plain mesh files (batch p.yaml *.obj).
std::string hint_for(const Command& command, const Arguments& arguments, const std::string& extra,
                     const CommandLine& line) {
    const auto& words = line.arguments();
    const Argument* define = arguments.find("-D");
    const bool takes_pipeline = define && !define->is_hidden;
    const bool has_stages = std::find(words.begin(), words.end(), "!") != words.end();
    if (has_stages && !takes_pipeline) return "to run stages separated by !, use facetmill pipe";
    if (has_stages)
        return fmt::format("{} needs a pipeline file, and facetmill new FILE.yaml creates one; to run stages "
                           "separated by ! on one input, use facetmill pipe",
                           command.name);
    if (std::find(words.begin(), words.end(), "--input") != words.end())
        return "quote a pattern so that the shell does not expand it (--input '*.obj'), or repeat --input";
    if (arguments.find("--input"))
        return fmt::format("give meshes after --input: facetmill {} PIPELINE --input {} ...", command.name,
                           extra);
    if (takes_pipeline)
        return fmt::format("meshes are params of the pipeline: facetmill {} PIPELINE -D input={}; for many "
                           "meshes use facetmill batch",
                           command.name, extra);
    return fmt::format("see facetmill {} --help", command.name);
}

/// A hint for a missing argument or an invalid value. fault: begins with the name of the argument.
std::string fault_hint(const Command& command, const Arguments& arguments, const std::string& fault,
                       const CommandLine& line) {
    const std::string name = fault.substr(0, fault.find_first_of(": "));
    const Argument* option = name.starts_with("-") ? arguments.find(name) : nullptr;
    if (option && option->range)
        return fmt::format("give a number from {} to {}, or leave out {}", option->range->first,
                           option->range->second, name);
    if (!fault.ends_with("is required")) return fmt::format("see facetmill {} --help", command.name);
    const auto& words = line.arguments();
    if (std::find(words.begin(), words.end(), "!") != words.end())
        return hint_for(command, arguments, "FILE", line);
    if (option)
        return fmt::format("add it, for example {} {}", name,
                           option->choices.empty() ? "out" : option->choices.front());
    if (name == "PIPELINE" && arguments.find("--input"))
        return fmt::format("name a pipeline first: facetmill {} PIPELINE --input FILE ...; facetmill new "
                           "lists the built-in ones",
                           command.name);
    if (name == "PIPELINE") return hint_for(command, arguments, "FILE", line);
    std::string usage = "facetmill " + command.name;
    for (const Argument& argument : arguments.all())
        if (argument.needed && !argument.names.starts_with("-")) usage += " " + argument.names;
    return usage;
}

/// Refuses words that belong to no argument: an unknown option begins with a dash, and other words are extra
/// values.
void refuse_extras(const Command& command, const Arguments& arguments, const std::vector<std::string>& extras,
                   const CommandLine& line) {
    Problems problems;
    for (const auto& extra : extras) {
        if (extra.starts_with("-") && extra.size() > 1) {
            const std::string name = extra.substr(0, extra.find('='));
            problems.add(line.find(extra), "E-OPTION",
                         fmt::format("'{}' has no option '{}'", command.name, name),
                         option_hint(command, arguments, name));
            continue;
        }
        problems.add(line.find(extra), "E-ARGUMENT",
                     fmt::format("'{}' does not accept '{}'", command.name, extra),
                     hint_for(command, arguments, extra, line));
        break; // the remaining words are of the same kind
    }
    problems.throw_if_any(ErrorKind::usage);
}

/// --strict alone means all warnings; otherwise the parser would take the next argument for its value.
/// --quiet with a value is --allow.
std::vector<std::string> expanded(std::vector<std::string> words, bool takes_the_rest,
                                  const CommandLine& line) {
    const auto refuse_separate_id = [&](std::size_t i) {
        if (i + 1 >= words.size() || !words[i + 1].starts_with("W-")) return;
        throw Error(
            ErrorKind::usage, "E-ARGUMENT",
            fmt::format("write {0} and the id of a warning as one argument: {0}={1}", words[i], words[i + 1]),
            fmt::format("{} alone applies to all warnings", words[i]), line.mark(i + 2));
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string& word = words[i];
        if (takes_the_rest && !word.starts_with("-")) break;
        if (word == "--strict" || word == "--quiet") refuse_separate_id(i);
        if (word == "--strict") word = "--strict=*";
        if (word.starts_with("--quiet=")) word = "--allow=" + word.substr(8);
    }
    return words;
}

/// The number of words that are options before the first stage of a pipe.
std::size_t leading_options(const Arguments& arguments, const std::vector<std::string>& words) {
    std::size_t i = 0;
    while (i < words.size() && words[i].size() > 1 && words[i].starts_with("-")) {
        const std::string& word = words[i];
        const bool attached = word.starts_with("--") ? word.find('=') != word.npos : word.size() > 2;
        const auto* option =
            arguments.find(word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2));
        i += option && !attached && !option->is_flag() ? 2 : 1;
    }
    return std::min(i, words.size());
}

int execute(const Command& command, const CommandLine& line, Console& console) {
    Arguments arguments;
    const auto work = command.declare(arguments, console);
    std::vector<std::string> words(line.arguments().begin() + 1, line.arguments().end());
    words = expanded(std::move(words), !command.the_rest.empty(), line);
    Invocation invocation{line, 0};
    if (!command.the_rest.empty()) {
        const auto count = leading_options(arguments, words);
        words.resize(count);
        invocation.rest = 1 + count;
    }
    Parsed parsed;
    try {
        parsed = arguments.parse(command.name, command.about, std::move(words), command.the_rest);
    } catch (const NotAChoice& e) {
        throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("{}: {}", command.name, e.what()),
                    e.hint.empty() ? fmt::format("see facetmill {} --help", command.name) : e.hint,
                    line.value(e.value));
    } catch (const std::invalid_argument& e) {
        throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("{}: {}", command.name, e.what()),
                    fault_hint(command, arguments, e.what(), line), line.mark(0));
    } catch (Error& e) {
        throw e.at(line.mark(0));
    }
    if (parsed.help_wanted) {
        print(parsed.help + "\n" + command.examples +
              (command.stage ? "\n" + docs::stage_page(*stage_named(command.stage)) : ""));
        return 0;
    }
    refuse_extras(command, arguments, parsed.extras, line);
    return work(invocation);
}

} // namespace

int program(std::vector<std::string> arguments, Console& console) {
    const CommandLine line(std::move(arguments));
    const auto& all = line.arguments();
    if (all.empty()) {
        console.say(help_text());
        return static_cast<int>(ErrorKind::usage);
    }
    const bool asks = all[0] == "--help" || all[0] == "-h" || all[0] == "help";
    if (asks && all.size() == 1) {
        print(help_text());
        return 0;
    }
    if (asks) return execute(docs_command(), line, console);
    if (all[0] == "--version" || all[0] == "-V") {
        print(version_text(all.size() > 1 && all[1] == "--json"));
        return 0;
    }
    if (const StageInfo* stage = help_of_stage(all)) {
        print(docs::stage_page(*stage));
        return 0;
    }
    return execute(command_named(all[0], line), line, console);
}

} // namespace facetmill::cli
