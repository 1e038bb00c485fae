#include "cli/pipe_option.hpp"

#include "cli/pipe_value.hpp"
#include "geometry/inspect/inspect.hpp"
#include "stage/common_keys.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

const Option* find_dotted(const Declaration& declaration, std::string_view name) {
    const auto dot = name.find('.');
    const Option* option = declaration.find(name.substr(0, dot));
    if (!option || dot == name.npos) return option;
    return option->fields ? find_dotted(*option->fields, name.substr(dot + 1)) : nullptr;
}

Option list_of_texts() {
    Option list;
    list.kind = OptionKind::list;
    list.repeatable = true;
    return list;
}

bool is_common(std::string_view key) { return is_common_key(key) || key == "join"; }

std::string with_underscores(std::string key) {
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

namespace {

/// Whether the key accepts only true and false. Such keys are flags of a stage, groups with a boolean
/// short form (--draco), and properties that are truths.
bool is_truth(const std::string& key, const Option* known) {
    if (known && known->fields) return known->fields->short_form == ShortForm::truth;
    if (known && known->kind != OptionKind::bound) return known->kind == OptionKind::boolean;
    const auto* property = property_named(std::string_view(key).substr(key.rfind('.') + 1));
    return key == "join" || (property && property->truth());
}

/// A key as the stage spells it.
struct KnownKey {
    std::string key;
    const Option* option = nullptr; ///< null if the stage has no such option
    bool negated = false;           ///< --no-key
};

/// Dashes may stand for underscores, as in other programs.
KnownKey look_up(const std::string& key, const StageInfo* stage) {
    if (!stage) return {key};
    if (const Option* option = find_dotted(*stage->options, key)) return {key, option};
    const std::string name = with_underscores(key);
    if (const Option* option = find_dotted(*stage->options, name)) return {name, option};
    const std::string rest = key.starts_with("no-") ? key.substr(3) : "";
    const Option* option = rest.empty() ? nullptr : find_dotted(*stage->options, rest);
    return option ? KnownKey{rest, option, true} : KnownKey{key};
}

Value given_value(const PipeWords& words, const std::string& text, const std::string& key,
                  const Option* known, const Mark& where) {
    if (key != "only") return pipe_value(text, known, where, words.problems());
    const Option list = list_of_texts();
    return pipe_value(text, &list, where, words.problems());
}

/// A key without a value: true, if the option allows it.
Value flag_value(const PipeWords& words, const std::string& key, const Option* known, const Mark& where) {
    if (known && known->kind != OptionKind::group && known->kind != OptionKind::assertions &&
        !is_truth(key, known) && !known->may_be_true)
        words.problems().add(where, "E-PIPE", fmt::format("'--{}' needs a value", key), known->help);
    return Value::scalar("true", where);
}

/// A group accepts a bare value and options, in either order: --holes planar --holes.edges 9. This gives
/// an existing bare value its name, or returns the full key of a new bare value.
std::string nested_key(Value& map, const std::string& key, const Declaration& declaration) {
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
Value as_list(const PipeWords& words, Value value, const Option& several) {
    if (value.is_scalar())
        value = pipe_value(value.text, &several, value.mark, words.problems());
    else if (value.is_list())
        value = as_one_value(std::move(value), several);
    if (value.is_list()) return value;
    const Mark mark = value.mark;
    return Value::list({std::move(value)}, mark);
}

/// An option may have a form for a single value and a form for several (plane, planes). If the first
/// repeats, or both occur, all values go to the second. This changes key and value, and returns the
/// option that they now belong to.
const Option* gathered(const PipeWords& words, Value& map, std::string& key, Value& value,
                       const Option* known, const Declaration& declaration) {
    const Option* several = known && known->name == key ? declaration.find(key + "s") : nullptr;
    if (!several || !several->repeatable) return known;
    const Value* slot = map.find(key);
    if ((slot != nullptr) == (map.find(several->name) != nullptr)) return known;
    if (slot) {
        const Mark where = slot->mark;
        Value list = as_list(words, *slot, *several);
        std::erase_if(map.entries, [&](const auto& entry) { return entry.key == key; });
        map.set(several->name, std::move(list), where);
    }
    value = as_list(words, std::move(value), *several);
    key = several->name;
    return several;
}

} // namespace

bool wants_value(const PipeWords& words, const std::string& key, const Option* known) {
    if (words.at_end_of_step() || is_option(words.word()) || is_bracket(words.word())) return false;
    const bool truth = is_truth(key, known);
    return !truth || words.word() == "true" || words.word() == "false";
}

void add_value(const PipeWords& words, Value& map, const std::string& key, Value value, const Mark& key_mark,
               const Option* known) {
    const auto dot = key.find('.');
    const std::string head = key.substr(0, dot);
    Value* slot = map.find(head);
    if (dot != key.npos) {
        if (!slot) slot = &map.set(head, Value::map({}, key_mark), key_mark);
        if (slot->is_map())
            return add_value(words, *slot, key.substr(dot + 1), std::move(value), key_mark, known);
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
    words.problems().add(
        key_mark.known() ? key_mark : value.mark, "E-PIPE", fmt::format("'--{}' is given twice", head),
        fmt::format("it was '{}' before", slot->is_scalar() ? slot->text : slot->described()));
}

void read_option(PipeWords& words, Value& item, const StageInfo* stage) {
    const std::string argument = words.word().substr(2);
    const auto equals = argument.find('=');
    std::string key = argument.substr(0, equals);
    Mark key_mark = words.mark();
    if (equals != argument.npos) key_mark.length = static_cast<int>(key.size()) + 2;
    if (std::count(key.begin(), key.end(), '.') > PipeWords::deepest) {
        words.wrong(fmt::format("a key has more than {} parts", PipeWords::deepest + 1));
        words.next();
        return;
    }
    const KnownKey found = look_up(key, stage);
    key = found.key;
    const Option* known = found.option;
    const bool common = !known && is_common(key.substr(0, key.find('.')));
    Value value;
    if (equals != argument.npos)
        value = given_value(words, argument.substr(equals + 1), key, known, words.inside(equals + 3));
    words.next();
    if (found.negated)
        value = Value::scalar("false", key_mark);
    else if (equals == argument.npos && wants_value(words, key, known)) {
        if (words.word() == "--") words.next(); // as before a bare value
        if (words.at_end_of_step()) return words.wrong("a value is missing after '--'");
        value = given_value(words, words.word(), key, known, words.mark());
        words.next();
    } else if (equals == argument.npos)
        value = flag_value(words, key, known, key_mark);
    if (!common && item.entries[0].value.is_null()) {
        const Mark where = item.entries[0].value.mark;
        item.entries[0].value = Value::map({}, where);
    }
    if (!common && stage) {
        key = nested_key(item.entries[0].value, key, *stage->options);
        known = gathered(words, item.entries[0].value, key, value, known, *stage->options);
    }
    add_value(words, common ? item : item.entries[0].value, key, std::move(value), key_mark, known);
}

} // namespace facetmill::cli
