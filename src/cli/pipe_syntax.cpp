#include "cli/pipe_syntax.hpp"

#include "cli/pipe_value.hpp"
#include "cli/stage_commands.hpp"
#include "geometry/inspect/inspect.hpp"
#include "stage/common_keys.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// The option of a stage by dotted name: "plane.normal". Null if it does not exist.
const Option* find_dotted(const Declaration& declaration, std::string_view name) {
    const auto dot = name.find('.');
    const Option* option = declaration.find(name.substr(0, dot));
    if (!option || dot == name.npos) return option;
    return option->fields ? find_dotted(*option->fields, name.substr(dot + 1)) : nullptr;
}

/// An option for several texts.
Option list_of_texts() {
    Option list;
    list.kind = OptionKind::list;
    list.repeatable = true;
    return list;
}

bool is_separator(const std::string& a) { return a == "!" || a == "+"; }
bool is_bracket(const std::string& a) { return a == "[" || a == "]"; }
bool is_option(const std::string& a) { return a.size() > 2 && a.starts_with("--"); }
bool is_step(const std::string& a) { return stage_named(a) || is_control_item(a); }

/// Other languages' words for true and false, which may follow a flag.
bool is_foreign_truth(const std::string& a) {
    return a == "yes" || a == "no" || a == "on" || a == "off" || a == "y" || a == "n";
}
bool is_common(std::string_view key) { return is_common_key(key) || key == "join"; }

/// Reads the arguments from left to right; every function leaves at_ after the part that it read.
class Parser {
  public:
    Parser(const CommandLine& line, std::size_t first, Problems& problems, const Arguments* own)
        : line_(line), all_(line.arguments()), at_(first), problems_(problems), own_(own) {}

    Value document() {
        refuse_swallowed_stage();
        Value stages = steps();
        if (at_ < all_.size()) wrong("']' without '['");
        return Value::map({{"facetmill", {}, Value::scalar("1")}, {"stages", {}, std::move(stages)}},
                          line_.mark(0));
    }

  private:
    /// Detects "--timings load a.stl": the option of pipe took the name of the first stage as its value.
    void refuse_swallowed_stage() {
        if (!own_ || at_ < 3 || at_ >= all_.size() || is_step(all_[at_]) || !is_step(all_[at_ - 1])) return;
        const std::string& option = all_[at_ - 2];
        if (!is_option(option) || option.find('=') != std::string::npos || !own_->find(option)) return;
        const std::string stage = all_[at_ - 1];
        problems_.add(line_.mark(at_ - 1), "E-PIPE",
                      fmt::format("'{}' needs a value, but found the stage name '{}'", option, stage),
                      fmt::format("{} VALUE {} {}", option, stage, all_[at_]));
    }

    /// Reads stages up to the end or a closing bracket.
    Value steps() {
        Value list = Value::list({}, mark());
        while (true) {
            if (done() || is_separator(all_[at_]) || all_[at_] == "]") {
                wrong("a stage is missing here", "load a.stl ! relax 3 ! write a.glb");
                if (done() || all_[at_] == "]") return list;
            } else
                list.items.push_back(step());
            if (done() || all_[at_] == "]") return list;
            if (is_separator(all_[at_])) ++at_; // otherwise the missing separator is already reported
        }
    }

    Value step() {
        const std::string name = all_[at_];
        const Mark where = mark();
        if (const ControlItem* control = control_item(name)) return control_step(control->kind, where);
        if (is_option(name) || is_bracket(name)) wrong(fmt::format("expected a stage, found '{}'", name));
        ++at_;
        return stage_step(name, where);
    }

    Value control_step(ControlItem::Kind kind, const Mark& where) {
        switch (kind) {
        case ControlItem::Kind::branch:
            return branch_step(where);
        case ControlItem::Kind::foreach:
            return foreach_step(where);
        case ControlItem::Kind::include:
            break;
        }
        return include_step(where);
    }

