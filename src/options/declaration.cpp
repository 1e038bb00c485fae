#include "options/declaration.hpp"

#include "base/math/numbers.hpp"
#include "base/text/plain_number.hpp"
#include "base/text/spelling.hpp"
#include "options/mark_at.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace facetmill {

bool Range::holds(double x) const {
    if (min && (min_open ? !(x > *min) : !(x >= *min))) return false;
    if (max && (max_open ? !(x < *max) : !(x <= *max))) return false;
    return true;
}

std::string Range::to_string() const {
    const auto number = plain_number;
    if (min && max)
        return fmt::format("{} {} x {} {}", number(*min),
                           min_open ? "<" : "<=", max_open ? "<" : "<=", number(*max));
    if (min) return fmt::format("x {} {}", min_open ? ">" : ">=", number(*min));
    if (max) return fmt::format("x {} {}", max_open ? "<" : "<=", number(*max));
    return {};
}

Option::Option() = default;
Option::Option(const Option&) = default;
Option::Option(Option&&) noexcept = default;
Option& Option::operator=(const Option&) = default;
Option& Option::operator=(Option&&) noexcept = default;
Option::~Option() = default;

Declaration::Declaration() = default;
Declaration::Declaration(const Declaration&) = default;
Declaration::Declaration(Declaration&&) noexcept = default;
Declaration& Declaration::operator=(const Declaration&) = default;
Declaration& Declaration::operator=(Declaration&&) noexcept = default;
Declaration::~Declaration() = default;

bool Option::may_be_list() const {
    if (facetmill::may_be_list(kind)) return true;
    if (!fields) return false;
    const Option* primary = fields->primary();
    return fields->short_form == ShortForm::list || fields->short_form == ShortForm::text_or_list ||
           (primary && primary->may_be_list());
}

Option& start_option(Declaration& owner, std::string_view name, OptionKind kind, std::string_view help) {
    Option& o = owner.options.emplace_back();
    o.name = name;
    o.kind = o.one = kind;
    o.help = help;
    return o;
}

std::shared_ptr<const Declaration> shared(Declaration&& declaration) {
    return std::make_shared<const Declaration>(std::move(declaration));
}

void embed_options(Declaration& owner, const Declaration& inner, std::size_t offset) {
    for (Option o : inner.options) {
        o.parse = [parse = std::move(o.parse), offset](const Option& self, const Value& v, void* target,
                                                       Problems& problems) {
            return parse(self, v, &member_at<std::byte>(target, offset), problems);
        };
        if (o.magnitude)
            o.magnitude = [magnitude = std::move(o.magnitude), offset](const void* target) {
                return magnitude(&member_at<std::byte>(target, offset));
            };
        owner.options.push_back(std::move(o));
    }
}

#define FACETMILL_HERE(T)                                                                                    \
    template void typed_option<T>(Declaration&, std::string_view, std::size_t, const T&, std::string_view);
FACETMILL_COMMON_OPTION_TYPES(FACETMILL_HERE)
#undef FACETMILL_HERE

const Option* Declaration::find(std::string_view name) const {
    const auto it =
        std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.name == name; });
    return it == options.end() ? nullptr : &*it;
}

const Option* Declaration::primary() const {
    const auto it = std::find_if(options.begin(), options.end(), [](const auto& o) { return o.primary; });
    return it == options.end() ? nullptr : &*it;
}

std::vector<std::string> Declaration::names() const {
    std::vector<std::string> all;
    for (const auto& o : options) all.push_back(o.name);
    return all;
}

std::vector<KnownName> Declaration::known_names() const {
    std::vector<KnownName> all;
    for (const auto& o : options) all.push_back({o.name, o.synonyms});
    return all;
}

