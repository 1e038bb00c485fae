#include "cli/pipe_stage.hpp"

#include "cli/pipe_option.hpp"
#include "cli/pipe_value.hpp"
#include "cli/stage_commands.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// Other languages' words for true and false, which may follow a flag.
bool is_foreign_truth(const std::string& a) {
    return a == "yes" || a == "no" || a == "on" || a == "off" || a == "y" || a == "n";
}

/// Whether the stage has an option of this name, or it is a common key.
bool takes(const StageInfo& stage, const std::string& name) {
    return is_common(name.substr(0, name.find('.'))) || find_dotted(*stage.options, name) ||
           find_dotted(*stage.options, with_underscores(name));
}

/// The hint for a second bare value if only a single value is allowed.
std::string hint_of_second(const StageInfo& stage, const std::string& word) {
    if (is_foreign_truth(word)) return "switch options with true and false: --draco, --draco=false";
    if (takes(stage, word)) return fmt::format("did you mean '--{}'?", word);
    if (names_result(stage, word)) return fmt::format("give its output file with --path {}", word);
    return "separate stages with ! or +";
}

/// Sets the bare values of a stage: alone, or as the primary option with the other options.
void set_bare(const PipeWords& words, Value& value, std::vector<Value> bare, const StageInfo* stage,
              const Mark& where) {
    const Option* primary = stage ? stage->options->primary() : nullptr;
    Value one = bare[0];
    if (bare.size() > 1) {
        if (primary && !primary->repeatable && primary->kind != OptionKind::vector)
            words.problems().add(bare[1].mark, "E-PIPE",
                                 fmt::format("'{}' accepts one value, found {}", stage->name, bare.size()),
                                 hint_of_second(*stage, bare[1].text));
        Value list = Value::list({}, bare[0].mark);
        for (auto& b : bare)
            if (b.is_list())
                list.items.insert(list.items.end(), b.items.begin(), b.items.end());
            else
                list.items.push_back(std::move(b));
        one = std::move(list);
    }
    const Mark at = one.mark;
    if (value.is_null())
        value = std::move(one);
    else if (primary)
        add_value(words, value, primary->name, std::move(one), at, primary);
    else if (stage) // an unknown stage has its own error
        words.problems().add(at, "E-PIPE", "a bare value cannot be combined with options here",
                             "give it with the name of its option");
    if (!value.mark.known()) value.mark = where;
}

/// "-- -2mm" as in a shell: the word after two dashes is a value, whatever it begins with.
void bare_behind_dashes(PipeWords& words, std::vector<Value>& bare, const Option* primary) {
    words.next();
    if (words.at_end_of_step()) return words.wrong("a value is missing after '--'");
    bare.push_back(pipe_value(words.word(), primary, words.mark(), words.problems()));
    words.next();
}

/// Whether the bare word is a stage without a ! before it. It may instead be the first value of an
/// option for words or files, or an existing file.
bool is_forgotten_separator(const PipeWords& words, const Option* primary, bool first) {
    const std::string& word = words.word();
    if (!is_step(word)) return false;
    std::error_code ignored;
    if (!primary) return true;
    if (std::any_of(primary->choices.begin(), primary->choices.end(),
                    [&](const Choice& choice) { return choice.name == word; }))
        return false;
    const bool takes_words = primary->dimension == Dimension::none && primary->kind != OptionKind::integer &&
                             primary->kind != OptionKind::number && primary->kind != OptionKind::vector;
    return !(first && takes_words) && !std::filesystem::exists(word, ignored);
}

/// Refuses "-u mm", because stage options have only long names.
bool skip_short_option(PipeWords& words, const StageInfo& stage) {
    const std::string& word = words.word();
    if (word.size() != 2 || !std::isalpha(static_cast<unsigned char>(word[1]))) return false;
    std::string hint = fmt::format("facetmill stages {} lists its options", stage.name);
    for (const Option& o : stage.options->options)
        if (o.name[0] == word[1]) {
            hint = fmt::format("did you mean '--{}'?", o.name);
            break;
        }
    words.wrong(fmt::format("'{}' has no option '{}': options of stages have long names", stage.name, word),
                hint);
    words.next();
    if (!words.at_end_of_step() && !words.word().starts_with("-")) words.next();
    return true;
}