    Value stage_step(const std::string& name, const Mark& where) {
        const StageInfo* stage = stage_named(name);
        Value item = Value::map({{name, where, Value{}}}, where);
        item.entries[0].value.mark = where;
        std::vector<Value> bare;
        const Option* primary = stage ? stage->options->primary() : nullptr;
        while (!at_end_of_step()) {
            if (skip_own_option(stage) || (stage && skip_misspelt_option(*stage))) continue;
            if (is_forgotten_separator(primary, bare.empty())) {
                wrong(fmt::format("'{}' is a stage, found among the values of '{}'", all_[at_], name),
                      fmt::format("add ! before {} if it is a stage", all_[at_]));
                break;
            }
            if (all_[at_] == "--")
                bare_behind_dashes(bare, primary);
            else if (is_option(all_[at_]))
                option(item, stage);
            else if (all_[at_] == "[") {
                wrong(fmt::format("'{}' does not accept '['", name));
                ++at_;
            } else {
                bare.push_back(pipe_value(all_[at_], primary, mark(), problems_));
                ++at_;
            }
        }
        if (!bare.empty()) set_bare(item.entries[0].value, std::move(bare), stage, where);
        return item;
    }

    /// "-- -2mm" as in a shell: the word after two dashes is a value, whatever it begins with.
    void bare_behind_dashes(std::vector<Value>& bare, const Option* primary) {
        ++at_;
        if (at_end_of_step()) return wrong("a value is missing after '--'");
        bare.push_back(pipe_value(all_[at_], primary, mark(), problems_));
        ++at_;
    }

    /// Whether the bare word is a stage without a ! before it. It may instead be the first value of an
    /// option for words or files, or an existing file.
    bool is_forgotten_separator(const Option* primary, bool first) const {
        const std::string& word = all_[at_];
        if (!is_step(word)) return false;
        std::error_code ignored;
        if (!primary) return true;
        if (std::any_of(primary->choices.begin(), primary->choices.end(),
                        [&](const Choice& choice) { return choice.name == word; }))
            return false;
        const bool takes_words = primary->dimension == Dimension::none &&
                                 primary->kind != OptionKind::integer &&
                                 primary->kind != OptionKind::number && primary->kind != OptionKind::vector;
        return !(first && takes_words) && !std::filesystem::exists(word, ignored);
    }

    /// Skips an option of pipe itself after a stage, with its value, and reports where it belongs.
    bool skip_own_option(const StageInfo* stage) {
        const std::string& word = all_[at_];
        if (!own_ || !stage || word.size() < 2 || !word.starts_with("-")) return false;
        const bool is_long = word.starts_with("--");
        const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
        const Argument* argument = own_->find(name);
        if (!argument && !is_long) return skip_short_option(*stage);
        if (!argument || (is_long && takes(*stage, name.substr(2)))) return false;
        wrong(fmt::format("'{}' is an option of pipe, found after the stage '{}'", name, stage->name),
              fmt::format("put it before the first stage: facetmill pipe {} ... load ...", name));
        const bool attached = is_long ? word.find('=') != word.npos : word.size() > 2;
        ++at_;
        if (!argument->is_flag() && !attached && !at_end_of_step()) ++at_;
        return true;
    }

    /// Refuses "-u mm", because stage options have only long names.
    bool skip_short_option(const StageInfo& stage) {
        const std::string& word = all_[at_];
        if (word.size() != 2 || !std::isalpha(static_cast<unsigned char>(word[1]))) return false;
        std::string hint = fmt::format("facetmill stages {} lists its options", stage.name);
        for (const Option& o : stage.options->options)
            if (o.name[0] == word[1]) {
                hint = fmt::format("did you mean '--{}'?", o.name);
                break;
            }
        wrong(fmt::format("'{}' has no option '{}': options of stages have long names", stage.name, word),
              hint);
        ++at_;
        if (!at_end_of_step() && !all_[at_].starts_with("-")) ++at_;
        return true;
    }