namespace {

/// A default as a value of its type, null for defaults that are not a single value.
Json default_json(const Option& option) {
    const std::string& text = option.default_text;
    if (text.empty() || text.starts_with('[') || text.starts_with('{')) return nullptr;
    if (option.kind == OptionKind::boolean) return text == "true";
    if (const auto integer = parse_integer(text)) return *integer;
    if (const auto number = parse_real(text)) return *number;
    return text;
}

/// Whether true gives a group its defaults, and false means the same as omitting it.
bool is_switch(const Option& option) {
    return option.fields && option.may_be_true && !option.fields->shorthand;
}

/// The schema of an option's value with all properties of the declaration.
Json described(const Option& option) {
    Json schema = option.schema;
    if (is_switch(option)) schema["anyOf"].push_back({{"type", "boolean"}});
    schema["description"] = option.help;
    if (Json value = default_json(option); !value.is_null()) schema["default"] = std::move(value);
    const Range& range = option.range;
    if (!range.min && !range.max) return schema;
    schema["description"] = fmt::format("{} Range: {}.", option.help, range.to_string());
    const bool number = option.kind == OptionKind::integer || option.kind == OptionKind::number;
    if (number && range.min) schema[range.min_open ? "exclusiveMinimum" : "minimum"] = *range.min;
    if (number && range.max) schema[range.max_open ? "exclusiveMaximum" : "maximum"] = *range.max;
    return schema;
}

/// At most one of these names may be given: each forbids the others, so that an editor marks them.
void add_conflicts(const std::vector<std::string>& names, Json& object) {
    for (const auto& name : names)
        for (const auto& other : names)
            if (name != other) object["dependentSchemas"][name]["properties"][other] = false;
}

/// A schema that requires at least one of the names. Each form names its property, as strict validators
/// require.
Json any_of_these(const std::vector<std::string>& names) {
    Json forms = Json::array();
    for (const auto& name : names)
        forms.push_back({{"properties", {{name, true}}}, {"required", Json::array({name})}});
    return {{"anyOf", std::move(forms)}};
}

bool is_map(const Json& schema) { return schema.contains("type") && schema["type"] == "object"; }

/// The schema of a bare value of the primary option: without maps, because a map gives the options by their
/// names.
Json without_maps(Json schema) {
    if (!schema.contains("anyOf")) return schema;
    Json forms = Json::array();
    for (auto& form : schema["anyOf"])
        if (!is_map(form)) forms.push_back(without_maps(std::move(form)));
    schema["anyOf"] = std::move(forms);
    return schema;
}

} // namespace

Json Declaration::schema() const {
    Json object = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    Json required = Json::array();
    for (const auto& o : options) {
        object["properties"][o.name] = described(o);
        if (o.required) required.push_back(o.name);
    }
    if (!required.empty()) object["required"] = required;
    for (const auto& rule : exclusions) {
        if (rule.rule != Exclusion::Rule::at_least_one) add_conflicts(rule.names, object);
        if (rule.rule != Exclusion::Rule::at_most_one) object["allOf"].push_back(any_of_these(rule.names));
    }
    Json forms = Json::array({object});
    if (!shorthand_schema.is_null()) forms.push_back(shorthand_schema);
    if (const Option* o = primary(); o && !is_map(o->schema)) forms.push_back(without_maps(o->schema));
    return forms.size() == 1 ? object : Json{{"anyOf", forms}};
}

Json choice_schema(const std::vector<Choice>& choices) {
    Json names = Json::array();
    for (const auto& c : choices) names.push_back(c.name);
    return {{"enum", names}};
}

namespace {

std::vector<std::string> names_of_choices(const Option& option) {
    std::vector<std::string> names;
    for (const auto& c : option.choices) names.push_back(c.name);
    return names;
}

void refuse_choice(const Option& option, const Value& value, std::string hint, Problems& problems) {
    problems.add(value.mark, "E-CHOICE",
                 fmt::format("'{}' must be one of {}, found {}", option.name,
                             fmt::join(names_of_choices(option), ", "), value.described()),
                 std::move(hint));
}

} // namespace

std::optional<std::size_t> choice_index(const Option& option, const Value& value, Problems& problems) {
    if (value.deferred) return 0;
    const std::vector<std::string> names = names_of_choices(option);
    if (value.is_scalar())
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i] == value.text) return i;
    const bool near = value.is_scalar() && !nearest(value.text, names).empty();
    refuse_choice(option, value, near ? suggestion(value.text, names) : "", problems);
    return {};
}

