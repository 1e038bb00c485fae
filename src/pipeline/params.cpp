#include "pipeline/params.hpp"

#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "io/bytes.hpp"
#include "pipeline/document.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::pipeline {

namespace fs = std::filesystem;

Mark command_line_mark(const std::string& option, const std::string& text, std::size_t from) {
    const auto source = std::make_shared<const SourceText>(SourceText{option, text});
    return {source, 1, static_cast<int>(from) + 1,
            static_cast<int>(text.size() - std::min(from, text.size()))};
}

namespace {

/// The mark of a parameter's value: in a table, or after its name on the command line.
Mark mark_of_define(const PlanSettings& settings, const std::string& name, const std::string& text,
                    std::size_t from) {
    const auto place = settings.defined_at.find(name);
    if (place != settings.defined_at.end()) return place->second;
    return command_line_mark("-D", fmt::format("{}={}", name, text), from);
}

} // namespace

Json value_json(const Value& value) {
    Json out;
    switch (value.kind) {
    case Value::Kind::null:
        return nullptr;
    case Value::Kind::scalar:
        if (const auto truth = value.as_bool()) return *truth;
        if (const auto integer = value.as_integer()) return *integer;
        if (const auto real = value.as_real()) return *real;
        return value.text;
    case Value::Kind::list:
        out = Json::array();
        for (const auto& item : value.items) out.push_back(value_json(item));
        return out;
    case Value::Kind::map:
        out = Json::object();
        for (const auto& entry : value.entries) out[entry.key] = value_json(entry.value);
        return out;
    }
    return out;
}

namespace {

enum class Type { path, text, integer, number, boolean, ratio, length, angle, choice, list };

struct ParamOptions {
    Type type = Type::text;
    std::string help;
    bool required = false;
    std::optional<std::string> min, max;
    std::vector<std::string> choices;
    Type of = Type::list; ///< the type of each value of a list; list: any type

    bool is_list() const { return type == Type::list; }
    /// The type of the value, or the type of each value of a list; list: any type.
    Type single() const { return is_list() ? of : type; }
};

const std::vector<NamedChoice<Type>>& single_types() {
    static const std::vector<NamedChoice<Type>> types = {
        {"path", Type::path, ""},     {"text", Type::text, ""},    {"integer", Type::integer, ""},
        {"number", Type::number, ""}, {"bool", Type::boolean, ""}, {"ratio", Type::ratio, ""},
        {"length", Type::length, ""}, {"angle", Type::angle, ""},  {"choice", Type::choice, ""}};
    return types;
}

Declaration param_declaration() {
    auto types = single_types();
    types.push_back({"list", Type::list, ""});
    Declare<ParamOptions> d;
    d.choice("type", &ParamOptions::type, types, "The type of the value").required().primary();
    d.choice("of", &ParamOptions::of, single_types(),
             "The type of each value of a list. By default, it follows from the text of the value");
    d.option("help", &ParamOptions::help, "The purpose of the parameter");
    d.option("required", &ParamOptions::required, "Whether it must be given");
    d.option("min", &ParamOptions::min, "The least value");
    d.option("max", &ParamOptions::max, "The greatest value");
    d.option("choices", &ParamOptions::choices, "The values of a choice");
    return std::move(d.declaration);
}

/// Checks the value by the type T; returns the number to which min and max apply.
template <class T>
std::optional<double> checked(const Value& value, bool& good, Problems& problems) {
    T out{};
    good = OptionType<T>::parse(value, out, problems);
    return good && !value.deferred ? OptionType<T>::magnitude(out) : std::nullopt;
}

std::optional<double> checked(Type type, const Value& value, bool& good, Problems& problems) {
    switch (type) {
    case Type::path:
        return checked<PathText>(value, good, problems);
    case Type::integer:
        return checked<std::int64_t>(value, good, problems);
    case Type::number:
        return checked<double>(value, good, problems);
    case Type::boolean:
        return checked<bool>(value, good, problems);
    case Type::ratio:
        return checked<Ratio>(value, good, problems);
    case Type::length:
        return checked<Length>(value, good, problems);
    case Type::angle:
        return checked<Angle>(value, good, problems);
    case Type::text:
    case Type::choice:
    case Type::list: // a value of any type
        break;
    }
    return checked<std::string>(value, good, problems);
}

/// Converts a path from the command line, or from a file in that folder, to the pipeline file's convention.
/// The result is relative to the pipeline if that is the same file, otherwise absolute.
std::string from_working_directory(const std::string& text, const fs::path& folder_of_text,
                                   const PlanSettings& settings) {
    const fs::path given(text);
    if (text == "-" || text.empty() || given.is_absolute()) return text;
    const fs::path here =
        fs::absolute(settings.working_directory / folder_of_text / given).lexically_normal();
    // Empty if the pipeline's file has no folder; absolute() refuses empty paths.
    const fs::path folder = settings.working_directory / settings.places.input_base;
    const fs::path base = (folder.empty() ? fs::current_path() : fs::absolute(folder)).lexically_normal();
    const fs::path near = here.lexically_relative(base);
    std::error_code ignored;
    const bool same_file =
        !near.empty() && (!fs::exists(here, ignored) || fs::equivalent(base / near, here, ignored));
    return same_file ? near.generic_string() : here.generic_string();
}

/// Parses a list from -D or a table cell: "50%, 10%", or in YAML syntax, "[50%, 10%]".
Value list_of_text(const std::string& text, const Mark& mark, Problems& problems) {
    Value list = Value::list({}, mark);
    if (text.starts_with('[')) {
        Problems found;
        list = parse_yaml(std::make_shared<const SourceText>(SourceText{"", text}), found);
        list.mark = mark;
        for (auto& item : list.items) {
            const std::size_t at = item.mark.column > 0 ? static_cast<std::size_t>(item.mark.column) - 1 : 0;
            item.mark = mark_within(mark, item.text, at);
        }
        for (const auto& d : found.all())
            problems.add(mark, d.id, d.message, "a list is [50%, 10%], or 50%,10%");
        list.deferred = found.any_errors();
        return list;
    }
    for (const std::string_view one : split_at_commas(text)) {
        const auto at = static_cast<std::size_t>(one.data() - text.data());
        list.items.push_back(Value::scalar(std::string(one), mark_within(mark, one, at)));
    }
    return list;
}

class Params {
  public:
    /// given: a map of values that are not from a command line, or null.
    Params(const PlanSettings& settings, const Value* given, Problems& problems)
        : settings_(settings), given_(given), problems_(problems) {}