    /// Refuses "ratio=10%", "ratio:10%" and "-ratio", the notations of other programs. A word that is, or
    /// may be, a file name is accepted: "draco=1.glb".
    bool skip_misspelt_option(const StageInfo& stage) {
        const std::string& word = all_[at_];
        if (is_option(word)) return false;
        const bool dash = word.starts_with('-');
        const auto end = word.find_first_of("=:");
        const std::string name = word.substr(dash, end == word.npos ? end : end - dash);
        std::error_code ignored;
        if ((!dash && end == word.npos) || name.empty() || !takes(stage, name) ||
            std::filesystem::exists(word, ignored) || (!dash && may_be_file(stage, name, word)))
            return false;
        std::string value = end == word.npos ? "" : word.substr(end + 1);
        const Mark where = mark();
        ++at_;
        if (dash && end == word.npos && wants_value(name, find_dotted(*stage.options, name)))
            value = all_[at_++];
        problems_.add(where, "E-PIPE",
                      fmt::format("an option of a stage starts with two dashes, found '{}'", word),
                      fmt::format("write --{}{}{}", name, value.empty() ? "" : " ", value));
        return true;
    }

    /// Whether the stage's bare value is a path, and the word has a file suffix. A file with the option's
    /// own name, "path=a.glb", is unlikely.
    static bool may_be_file(const StageInfo& stage, const std::string& name, const std::string& word) {
        const Option* primary = stage.options->primary();
        if (!primary || name == primary->name) return false;
        if (primary->kind != OptionKind::path && primary->one != OptionKind::path) return false;
        const std::string suffix = std::filesystem::path(word).extension().string();
        return suffix.size() > 1 && std::isalpha(static_cast<unsigned char>(suffix[1]));
    }

    /// Whether the stage has an option of this name, or it is a common key.
    static bool takes(const StageInfo& stage, const std::string& name) {
        return is_common(name.substr(0, name.find('.'))) || find_dotted(*stage.options, name) ||
               find_dotted(*stage.options, with_underscores(name));
    }

    /// The hint for a second bare value if only a single value is allowed.
    static std::string hint_of_second(const StageInfo& stage, const std::string& word) {
        if (is_foreign_truth(word)) return "switch options with true and false: --draco, --draco=false";
        if (takes(stage, word)) return fmt::format("did you mean '--{}'?", word);
        if (names_result(stage, word)) return fmt::format("give its output file with --path {}", word);
        return "separate stages with ! or +";
    }