namespace {

/// Reads an option and checks its range.
bool parse_option(const Option& option, const Value& value, void* target, Problems& problems) {
    if (const auto on = is_switch(option) ? value.as_bool() : std::nullopt)
        return !*on || option.parse(option, Value::map({}, value.mark), target, problems);
    if (!option.parse(option, value, target, problems)) return false;
    const auto magnitude = option.magnitude ? option.magnitude(target) : std::nullopt;
    if (value.deferred || !magnitude || option.range.holds(*magnitude)) return true;
    problems.add(value.mark, "E-RANGE",
                 fmt::format("'{}' must be in the range {}, found {}", option.name, option.range.to_string(),
                             value.described()));
    return false;
}

bool check_exclusion(const Exclusion& rule, const Value& map, std::string_view owner, Problems& problems) {
    std::vector<std::string> given;
    for (const auto& e : map.entries)
        if (std::find(rule.names.begin(), rule.names.end(), e.key) != rule.names.end())
            given.push_back(e.key);
    if (given.size() > 1 && rule.rule != Exclusion::Rule::at_least_one) {
        add_refusal(Refusal{given[1], fmt::format("only one of {} may be given, found {}",
                                                  fmt::join(rule.names, ", "), fmt::join(given, " and "))},
                    owner, map, problems);
        return false;
    }
    if (given.empty() && rule.rule != Exclusion::Rule::at_most_one) {
        problems.add(map.mark, "E-MISSING",
                     fmt::format("{}: one of {} is needed", owner, fmt::join(rule.names, ", ")));
        return false;
    }
    return true;
}

/// The option that has the value among its choices, if the primary option lacks it: `textures: webp`.
const Option* other_choice(const Declaration& declaration, const Option& primary, const Value& value) {
    static constexpr std::array texts{OptionKind::text, OptionKind::path, OptionKind::choice,
                                      OptionKind::list, OptionKind::group};
    if (!value.is_scalar() || std::find(texts.begin(), texts.end(), primary.kind) != texts.end())
        return nullptr;
    const auto has_it = [&](const Option& o) {
        return std::any_of(o.choices.begin(), o.choices.end(),
                           [&](const Choice& c) { return c.name == value.text; });
    };
    const auto it = std::find_if(declaration.options.begin(), declaration.options.end(), has_it);
    return it == declaration.options.end() || &*it == &primary ? nullptr : &*it;
}

/// The options that accept a number, if the bare value must be a name: `split: 2`. Empty if no option does.
std::string hint_of_number(const Declaration& declaration, const Option& primary, std::string_view owner,
                           const Value& value) {
    constexpr std::size_t most_told = 3;
    if (primary.kind != OptionKind::choice || !value.is_scalar() || !parse_integer(value.text)) return {};
    std::vector<std::string> ways;
    for (const Option& o : declaration.options)
        if (o.kind == OptionKind::integer && ways.size() < most_told)
            ways.push_back(fmt::format("{}: {{{}: {}}}", owner, o.name, value.text));
    if (ways.empty()) return {};
    const std::string last = ways.back();
    ways.pop_back();
    return fmt::format("a number needs the name of its option: {}{}{}", fmt::join(ways, ", "),
                       ways.empty() ? "" : " or ", last);
}

/// Longer lists of names are omitted, because users do not read them.
constexpr std::size_t most_listed = 24;

std::string where_listed(std::string_view owner, std::size_t names) {
    return names > most_listed ? fmt::format("facetmill stages {} lists its options", owner) : "";
}

/// The hint for a forbidden bare value, which is often the name of an option of this or another stage.
std::string hint_of_bare_value(const Declaration& declaration, std::string_view owner, const Value& value) {
    const std::vector<std::string> names = declaration.names();
    const std::vector<std::string> called = value.is_scalar()
                                                ? options_called(value.text, declaration.known_names())
                                                : std::vector<std::string>{};
    const Option* option =
        value.is_scalar() ? declaration.find(called.empty() ? value.text : called.front()) : nullptr;
    if (option)
        return fmt::format("write {}: {{{}: {}}}", owner, option->name,
                           option->kind == OptionKind::boolean ? "true" : "...");
    const std::string where = where_listed(owner, names.size());
    return where.empty() ? fmt::format("its options are: {}", fmt::join(names, ", ")) : where;
}

/// The primary option, if it accepts the share that was given to a count option: `faces: 10%`.
const Option* meant_share(const Declaration& declaration, const Option& option, const Value& value) {
    const Option* primary = declaration.primary();
    if (!primary || primary->kind != OptionKind::ratio || option.kind != OptionKind::integer ||
        !value.is_scalar())
        return nullptr;
    const auto number = parse_real(value.text);
    return value.text.ends_with('%') || (number && *number > 0 && *number < 1) ? primary : nullptr;
}

/// The map for which a bare value is short.
Value as_map(const Option& option, const Value& value) {
    return Value::map({{option.name, value.mark, value}}, value.mark);
}

} // namespace