    void add(const Value::Entry& entry, Json& json) {
        if (!is_variable_name(entry.key))
            problems_.add(entry.key_mark, "E-PARAM",
                          fmt::format("'{}' cannot be the name of a param", entry.key),
                          "a name consists of letters, digits, _ and -, and begins with a letter");
        static const Declaration declaration = param_declaration();
        ParamOptions options;
        const bool good = declaration.parse(entry.value, &options, entry.key, problems_, {"default"}) &&
                          check_declaration(entry, options);
        Variable variable{entry.key, {}, {}, false};
        Json shown;
        if (good)
            variable.value = value(entry, options, shown);
        else
            variable.value.deferred = true; // already reported
        if (good)
            variable.comparable = [this_entry = entry, options](const Value& value, Problems& problems) {
                return comparable(this_entry, options, value, problems);
            };
        json[entry.key] = std::move(shown);
        scope.push_back(std::move(variable));
    }

    Scope scope;

  private:
    /// Reports limits that the type does not support, or that no value can satisfy.
    bool check_declaration(const Value::Entry& entry, const ParamOptions& options) {
        const auto place = [&](const char* key) {
            const Value::Entry* found = entry.value.is_map() ? entry.value.find_entry(key) : nullptr;
            return found ? found->key_mark : entry.key_mark;
        };
        bool good = true;
        const auto refuse = [&](const char* key, std::string message, std::string hint) {
            problems_.add(place(key), "E-PARAM", std::move(message), std::move(hint));
            good = false;
        };
        const Type single = options.single();
        if (!options.is_list() && entry.value.is_map() && entry.value.find("of"))
            refuse("of", fmt::format("'{}' is a single value, so it cannot have 'of'", entry.key),
                   "type: list");
        if (!options.choices.empty() && single != Type::choice)
            refuse("choices", fmt::format("'{}' has choices, but its type is not choice", entry.key),
                   options.is_list() ? "of: choice" : "type: choice");
        const bool limited = single != Type::text && single != Type::path && single != Type::boolean &&
                             single != Type::choice && single != Type::list;
        for (const auto& [key, limit] : {std::pair{"min", &options.min}, std::pair{"max", &options.max}})
            if (*limit && !limited)
                refuse(key,
                       fmt::format("values of '{}' have no order, so {} cannot limit them", entry.key, key),
                       options.is_list() ? "leave it out, or write of: number"
                                         : "leave it out, or write type: number");
        if (!good || !options.min || !options.max) return good;
        bool readable = true;
        const auto min = checked(single, Value::scalar(*options.min, place("min")), readable, problems_);
        const auto max = checked(single, Value::scalar(*options.max, place("max")), readable, problems_);
        if (min && max && *min > *max)
            refuse(
                "min",
                fmt::format("no value of '{}' is between {} and {}", entry.key, *options.min, *options.max),
                "exchange min and max");
        return good && readable;
    }