/// Skips an option of pipe itself after a stage, with its value, and reports where it belongs.
bool skip_own_option(PipeWords& words, const Arguments* own, const StageInfo* stage) {
    const std::string& word = words.word();
    if (!own || !stage || word.size() < 2 || !word.starts_with("-")) return false;
    const bool is_long = word.starts_with("--");
    const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
    const Argument* argument = own->find(name);
    if (!argument && !is_long) return skip_short_option(words, *stage);
    if (!argument || (is_long && takes(*stage, name.substr(2)))) return false;
    words.wrong(fmt::format("'{}' is an option of pipe, found after the stage '{}'", name, stage->name),
                fmt::format("put it before the first stage: facetmill pipe {} ... load ...", name));
    const bool attached = is_long ? word.find('=') != word.npos : word.size() > 2;
    words.next();
    if (!argument->is_flag() && !attached && !words.at_end_of_step()) words.next();
    return true;
}

/// Whether the stage's bare value is a path, and the word has a file suffix. A file with the option's
/// own name, "path=a.glb", is unlikely.
bool may_be_file(const StageInfo& stage, const std::string& name, const std::string& word) {
    const Option* primary = stage.options->primary();
    if (!primary || name == primary->name) return false;
    if (primary->kind != OptionKind::path && primary->one != OptionKind::path) return false;
    const std::string suffix = std::filesystem::path(word).extension().generic_string();
    return suffix.size() > 1 && std::isalpha(static_cast<unsigned char>(suffix[1]));
}

/// Refuses "ratio=10%", "ratio:10%" and "-ratio", the notations of other programs. A word that is, or
/// may be, a file name is accepted: "draco=1.glb".
bool skip_misspelt_option(PipeWords& words, const StageInfo& stage) {
    const std::string& word = words.word();
    if (is_option(word)) return false;
    const bool dash = word.starts_with('-');
    const auto end = word.find_first_of("=:");
    const std::string name = word.substr(dash, end == word.npos ? end : end - dash);
    std::error_code ignored;
    if ((!dash && end == word.npos) || name.empty() || !takes(stage, name) ||
        std::filesystem::exists(word, ignored) || (!dash && may_be_file(stage, name, word)))
        return false;
    std::string value = end == word.npos ? "" : word.substr(end + 1);
    const Mark where = words.mark();
    words.next();
    if (dash && end == word.npos && wants_value(words, name, find_dotted(*stage.options, name)))
        value = words.take();
    words.problems().add(where, "E-PIPE",
                         fmt::format("an option of a stage starts with two dashes, found '{}'", word),
                         fmt::format("write --{}{}{}", name, value.empty() ? "" : " ", value));
    return true;
}

} // namespace

Value read_stage(PipeWords& words, const Arguments* own) {
    const Mark where = words.mark();
    const std::string& name = words.take();
    const StageInfo* stage = stage_named(name);
    Value item = Value::map({{name, where, Value{}}}, where);
    item.entries[0].value.mark = where;
    std::vector<Value> bare;
    const Option* primary = stage ? stage->options->primary() : nullptr;
    while (!words.at_end_of_step()) {
        if (skip_own_option(words, own, stage) || (stage && skip_misspelt_option(words, *stage))) continue;
        if (is_forgotten_separator(words, primary, bare.empty())) {
            words.wrong(fmt::format("'{}' is a stage, found among the values of '{}'", words.word(), name),
                        fmt::format("add ! before {} if it is a stage", words.word()));
            break;
        }
        if (words.word() == "--")
            bare_behind_dashes(words, bare, primary);
        else if (is_option(words.word()))
            read_option(words, item, stage);
        else if (words.word() == "[") {
            words.wrong(fmt::format("'{}' does not accept '['", name));
            words.next();
        } else {
            bare.push_back(pipe_value(words.word(), primary, words.mark(), words.problems()));
            words.next();
        }
    }
    if (!bare.empty()) set_bare(words, item.entries[0].value, std::move(bare), stage, where);
    return item;
}

} // namespace facetmill::cli
