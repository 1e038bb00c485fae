#include "cli/pipe_syntax.hpp"

#include "cli/pipe_option.hpp"
#include "cli/pipe_stage.hpp"
#include "cli/pipe_value.hpp"
#include "stage/common_keys.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// Reads stages and blocks; every function leaves the words after the part that it read.
class Parser {
  public:
    Parser(PipeWords words, const Arguments* own) : words_(words), own_(own) {}

    Value document(const Mark& whole) {
        refuse_swallowed_stage();
        Value stages = steps();
        if (!words_.done()) words_.wrong("']' without '['");
        return Value::map({{"facetmill", {}, Value::scalar("1")}, {"stages", {}, std::move(stages)}}, whole);
    }

  private:
    /// Detects "--timings load a.stl": the option of pipe took the name of the first stage as its value.
    void refuse_swallowed_stage() {
        if (!own_ || words_.done() || !words_.before(3)) return;
        if (is_step(words_.word()) || !is_step(*words_.before(1))) return;
        const std::string& option = *words_.before(2);
        if (!is_option(option) || option.find('=') != std::string::npos || !own_->find(option)) return;
        const std::string& stage = *words_.before(1);
        words_.problems().add(words_.mark_before(1), "E-PIPE",
                              fmt::format("'{}' needs a value, but found the stage name '{}'", option, stage),
                              fmt::format("{} VALUE {} {}", option, stage, words_.word()));
    }

    /// Reads stages up to the end or a closing bracket.
    Value steps() {
        Value list = Value::list({}, words_.mark());
        while (true) {
            if (words_.at_end_of_step()) {
                words_.wrong("a stage is missing here", "load a.stl ! relax 3 ! write a.glb");
                if (words_.done() || words_.word() == "]") return list;
            } else
                list.items.push_back(step());
            if (words_.done() || words_.word() == "]") return list;
            if (words_.word() == "!" || words_.word() == "+")
                words_.next(); // otherwise the missing separator is already reported
        }
    }