    Value value(const Value::Entry& entry, const ParamOptions& options, Json& shown) {
        Value out;
        const Value* default_value = entry.value.is_map() ? entry.value.find("default") : nullptr;
        if (const Value* value = given_ ? given_->find(entry.key) : nullptr) {
            out = *value;
            shown = value_json(out);
        } else if (const auto* define = given_ ? nullptr : defined(entry.key)) {
            out = defined_value(*define, options);
            shown = value_json(out);
            if (options.single() == Type::path) rebase_defined(entry.key, out);
        } else if (default_value && !default_value->is_null()) {
            out = resolved(*default_value, scope, problems_);
            shown = value_json(out);
        } else if (!settings_.parameters_needed) {
            out.deferred = true;
        } else if (options.required || !entry.value.is_map() || !entry.value.find("required")) {
            problems_.add(entry.key_mark, "E-PARAM", fmt::format("the param '{}' has no value", entry.key),
                          way_to_give(entry.key) + (options.help.empty() ? "" : " (" + options.help + ")"));
            out.deferred = true;
        } else {
            return out;
        }
        if (options.is_list()) make_list(out, options);
        check(entry, options, out);
        return out;
    }

    Value defined_value(const std::pair<std::string, std::string>& define, const ParamOptions& options) {
        const auto& [name, text] = define;
        if (const auto list = settings_.defined_lists.find(name); list != settings_.defined_lists.end())
            return list->second;
        const Mark mark = mark_of_define(settings_, name, text, name.size() + 1);
        return options.is_list() ? list_of_text(text, mark, problems_)
                                 : Value::scalar(text, mark, options.type == Type::text);
    }

    /// Adjusts paths that are not relative to this pipeline.
    void rebase_defined(const std::string& name, Value& value) const {
        for (auto& item : value.items) rebase_defined(name, item);
        if (!value.is_scalar()) return;
        const auto folder = settings_.defined_in.find(name);
        value.text = from_working_directory(
            value.text, folder == settings_.defined_in.end() ? fs::path() : folder->second, settings_);
    }

    /// A single value becomes a list of one, like in options with lists.
    static void make_list(Value& value, const ParamOptions& options) {
        if (value.is_scalar() && !value.deferred) value = Value::list({value}, value.mark);
        if (options.of == Type::text)
            for (auto& item : value.items) item.quoted = true;
    }

    std::string way_to_give(const std::string& name) const {
        return given_ ? fmt::format("give it where the file is included, with: {{{}: ...}}", name)
                      : fmt::format("give it with -D {}=...", name);
    }

    void check(const Value::Entry& entry, const ParamOptions& options, Value& value) {
        if (!options.is_list() || value.deferred) return check_single(entry, options, value);
        if (!value.is_list()) {
            value.deferred = true;
            wrong_type(value, "a list ([a, b])", problems_);
            return;
        }
        for (auto& item : value.items) check_single(entry, options, item);
    }

    void check_single(const Value::Entry& entry, const ParamOptions& options, Value& value) {
        const Type type = options.single();
        bool good = true;
        const auto magnitude = checked(type, value, good, problems_);
        if (type == Type::choice) good = good && is_choice(entry, options, value, problems_);
        if (!good) value.deferred = true; // already reported
        Range range;
        for (auto [text, limit] : {std::pair{&options.min, &range.min}, std::pair{&options.max, &range.max}})
            if (*text) {
                bool limit_good = true;
                *limit = checked(type, Value::scalar(**text, entry.key_mark), limit_good, problems_);
            }
        if (!magnitude || range.holds(*magnitude)) return;
        const std::string bounds = options.min && options.max
                                       ? fmt::format("between {} and {}", *options.min, *options.max)
                                   : options.min ? fmt::format("at least {}", *options.min)
                                                 : fmt::format("at most {}", *options.max);
        problems_.add(
            value.mark, "E-RANGE",
            fmt::format("the param '{}' must be {}, found {}", entry.key, bounds, value.described()));
    }

    static std::optional<Comparable> comparable(const Value::Entry& entry, const ParamOptions& options,
                                                const Value& value, Problems& problems) {
        if (options.is_list()) {
            if (value.is_list())
                problems.add(value.mark, "E-WHEN",
                             fmt::format("'{}' is a list, which cannot be compared", entry.key),
                             "compare a param of one value");
            return {};
        }
        if (options.type == Type::choice && !is_choice(entry, options, value, problems)) return {};
        if (options.type == Type::length) {
            Length length;
            if (!OptionType<Length>::parse(value, length, problems)) return {};
            const char* kinds[] = {"scene units", "metres", "percent"};
            return Comparable{length.amount, kinds[static_cast<int>(length.kind)]};
        }
        bool good = true;
        const auto number = checked(options.type, value, good, problems);
        if (!good) return {};
        return Comparable{number, ""};
    }