bool Declaration::parse(const Value& value, void* target, std::string_view owner, Problems& problems,
                        const std::set<std::string>& also_known) const {
    if (value.deferred) return true;
    if (!value.is_map() && !value.is_null()) {
        if (shorthand) return shorthand(value, target, problems);
        const Option* bare = primary();
        if (const Option* o = bare ? other_choice(*this, *bare, value) : nullptr) {
            problems.add(value.mark, "E-TYPE",
                         fmt::format("a bare value of {} is its option '{}', found {}", owner, bare->name,
                                     value.described()),
                         fmt::format("{} is a value of '{}', so write that name", value.text, o->name));
            return false;
        }
        if (const std::string hint = bare ? hint_of_number(*this, *bare, owner, value) : ""; !hint.empty()) {
            refuse_choice(*bare, value, hint, problems);
            return false;
        }
        if (bare) return parse(as_map(*bare, value), target, owner, problems, also_known);
        problems.add(value.mark, "E-VALUE",
                     fmt::format("{} does not accept a bare value, found {}", owner, value.described()),
                     hint_of_bare_value(*this, owner, value));
        return false;
    }
    bool good = true;
    std::set<std::string> meant; // options that unknown names mean
    for (const auto& entry : value.entries) {
        if (also_known.contains(entry.key)) continue;
        if (const Option* o = find(entry.key)) {
            if (const Option* share = meant_share(*this, *o, entry.value)) {
                good = wrong_type(entry.value, "an integer", problems,
                                  fmt::format("a ratio sets '{0}': write {1}: {{{0}: {2}}}", share->name,
                                              owner, entry.value.text));
                continue;
            }
            good &= parse_option(*o, entry.value, target, problems);
            continue;
        }
        std::vector<KnownName> known = known_names();
        for (const auto& name : also_known) known.push_back({name});
        problems.add(entry.key_mark, "E-KEY", fmt::format("{} has no option '{}'", owner, entry.key),
                     hint_for_option(entry.key, known, where_listed(owner, known.size())));
        const std::vector<std::string> called = options_called(entry.key, known);
        meant.insert(called.begin(), called.end());
        std::vector<std::string> near = names();
        near.insert(near.end(), also_known.begin(), also_known.end());
        meant.insert(nearest(entry.key, near));
        good = false;
    }
    for (const auto& o : options)
        if (o.required && !value.find(o.name) && !meant.contains(o.name)) {
            problems.add(value.mark, "E-MISSING", fmt::format("{}: '{}' is needed", owner, o.name), o.help);
            good = false;
        }
    for (const auto& rule : exclusions) {
        const bool named = std::any_of(rule.names.begin(), rule.names.end(),
                                       [&](const std::string& name) { return meant.contains(name); });
        if (!named) good &= check_exclusion(rule, value, owner, problems);
    }
    return good;
}

} // namespace facetmill