    Value step() {
        const std::string name = words_.word();
        const Mark where = words_.mark();
        if (const ControlItem* control = control_item(name)) return control_step(control->kind, where);
        if (is_option(name) || is_bracket(name))
            words_.wrong(fmt::format("expected a stage, found '{}'", name));
        return read_stage(words_, own_);
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

    /// Parses: foreach lod=50%,10% name=a,b [ ... ]
    Value foreach_step(const Mark& where) {
        Value item = Value::map({{"foreach", where, Value::map({}, where)}}, where);
        for (words_.next(); !words_.at_end_of_step() && words_.word() != "["; words_.next()) {
            if (is_option(words_.word())) {
                option_of_block(item);
                continue;
            }
            const auto equals = words_.word().find('=');
            if (equals == std::string::npos || equals == 0) {
                words_.wrong(fmt::format("foreach needs variable=value,value, found '{}'", words_.word()));
                continue;
            }
            const std::string variable = words_.word().substr(0, equals);
            variable_values(item.entries[0].value, variable, words_.word().substr(equals + 1), equals + 1);
        }
        item.set("do", block("foreach lod=50%,10% [ simplify @{lod} ! write o.@{lod.index}.glb ]"), where);
        while (!words_.at_end_of_step()) trailing_option(item);
        return item;
    }

    void variable_values(Value& variables, const std::string& variable, const std::string& text,
                         std::size_t offset) {
        const Option list = list_of_texts();
        const bool parts = variable == "part" && text.find(',') == text.npos;
        Value values = pipe_value(text, parts ? nullptr : &list, words_.inside(offset), words_.problems());
        if (parts)
            values.quoted = true; // a bare * would be an alias in YAML
        else if (!values.is_list())
            values = Value::list({values}, values.mark);
        if (variables.find(variable))
            words_.wrong(fmt::format("'{}' is given twice", variable));
        else
            variables.set(variable, std::move(values), words_.mark());
    }

    /// Parses: branch near [ ... ] far [ ... ]
    Value branch_step(const Mark& where) {
        Value item = Value::map({{"branch", where, Value::map({}, where)}}, where);
        words_.next();
        while (!words_.at_end_of_step()) {
            if (is_option(words_.word())) {
                trailing_option(item);
                continue;
            }
            const std::string arm = words_.word();
            const Mark arm_mark = words_.mark();
            if (arm != "[")
                words_.next();
            else
                words_.wrong("a branch needs a name before '['", "branch near [ ... ] far [ ... ]");
            Value body = block("branch near [ ... ] far [ ... ]");
            Value& arms = item.entries[0].value;
            if (arms.find(arm))
                words_.problems().add(arm_mark, "E-PIPE", fmt::format("two branches are named '{}'", arm));
            else
                arms.set(arm, std::move(body), arm_mark);
        }
        return item;
    }

    /// Parses: include finish.yaml --with.ratio=10%
    Value include_step(const Mark& where) {
        Value item = Value::map({{"include", where, Value{}}}, where);
        Value options = Value::map({{"include", where, Value{}}}, where); // in the form of a stage
        for (words_.next(); !words_.at_end_of_step();) {
            const std::string& word = words_.word();
            if (word.starts_with("--with.")) {
                read_option(words_, options, nullptr);
                continue;
            }
            if (is_option(word))
                words_.wrong(fmt::format("include has no option '{}'", word),
                             "include FILE --with.NAME=VALUE");
            else if (!item.entries[0].value.is_null())
                words_.wrong(fmt::format("include needs one file, found '{}'", word),
                             "separate stages with ! or +");
            else
                item.entries[0].value = Value::scalar(expressions(word), words_.mark());
            words_.next();
        }
        if (const Value& all = options.entries[0].value; all.is_map())
            item.set("with", *all.find("with"), where);
        return item;
    }

    /// Parses: [ stages ]
    Value block(const char* example) {
        if (words_.done() || words_.word() != "[") {
            words_.wrong("'[' is missing here", example);
            if (!words_.at_end_of_step()) words_.next();
            return Value::list({}, words_.mark());
        }
        if (depth_ == PipeWords::deepest) {
            words_.wrong(fmt::format("brackets are nested more than {} levels deep", PipeWords::deepest),
                         "put the inner stages into a file and include it");
            too_deep_ = true;
            words_.skip_all();
            return Value::list({}, words_.mark());
        }
        const Mark opening = words_.mark();
        words_.next();
        ++depth_;
        Value body = steps();
        --depth_;
        if (words_.done()) {
            if (!too_deep_) words_.problems().add(opening, "E-PIPE", "this '[' is not closed", example);
        } else
            words_.next();
        return body;
    }

    void trailing_option(Value& item) {
        if (is_option(words_.word())) {
            option_of_block(item);
            words_.next();
        } else {
            words_.wrong(fmt::format("expected ! or the end, found '{}'", words_.word()));
            words_.next();
        }
    }

    /// Reads a common key of a branch or foreach; ends on its last argument.
    void option_of_block(Value& item) {
        const std::string argument = words_.word().substr(2);
        const std::string key = argument.substr(0, argument.find_first_of(".="));
        if (!is_common(key)) words_.wrong(fmt::format("'{}' has no option '--{}'", item.entries[0].key, key));
        const StageInfo none{};
        const bool known = is_common(key);
        Value scratch = known ? std::move(item) : Value::map({{"x", {}, Value{}}});
        read_option(words_, scratch, &none);
        if (known) item = std::move(scratch);
        words_.previous();
    }

    PipeWords words_;
    int depth_ = 0; ///< open brackets
    bool too_deep_ = false;
    const Arguments* own_;
};

} // namespace

Value parse_pipe(const CommandLine& line, std::size_t first, Problems& problems, const Arguments* own) {
    return Parser(PipeWords(line, first, problems), own).document(line.mark(0));
}

} // namespace facetmill::cli