    static bool is_choice(const Value::Entry& entry, const ParamOptions& options, const Value& value,
                          Problems& problems) {
        if (options.choices.empty()) {
            problems.add(entry.key_mark, "E-PARAM", fmt::format("the choice '{}' needs choices", entry.key),
                         "choices: [a, b]");
            return false;
        }
        if (value.deferred ||
            std::find(options.choices.begin(), options.choices.end(), value.text) != options.choices.end())
            return true;
        problems.add(value.mark, "E-CHOICE",
                     fmt::format("'{}' must be one of {}, found {}", entry.key,
                                 fmt::join(options.choices, ", "), value.described()),
                     did_you_mean(value.text, options.choices));
        return false;
    }

    const std::pair<std::string, std::string>* defined(const std::string& name) const {
        for (const auto& define : settings_.defines)
            if (define.first == name) return &define;
        return nullptr;
    }

    const PlanSettings& settings_;
    const Value* given_;
    Problems& problems_;
};

/// Adds the params of a document.
void add_params(const Value* params, Params& all, Json& json, Problems& problems) {
    if (!params || params->is_null()) return;
    if (!params->is_map())
        problems.add(params->mark, "E-TYPE",
                     fmt::format("params is a map of names to declarations, found {}", params->described()),
                     "params: {keep: {type: ratio, default: 10%}}");
    for (const auto& entry : params->entries) all.add(entry, json);
}

std::string no_such_param(const std::string& name, const Scope& scope) {
    std::vector<std::string> names;
    for (const auto& variable : scope) names.push_back(variable.name);
    return names.empty() ? "it declares none" : suggestion(name, names);
}

/// Refuses repeated values, because the intended one is unknown.
void refuse_repeated(const PlanSettings& settings, Problems& problems) {
    std::map<std::string, std::string> first;
    for (const auto& [name, text] : settings.defines)
        if (const auto [known, is_new] = first.emplace(name, text); !is_new)
            problems.add(mark_of_define(settings, name, text, 0), "E-PARAM",
                         fmt::format("the param '{}' is given twice", name),
                         fmt::format("it was '{}' before; leave one out", known->second));
}

} // namespace

void add_preset(const fs::path& file, PlanSettings& settings, Problems& problems) {
    const auto input = io::Input::open(file);
    const Value all = parse_yaml(std::make_shared<const SourceText>(SourceText{
                                     file.generic_string(), std::string(io::as_text(input.bytes()))}),
                                 problems);
    settings.others.push_back({file, {}, false, {}, true});
    if (!all.is_map() && !all.is_null())
        problems.add(all.mark, "E-TYPE",
                     fmt::format("a preset is a map of params to values, found {}", all.described()),
                     "keep: 10%");
    for (const auto& entry : all.entries) {
        const auto& name = entry.key;
        const Value& value = entry.value;
        const Mark& mark = entry.key_mark;
        const auto is_it = [&](const auto& define) { return define.first == name; };
        if (std::any_of(settings.defines.begin(), settings.defines.end(), is_it)) continue;
        if (value.is_map() || value.is_null())
            problems.add(value.mark.known() ? value.mark : mark, "E-TYPE",
                         fmt::format("a param is a value or a list of them, found {}", value.described()));
        settings.defines.emplace_back(name, value.is_list() ? emit_flow(value) : value.text);
        if (value.is_list()) settings.defined_lists[name] = value;
        settings.defined_at[name] = value.mark.known() ? value.mark : mark;
        settings.defined_in[name] = file.parent_path();
    }
}

std::vector<std::string> single_param_types() {
    std::vector<std::string> names;
    for (const auto& type : single_types()) names.push_back(type.name);
    return names;
}

Scope read_params(const Value* params, const PlanSettings& settings, Json& json, Problems& problems) {
    Params all(settings, nullptr, problems);
    add_params(params, all, json, problems);
    for (const auto& [name, text] : settings.defines)
        if (!find_variable(all.scope, name))
            problems.add(mark_of_define(settings, name, text, 0), "E-PARAM",
                         fmt::format("the pipeline has no param '{}'", name), no_such_param(name, all.scope));
    refuse_repeated(settings, problems);
    return std::move(all.scope);
}

Scope fragment_params(const Value& document, const Value& given, const PlanSettings& settings,
                      Problems& problems) {
    Params all(settings, &given, problems);
    Json unused;
    add_params(document.find("params"), all, unused, problems);
    for (const auto& entry : given.entries)
        if (!find_variable(all.scope, entry.key))
            problems.add(entry.key_mark, "E-PARAM",
                         fmt::format("the included file has no param '{}'", entry.key),
                         no_such_param(entry.key, all.scope));
    return std::move(all.scope);
}

} // namespace facetmill::pipeline
