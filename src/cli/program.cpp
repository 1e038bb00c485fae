#include "base/json.hpp"
#include "base/spelling.hpp"
#include "cli/command.hpp"
#include "docs/versions.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

const std::vector<Command>& commands() {
    static const std::vector<Command> all{run_command(),    plan_command(),   pipe_command(),
                                          check_command(),  info_command(),   diff_command(),
                                          stages_command(), schema_command(), formats_command(),
                                          explain_command()};
    return all;
}

std::string version_text(bool json) {
    if (!json) return fmt::format("facetmill {}\n", docs::release());
    Json libraries = Json::object();
    for (const auto& library : docs::library_versions())
        libraries[std::string(library.name)] = library.version;
    const Json all = {
        {"name", "facetmill"}, {"version", docs::release()}, {"format", 1}, {"libraries", libraries}};
    return all.dump(2) + "\n";
}

namespace {

std::string help_text() {
    std::string text =
        "facetmill: a mill for facets. Declarative mesh pipelines that end in checked glTF.\n\n"
        "Usage: facetmill COMMAND ...\n\nCommands\n";
    for (const auto& c : commands()) text += fmt::format("  {:<8}  {}\n", c.name, c.about);
    return text + "\n  --help, --version, --version --json\n\nExamples\n"
                  "  facetmill pipe load scan.ply ! simplify 25% ! write web.glb\n"
                  "  facetmill run pipeline.yaml -D input=scan.ply --output-dir out\n"
                  "  facetmill info scan.ply\n"
                  "  facetmill diff scan.ply web.glb --max 0.5%\n"
                  "  facetmill stages simplify\n\n"
                  "facetmill COMMAND --help tells more; so do the manual pages facetmill(1), "
                  "facetmill-pipeline(5),\n"
                  "facetmill-stages(7) and facetmill-messages(7).\n\n"
                  "Exit codes: 0 done, 1 a check did not hold, 2 the command line or the pipeline is wrong, "
                  "3 an input is\n"
                  "missing, 4 an output cannot be written, 5 a stage could not do its work, 6 an input is "
                  "malformed, 7 a\n"
                  "limit or memory, 70 a bug in facetmill, 128+n ended by signal n.\n";
}

const Command& command_named(const std::string& name, const CommandLine& line) {
    std::vector<std::string> names;
    for (const auto& c : commands()) {
        if (c.name == name) return c;
        names.push_back(c.name);
    }
    if (name.starts_with("-"))
        throw Error(ErrorKind::usage, "E-OPTION", fmt::format("facetmill itself has no option '{}'", name),
                    "options come after the command: facetmill run ... " + name, line.mark(0));
    throw Error(ErrorKind::usage, "E-COMMAND", fmt::format("there is no command '{}'", name),
                suggestion(name, names), line.mark(0));
}

/// Long names without their dashes, which would make any two options seem alike.
std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const auto* option : app.get_options())
        for (const auto& name : option->get_lnames()) names.push_back(name);
    return names;
}

std::string option_hint(const CLI::App& app, const std::string& given) {
    const std::string near =
        nearest(given.substr(std::min(given.size(), given.find_first_not_of('-'))), option_names(app));
    return near.empty() ? fmt::format("see facetmill {} --help", app.get_name())
                        : fmt::format("did you mean '--{}'?", near);
}

/// What CLI11 could not place. An option that begins with a dash is unknown; anything else is one value too
/// many.
void refuse_extras(const CLI::App& app, const CommandLine& line) {
    Problems problems;
    for (const auto& extra : app.remaining()) {
        if (extra.starts_with("-") && extra.size() > 1) {
            const std::string name = extra.substr(0, extra.find('='));
            problems.add(line.find(extra), "E-OPTION",
                         fmt::format("'{}' has no option '{}'", app.get_name(), name),
                         option_hint(app, name));
        } else
            problems.add(line.find(extra), "E-ARGUMENT",
                         fmt::format("'{}' does not take '{}'", app.get_name(), extra),
                         fmt::format("see facetmill {} --help", app.get_name()));
    }
    problems.throw_if_any(ErrorKind::usage);
}

/// --strict alone means all warnings; CLI11 would take the next argument for its value.
std::vector<std::string> spelled_out(std::vector<std::string> arguments, bool takes_the_rest) {
    for (auto& a : arguments) {
        if (takes_the_rest && !a.starts_with("-")) break;
        if (a == "--strict") a = "--strict=*";
    }
    return arguments;
}

/// How many of the arguments are options that come before the first stage of a pipe.
std::size_t leading_options(const CLI::App& app, const std::vector<std::string>& arguments) {
    std::size_t i = 0;
    while (i < arguments.size() && arguments[i].size() > 1 && arguments[i].starts_with("-")) {
        const std::string& a = arguments[i];
        const bool attached = a.starts_with("--") ? a.find('=') != a.npos : a.size() > 2;
        const auto* option =
            app.get_option_no_throw(a.starts_with("--") ? a.substr(0, a.find('=')) : a.substr(0, 2));
        i += option && !attached && option->get_items_expected_max() > 0 ? 2 : 1;
    }
    return std::min(i, arguments.size());
}

/// CLI11's message, as ours.
Error usage_error(const CLI::App& app, const CLI::ParseError& e, const CommandLine& line) {
    return Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("{}: {}", app.get_name(), e.what()),
                 fmt::format("see facetmill {} --help", app.get_name()), line.mark(0));
}

int execute(const Command& command, const CommandLine& line, Console& console) {
    CLI::App app{command.about, command.name};
    app.allow_extras();
    app.set_help_flag("-h,--help", "Print this and leave.");
    const auto work = command.declare(app, console);
    std::vector<std::string> options(line.arguments().begin() + 1, line.arguments().end());
    options = spelled_out(std::move(options), command.takes_the_rest);
    Invocation invocation{line, 0};
    if (command.takes_the_rest) {
        const auto count = leading_options(app, options);
        options.resize(count);
        invocation.rest = 1 + count;
    }
    std::reverse(options.begin(), options.end()); // as CLI11 takes them
    try {
        app.parse(options);
    } catch (const CLI::CallForHelp&) {
        print(app.help("facetmill") + "\n" + command.examples);
        return 0;
    } catch (const CLI::ParseError& e) {
        throw usage_error(app, e, line);
    }
    refuse_extras(app, line);
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
    if (all[0] == "--help" || all[0] == "-h" || all[0] == "help") return print(help_text()), 0;
    if (all[0] == "--version" || all[0] == "-V")
        return print(version_text(all.size() > 1 && all[1] == "--json")), 0;
    return execute(command_named(all[0], line), line, console);
}

} // namespace facetmill::cli