    /// Sets the bare values of a stage: alone, or as the primary option with the other options.
    void set_bare(Value& value, std::vector<Value> bare, const StageInfo* stage, const Mark& where) {
        const Option* primary = stage ? stage->options->primary() : nullptr;
        Value one = bare[0];
        if (bare.size() > 1) {
            if (primary && !primary->repeatable && primary->kind != OptionKind::vector)
                problems_.add(bare[1].mark, "E-PIPE",
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
            add(value, primary->name, std::move(one), at, primary);
        else if (stage) // an unknown stage has its own error
            problems_.add(at, "E-PIPE", "a bare value cannot be combined with options here",
                          "give it with the name of its option");
        if (!value.mark.known()) value.mark = where;
    }

    static std::string with_underscores(std::string key) {
        std::replace(key.begin(), key.end(), '-', '_');
        return key;
    }

    /// Parses --key value, --key=value, --key and --no-key. Dotted keys nest.
    void option(Value& item, const StageInfo* stage) {
        const std::string argument = all_[at_].substr(2);
        const auto equals = argument.find('=');
        std::string key = argument.substr(0, equals);
        Mark key_mark = mark();
        if (equals != argument.npos) key_mark.length = static_cast<int>(key.size()) + 2;
        if (std::count(key.begin(), key.end(), '.') > deepest) {
            wrong(fmt::format("a key has more than {} parts", deepest + 1));
            ++at_;
            return;
        }
        const Option* known = stage ? find_dotted(*stage->options, key) : nullptr;
        if (std::string name = with_underscores(key); !known && stage && find_dotted(*stage->options, name)) {
            key = std::move(name);
            known = find_dotted(*stage->options, key);
        } // the notation of other programs
        const bool negated =
            !known && key.starts_with("no-") && stage && find_dotted(*stage->options, key.substr(3));
        if (negated) {
            key = key.substr(3);
            known = find_dotted(*stage->options, key);
        }
        const bool common = !known && is_common(key.substr(0, key.find('.')));
        Value value;
        if (equals != argument.npos)
            value = given(argument.substr(equals + 1), key, known, inside(equals + 3));
        ++at_;
        if (negated)
            value = Value::scalar("false", key_mark);
        else if (equals == argument.npos && wants_value(key, known)) {
            if (all_[at_] == "--") ++at_; // as before a bare value
            if (at_end_of_step()) return wrong("a value is missing after '--'");
            value = given(all_[at_], key, known, mark());
            ++at_;
        } else if (equals == argument.npos)
            value = flag(key, known, key_mark);
        if (!common && item.entries[0].value.is_null()) {
            const Mark where = item.entries[0].value.mark;
            item.entries[0].value = Value::map({}, where);
        }
        if (!common && stage) {
            key = nested_key(item.entries[0].value, key, *stage->options);
            known = gathered(item.entries[0].value, key, value, known, *stage->options);
        }
        add(common ? item : item.entries[0].value, key, std::move(value), key_mark, known);
    }

    Value given(const std::string& text, const std::string& key, const Option* known, const Mark& where) {
        if (key != "only") return pipe_value(text, known, where, problems_);
        const Option list = list_of_texts();
        return pipe_value(text, &list, where, problems_);
    }

    /// Whether the next argument is the option's value. Flags and properties that are truths take only true
    /// or false.
    bool wants_value(const std::string& key, const Option* known) const {
        if (at_end_of_step() || is_option(all_[at_]) || is_bracket(all_[at_])) return false;
        const bool truth = is_truth(key, known);
        return !truth || all_[at_] == "true" || all_[at_] == "false";
    }

    /// Whether the key accepts only true and false. Such keys are flags of a stage, groups with a boolean
    /// short form (--draco), and properties that are truths.
    static bool is_truth(const std::string& key, const Option* known) {
        if (known && known->fields) return known->fields->short_form == ShortForm::truth;
        if (known && known->kind != OptionKind::bound) return known->kind == OptionKind::boolean;
        const auto* property = property_named(std::string_view(key).substr(key.rfind('.') + 1));
        return key == "join" || (property && property->truth());
    }

    /// A key without a value: true, if the option allows it.
    Value flag(const std::string& key, const Option* known, const Mark& where) {
        if (known && known->kind != OptionKind::group && known->kind != OptionKind::assertions &&
            !is_truth(key, known) && !known->may_be_true)
            problems_.add(where, "E-PIPE", fmt::format("'--{}' needs a value", key), known->help);
        return Value::scalar("true", where);
    }

    /// A group accepts a bare value and options, in either order: --holes planar --holes.edges 9. This gives
    /// an existing bare value its name, or returns the full key of a new bare value.
    static std::string nested_key(Value& map, const std::string& key, const Declaration& declaration) {
        const auto dot = key.find('.');
        const std::string head = key.substr(0, dot);
        const Option* group = declaration.find(head);
        const Option* primary = group && group->fields ? group->fields->primary() : nullptr;
        Value* slot = map.find(head);
        if (!primary || !slot) return key;
        if (dot == key.npos) return slot->is_map() ? head + "." + primary->name : key;
        if (group->may_be_true && slot->as_bool() == true)
            *slot = Value::map({}, slot->mark);
        else if (slot->is_scalar() && !group->fields->shorthand)
            *slot = Value::map({{primary->name, slot->mark, *slot}}, slot->mark);
        return key;
    }

    /// Converts a value to the form of the option for several values.
    Value as_list(Value value, const Option& several) {
        if (value.is_scalar())
            value = pipe_value(value.text, &several, value.mark, problems_);
        else if (value.is_list())
            value = as_one_value(std::move(value), several);
        if (value.is_list()) return value;
        const Mark mark = value.mark;
        return Value::list({std::move(value)}, mark);
    }

    /// An option may have a form for a single value and a form for several (plane, planes). If the first
    /// repeats, or both occur, all values go to the second. This changes key and value, and returns the
    /// option that they now belong to.
    const Option* gathered(Value& map, std::string& key, Value& value, const Option* known,
                           const Declaration& declaration) {
        const Option* several = known && known->name == key ? declaration.find(key + "s") : nullptr;
        if (!several || !several->repeatable) return known;
        const Value* slot = map.find(key);
        if ((slot != nullptr) == (map.find(several->name) != nullptr)) return known;
        if (slot) {
            const Mark where = slot->mark;
            Value list = as_list(*slot, *several);
            std::erase_if(map.entries, [&](const auto& entry) { return entry.key == key; });
            map.set(several->name, std::move(list), where);
        }
        value = as_list(std::move(value), *several);
        key = several->name;
        return several;
    }

    /// Sets a value at a dotted key; a repeatable option collects its values.
    void add(Value& map, const std::string& key, Value value, const Mark& key_mark, const Option* known) {
        const auto dot = key.find('.');
        const std::string head = key.substr(0, dot);
        Value* slot = map.find(head);
        if (dot != key.npos) {
            if (!slot) slot = &map.set(head, Value::map({}, key_mark), key_mark);
            if (slot->is_map()) return add(*slot, key.substr(dot + 1), std::move(value), key_mark, known);
        } else if (!slot) {
            map.set(head, std::move(value), key_mark);
            return;
        } else if ((known && known->repeatable) || head == "only") {
            Value list = slot->is_list() ? *slot : Value::list({*slot}, slot->mark);
            if (value.is_list())
                list.items.insert(list.items.end(), value.items.begin(), value.items.end());
            else
                list.items.push_back(std::move(value));
            *slot = std::move(list);
            return;
        }
        problems_.add(key_mark.known() ? key_mark : value.mark, "E-PIPE",
                      fmt::format("'--{}' is given twice", head),
                      fmt::format("it was '{}' before", slot->is_scalar() ? slot->text : slot->described()));
    }

    /// Parses: foreach lod=50%,10% name=a,b [ ... ]
    Value foreach_step(const Mark& where) {
        Value item = Value::map({{"foreach", where, Value::map({}, where)}}, where);
        for (++at_; !at_end_of_step() && all_[at_] != "["; ++at_) {
            if (is_option(all_[at_])) {
                option_of_block(item);
                continue;
            }
            const auto equals = all_[at_].find('=');
            if (equals == std::string::npos || equals == 0) {
                wrong(fmt::format("foreach needs variable=value,value, found '{}'", all_[at_]));
                continue;
            }
            const std::string variable = all_[at_].substr(0, equals);
            variable_values(item.entries[0].value, variable, all_[at_].substr(equals + 1), equals + 1);
        }
        item.set("do", block("foreach lod=50%,10% [ simplify @{lod} ! write o.@{lod.index}.glb ]"), where);
        while (!at_end_of_step()) trailing_option(item);
        return item;
    }

    void variable_values(Value& variables, const std::string& variable, const std::string& text,
                         std::size_t offset) {
        const Option list = list_of_texts();
        const bool parts = variable == "part" && text.find(',') == text.npos;
        Value values = pipe_value(text, parts ? nullptr : &list, inside(offset), problems_);
        if (parts)
            values.quoted = true; // a bare * would be an alias in YAML
        else if (!values.is_list())
            values = Value::list({values}, values.mark);
        if (variables.find(variable))
            wrong(fmt::format("'{}' is given twice", variable));
        else
            variables.set(variable, std::move(values), mark());
    }

    /// Parses: branch near [ ... ] far [ ... ]
    Value branch_step(const Mark& where) {
        Value item = Value::map({{"branch", where, Value::map({}, where)}}, where);
        ++at_;
        while (!at_end_of_step()) {
            if (is_option(all_[at_])) {
                trailing_option(item);
                continue;
            }
            const std::string arm = all_[at_];
            const Mark arm_mark = mark();
            if (arm != "[")
                ++at_;
            else
                wrong("a branch needs a name before '['", "branch near [ ... ] far [ ... ]");
            Value body = block("branch near [ ... ] far [ ... ]");
            Value& arms = item.entries[0].value;
            if (arms.find(arm))
                problems_.add(arm_mark, "E-PIPE", fmt::format("two branches are named '{}'", arm));
            else
                arms.set(arm, std::move(body), arm_mark);
        }
        return item;
    }

    /// Parses: include finish.yaml --with.ratio=10%
    Value include_step(const Mark& where) {
        Value item = Value::map({{"include", where, Value{}}}, where);
        Value options = Value::map({{"include", where, Value{}}}, where); // in the form of a stage
        for (++at_; !at_end_of_step();) {
            const std::string& word = all_[at_];
            if (word.starts_with("--with.")) {
                option(options, nullptr);
                continue;
            }
            if (is_option(word))
                wrong(fmt::format("include has no option '{}'", word), "include FILE --with.NAME=VALUE");
            else if (!item.entries[0].value.is_null())
                wrong(fmt::format("include needs one file, found '{}'", word), "separate stages with ! or +");
            else
                item.entries[0].value = Value::scalar(expressions(word), mark());
            ++at_;
        }
        if (const Value& all = options.entries[0].value; all.is_map())
            item.set("with", *all.find("with"), where);
        return item;
    }

    /// Parses: [ stages ]
    Value block(const char* example) {
        if (done() || all_[at_] != "[") {
            wrong("'[' is missing here", example);
            if (!at_end_of_step()) ++at_;
            return Value::list({}, mark());
        }
        if (depth_ == deepest) {
            wrong(fmt::format("brackets are nested more than {} levels deep", deepest),
                  "put the inner stages into a file and include it");
            too_deep_ = true;
            at_ = all_.size(); // skip the rest
            return Value::list({}, mark());
        }
        const Mark opening = mark();
        ++at_;
        ++depth_;
        Value body = steps();
        --depth_;
        if (done()) {
            if (!too_deep_) problems_.add(opening, "E-PIPE", "this '[' is not closed", example);
        } else
            ++at_;
        return body;
    }

    void trailing_option(Value& item) {
        if (is_option(all_[at_])) {
            option_of_block(item);
            ++at_;
        } else {
            wrong(fmt::format("expected ! or the end, found '{}'", all_[at_]));
            ++at_;
        }
    }

    /// Reads a common key of a branch or foreach; at_ ends on its last argument.
    void option_of_block(Value& item) {
        const std::string argument = all_[at_].substr(2);
        const std::string key = argument.substr(0, argument.find_first_of(".="));
        if (!is_common(key)) wrong(fmt::format("'{}' has no option '--{}'", item.entries[0].key, key));
        const StageInfo none{};
        const bool known = is_common(key);
        Value scratch = known ? std::move(item) : Value::map({{"x", {}, Value{}}});
        option(scratch, &none);
        if (known) item = std::move(scratch);
        --at_;
    }

    bool done() const { return at_ >= all_.size(); }
    bool at_end_of_step() const { return done() || is_separator(all_[at_]) || all_[at_] == "]"; }
    Mark mark() const { return line_.mark(std::min(at_, all_.size() - 1)); }
    /// The mark of the current argument from this byte on.
    Mark inside(std::size_t offset) const {
        Mark m = mark();
        if (m.length != static_cast<int>(all_[at_].size()) || m.length <= static_cast<int>(offset)) return m;
        m.column += static_cast<int>(offset);
        m.length -= static_cast<int>(offset);
        return m;
    }
    void wrong(std::string message, std::string hint = {}) {
        problems_.add(mark(), "E-PIPE", std::move(message), std::move(hint));
    }

    /// The limit for brackets, and for dots in a key. A branch takes three of the 64 levels that a pipeline
    /// file may have.
    static constexpr int deepest = 20;

    const CommandLine& line_;
    const std::vector<std::string>& all_;
    std::size_t at_;
    int depth_ = 0; ///< open brackets
    bool too_deep_ = false;
    Problems& problems_;
    const Arguments* own_;
};

} // namespace

Value parse_pipe(const CommandLine& line, std::size_t first, Problems& problems, const Arguments* own) {
    return Parser(line, first, problems, own).document();
}

} // namespace facetmill::cli
