// facetmill completions: shell completions from the declarations.

#include "base/message_ids.hpp"
#include "base/text/words.hpp"
#include "cli/command.hpp"
#include "cli/completion_scripts.hpp"
#include "cli/topics.hpp"
#include "docs/describe.hpp"
#include "docs/ready.hpp"
#include "geometry/inspect/inspect.hpp"
#include "stage/common_keys.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// A row that offers files besides the words; without words, files are always offered.
constexpr const char* files_row = "<files>";

constexpr const char* completions_examples = R"(Examples
  facetmill completions bash > ~/.local/share/bash-completion/completions/facetmill
  source <(facetmill completions zsh)                  (in ~/.zshrc, after compinit)
  facetmill completions fish > ~/.config/fish/completions/facetmill.fish
)";

struct Word {
    std::string text, help;
};
using Words = std::vector<Word>;

/// Words by context: "commands", "options command run", "values stage clip --keep".
using Tables = std::vector<std::pair<std::string, Words>>;

/// The first sentence on a single line.
std::string brief_help(std::string help) {
    help = help.substr(0, std::min(help.find(". "), help.find('\n')));
    if (help.ends_with('.')) help.pop_back();
    return help;
}

Words stage_words() {
    Words words;
    for (const auto& stage : stages()) words.push_back({stage.name, brief_help(stage.about)});
    for (const auto& item : control_items()) words.push_back({item.name, item.about});
    return words;
}

Words plain(const std::vector<std::string>& texts) {
    Words words;
    for (const auto& text : texts) words.push_back({text, ""});
    return words;
}

/// The possible values of a bare argument of the command.
Words values_of_command(const std::string& command, const Argument& argument) {
    Words words = plain(argument.choices);
    if (argument.names == "PIPELINE") {
        for (const auto& ready : docs::ready_pipelines())
            words.push_back({std::string(ready.name), "a built-in pipeline"});
        words.push_back({files_row, ""});
    }
    if (command == "stages") words = stage_words();
    if (command == "docs")
        for (const auto& topic : topics()) words.push_back({topic.name, brief_help(topic.about)});
    if (command == "explain")
        for (const auto& id : message_ids())
            words.push_back({std::string(id.id), brief_help(std::string(id.meaning))});
    return words;
}

void add_command(const Command& command, Tables& tables) {
    Arguments arguments;
    Console console;
    command.declare(arguments, console);
    Words options{{"--help", "Print this help and exit"}};
    const std::string owner = "command " + command.name;
    for (const auto& argument : arguments.all()) {
        if (argument.is_hidden) continue;
        if (!argument.names.starts_with('-')) {
            tables.emplace_back("values " + owner + " ", values_of_command(command.name, argument));
            continue;
        }
        for (const auto name : split_at_commas(argument.names)) {
            if (name.starts_with("--")) options.push_back({std::string(name), brief_help(argument.help)});
            const auto values = argument.suggestions ? argument.suggestions() : argument.choices;
            if (!values.empty()) tables.emplace_back(fmt::format("values {} {}", owner, name), plain(values));
        }
    }
    if (command.rest_is_stages) tables.emplace_back("values " + owner + " ", stage_words());
    tables.emplace_back("options " + owner, std::move(options));
}

Words of_choices(const std::vector<Choice>& choices) {
    Words words;
    for (const auto& choice : choices) words.push_back({choice.name, brief_help(choice.help)});
    return words;
}

void add_stage_tables(const StageInfo& stage, Tables& tables) {
    Words options;
    const std::string owner = "stage " + stage.name;
    for (const auto& row : docs::rows(*stage.options)) {
        options.push_back({"--" + row.name, brief_help(row.help)});
        if (row.choices.empty()) continue;
        tables.emplace_back("values " + owner + " --" + row.name, of_choices(row.choices));
        if (row.primary) tables.emplace_back("values " + owner + " ", of_choices(row.choices));
    }
    tables.emplace_back("options " + owner, std::move(options));
}

Words words_of_every_stage() {
    Words words;
    for (const auto& key : common_keys())
        words.push_back({"--" + std::string(key.name), brief_help(key.help)});
    for (const auto& property : property_table())
        for (const char* key : {"--ensure.", "--when."})
            words.push_back({key + std::string(property.name), brief_help(std::string(property.help))});
    return words;
}

Tables all_tables() {
    Tables tables;
    Words names;
    for (const auto& command : commands()) names.push_back({command.name, brief_help(command.about)});
    tables.emplace_back("commands", std::move(names));
    tables.emplace_back("stages", stage_words());
    for (const auto& command : commands()) add_command(command, tables);
    for (const auto& stage : stages()) add_stage_tables(stage, tables);
    tables.emplace_back("options of every stage", words_of_every_stage());
    return tables;
}

/// The text in single quotes, which the shells escape in two ways.
std::string in_quotes(std::string_view text, bool fish) {
    std::string out = "'";
    for (const char c : text)
        if (c == '\'')
            out += fish ? "\\'" : "'\\''";
        else if (c == '\\' && fish)
            out += "\\\\";
        else
            out += c;
    return out + "'";
}

std::string rows_of(const Words& words, bool fish) {
    std::string out;
    for (const auto& word : words)
        out += " \\\n      " + in_quotes(word.text + (word.help.empty() ? "" : "\t" + word.help), fish);
    return out;
}

std::string table_for_sh() {
    std::string out = "_facetmill_table() {\n  case $1 in\n";
    for (const auto& [name, words] : all_tables())
        if (!words.empty())
            out +=
                fmt::format("    {}) printf '%s\\n'{} ;;\n", in_quotes(name, false), rows_of(words, false));
    out += "  esac\n}\n\n_facetmill_is_stage() {\n  case $1 in\n    ";
    for (const auto& word : stage_words()) out += (out.ends_with(' ') ? "" : " | ") + word.text;
    return out + ") return 0 ;;\n  esac\n  return 1\n}\n";
}

std::string table_for_fish() {
    std::string out = "function __facetmill_table\n    switch \"$argv[1]\"\n";
    for (const auto& [name, words] : all_tables())
        if (!words.empty())
            out += fmt::format("        case {}\n            printf '%s\\n'{}\n", in_quotes(name, true),
                               rows_of(words, true));
    out += "    end\nend\n\nset -g __facetmill_stages";
    for (const auto& word : stage_words()) out += " " + word.text;
    return out + "\n";
}

std::string completions_for(const std::string& shell) {
    const std::string head =
        fmt::format("# Completions of facetmill for {}, made by: facetmill completions {}\n", shell, shell);
    if (shell == "fish") return head + table_for_fish() + fish_end;
    return head + table_for_sh() + candidates_sh + (shell == "zsh" ? zsh_end : bash_end);
}

} // namespace

Command completions_command() {
    return {"completions",
            "Prints completions for bash, zsh or fish.",
            completions_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto shell = std::make_shared<std::string>();
                arguments.add("SHELL", shell.get(), "bash, zsh or fish.")
                    .one_of({"bash", "zsh", "fish"})
                    .required();
                return [=](const Invocation&) {
                    print(completions_for(*shell));
                    return 0;
                };
            }};
}

} // namespace facetmill::cli
