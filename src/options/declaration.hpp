#pragma once
// Declares options. A stage writes
//
//   struct RelaxOptions { std::int64_t iterations = 1; double lambda = 1; Method method = Method::laplacian;
//   }; void declare(Declare<RelaxOptions>& d) { d.option("iterations", &RelaxOptions::iterations, "How many
//   times ...").at_least(1).primary(); d.option("lambda", &RelaxOptions::lambda, "How far ...").between(0,
//   1); d.choice("method", &RelaxOptions::method, {{"laplacian", Method::laplacian, "The mean ..."}, ...},
//   "Which ..."); d.group("plane", &RelaxOptions::plane, "The plane ...", [](Declare<Plane>& p) { ... });
//   d.at_most_one({"ratio", "faces"}); }
//
// and parsing, the one-liner, help, man page, JSON Schema and the sweep test follow. Defaults are the
// members' initialisers, so they are written once.

#include "base/function.hpp"
#include "options/synonyms.hpp"
#include "options/types.hpp"

#include <cstddef>
#include <set>

namespace facetmill {

struct Choice {
    std::string name, help;
};

struct Declaration;

/// The complete declaration of an option, for every consumer. (Copies and destructors of these structs are
/// compiled once, in declaration.cpp, rather than by every stage.)
struct Option {
    Option();
    Option(const Option&);
    Option(Option&&) noexcept;
    Option& operator=(const Option&);
    Option& operator=(Option&&) noexcept;
    ~Option();

    std::string name;
    OptionKind kind = OptionKind::text;
    OptionKind one =
        OptionKind::text; ///< the kind of a single value, if several may be given; otherwise the kind
    Dimension dimension = Dimension::none;
    std::string help;         ///< one or two sentences, with the unit if the number has one
    std::string default_text; ///< the default as text; empty if unset
    bool required = false;
    bool primary = false;    ///< a bare value sets it
    bool repeatable = false; ///< takes a list
    Range range;
    std::vector<Choice> choices;
    std::shared_ptr<const Declaration> fields; ///< the declaration of a group
    Json schema;
    /// Reads the value into this option's member of the struct at target. False if it added problems. The
    /// range is checked by Declaration::parse.
    Function<bool(const Option&, const Value&, void* target, Problems&)> parse;
    /// The number in the struct that the range limits, if there is one.
    Function<std::optional<double>(const void* target)> magnitude;
    std::vector<Synonyms> synonyms; ///< its names in other programs
    bool may_be_true = false;       ///< true is one of its values, besides other kinds

    /// Whether a value may be a list, because several are allowed or because a value is a list.
    bool may_be_list() const;
};

/// The short form of a group that is neither a map nor the value of its primary option.
enum class ShortForm {
    none,
    truth,       ///< true or false: switches the group on or off
    number,      ///< a number
    list,        ///< a list, or a single word of it
    text_or_list ///< a text in a special syntax, or a list
};

/// A rule over several options.
struct Exclusion {
    enum class Rule { at_most_one, exactly_one, at_least_one };
    Rule rule;
    std::vector<std::string> names;
};

/// The options of a stage (or of a nested group), type-erased.
struct Declaration {
    Declaration();
    Declaration(const Declaration&);
    Declaration(Declaration&&) noexcept;
    Declaration& operator=(const Declaration&);
    Declaration& operator=(Declaration&&) noexcept;
    ~Declaration();

    std::vector<Option> options;
    std::vector<Exclusion> exclusions;
    /// Reads a value that is not a map (empty: the primary option reads it). For groups with a short form,
    /// "z=0.2".
    Function<bool(const Value&, void* target, Problems&)> shorthand;
    ShortForm short_form = ShortForm::none; ///< the form that shorthand reads
    std::string shorthand_help;
    Json shorthand_schema;

    const Option* find(std::string_view name) const;
    const Option* primary() const;
    std::vector<std::string> names() const;
    std::vector<KnownName> known_names() const; ///< names for hints
    Json schema() const;

    /// Reads a stage's value into the options struct at target: null keeps the defaults, and a map sets
    /// options by name. Other values go to the shorthand or the primary option. owner: the name for
    /// messages, "clip" or "clip: plane". Keys in also_known are skipped (the common keys). False if it
    /// added problems.
    bool parse(const Value& value, void* target, std::string_view owner, Problems& problems,
               const std::set<std::string>& also_known = {}) const;
};

/// Refines the option declared last.
class OptionRef {
  public:
    OptionRef(Declaration& owner, std::size_t index) : owner_(&owner), index_(index) {}
    OptionRef& between(double min, double max) {
        range().min = min;
        range().max = max;
        return *this;
    }
    OptionRef& at_least(double min) {
        range().min = min;
        return *this;
    }
    OptionRef& at_most(double max) {
        range().max = max;
        return *this;
    }
    OptionRef& above(double min) {
        range().min = min;
        range().min_open = true;
        return *this;
    }
    OptionRef& below(double max) {
        range().max = max;
        range().max_open = true;
        return *this;
    }
    OptionRef& required() {
        option().required = true;
        option().default_text.clear();
        return *this;
    }
    OptionRef& primary() {
        option().primary = true;
        return *this;
    }
    /// Sets the dimension of a number whose type does not imply it: a double that is a count, an integer
    /// that is bytes.
    OptionRef& measures(Dimension dimension) {
        option().dimension = dimension;
        return *this;
    }
    /// Sets names in other programs, separated by blanks. how: the text to write, if the name alone does not
    /// show it.
    OptionRef& also_called(std::string_view words, std::string_view how = {}) {
        option().synonyms.push_back({std::string(words), std::string(how)});
        return *this;
    }
    Option& option() { return owner_->options[index_]; }

  private:
    Range& range() { return option().range; }
    Declaration* owner_;
    std::size_t index_;
};

template <class E>
struct NamedChoice {
    std::string name;
    E value;
    std::string help;
};

[[nodiscard]] Json choice_schema(const std::vector<Choice>& choices);
/// The index of the option's choice that the value names (0 for a deferred value). If invalid, adds a
/// problem and returns none.
[[nodiscard]] std::optional<std::size_t> choice_index(const Option& option, const Value& value,
                                                      Problems& problems);

/// The offset in bytes of a member in the object. Only the offset of a member is stored, so that the code
/// that reads it is compiled once per type, not once per member.
template <class S, class T>
[[nodiscard]] std::size_t offset_of(const S& object, T S::*member) {
    const auto address = [](const auto& thing) {
        return reinterpret_cast<const std::byte*>(std::addressof(thing));
    };
    return static_cast<std::size_t>(address(object.*member) - address(object));
}

/// The T at the offset in a record.
template <class T>
T& member_at(void* record, std::size_t offset) {
    return *reinterpret_cast<T*>(static_cast<std::byte*>(record) + offset);
}
template <class T>
const T& member_at(const void* record, std::size_t offset) {
    return *reinterpret_cast<const T*>(static_cast<const std::byte*>(record) + offset);
}

/// Adds an option to a declaration.
Option& start_option(Declaration& owner, std::string_view name, OptionKind kind, std::string_view help);
/// Moves the declaration into shared ownership.
[[nodiscard]] std::shared_ptr<const Declaration> shared(Declaration&& declaration);
/// Adds the options of a struct at this offset in the parsed struct.
void embed_options(Declaration& owner, const Declaration& inner, std::size_t offset);

/// Adds an option whose value is the T at the offset. Its current value is the default.
template <class T>
void typed_option(Declaration& owner, std::string_view name, std::size_t offset, const T& now,
                  std::string_view help) {
    using Type = OptionType<T>;
    Option& o = start_option(owner, name, Type::kind, help);
    o.one = kind_of_one<T>;
    o.dimension = Type::dimension;
    o.default_text = Type::print(now);
    o.schema = Type::schema();
    o.repeatable = Type::kind == OptionKind::list;
    o.parse = [offset](const Option&, const Value& v, void* target, Problems& problems) {
        return Type::parse(v, member_at<T>(target, offset), problems);
    };
    o.magnitude = [offset](const void* target) { return Type::magnitude(member_at<T>(target, offset)); };
}

// The types that most options have are compiled once, in declaration.cpp.
#define FACETMILL_COMMON_OPTION_TYPES(X)                                                                     \
    X(bool)                                                                                                  \
    X(double)                                                                                                \
    X(std::int64_t)                                                                                          \
    X(std::string)                                                                                           \
    X(std::optional<double>)                                                                                 \
    X(std::optional<std::int64_t>)                                                                           \
    X(std::optional<std::string>)                                                                            \
    X(std::optional<Length>)                                                                                 \
    X(std::optional<Vec3>)                                                                                   \
    X(std::vector<double>)
#define FACETMILL_ELSEWHERE(T)                                                                               \
    extern template void typed_option<T>(Declaration&, std::string_view, std::size_t, const T&,              \
                                         std::string_view);
FACETMILL_COMMON_OPTION_TYPES(FACETMILL_ELSEWHERE)
#undef FACETMILL_ELSEWHERE

/// Fills a Declaration for the options struct S.
template <class S>
class Declare {
  public:
    Declaration declaration;

    explicit Declare(const S& defaults = {}) : defaults_(defaults) {}

    template <class T>
    OptionRef option(std::string_view name, T S::*member, std::string_view help) {
        typed_option<T>(declaration, name, offset_of(defaults_, member), defaults_.*member, help);
        return last();
    }

    template <class E>
    OptionRef choice(std::string_view name, E S::*member, const std::vector<NamedChoice<E>>& choices,
                     std::string_view help) {
        Option& o = start_option(declaration, name, OptionKind::choice, help);
        std::vector<E> values;
        for (const auto& c : choices) {
            if (c.value == defaults_.*member) o.default_text = c.name;
            o.choices.push_back({c.name, c.help});
            values.push_back(c.value);
        }
        o.schema = choice_schema(o.choices);
        o.parse = [at = offset_of(defaults_, member), values](const Option& self, const Value& v,
                                                              void* target, Problems& problems) {
            const auto index = choice_index(self, v, problems);
            if (index) member_at<E>(target, at) = values[*index];
            return index.has_value();
        };
        return last();
    }

    /// A nested struct G (or std::optional<G>), declared by fill(Declare<G>&).
    template <class M, class Fill>
    OptionRef group(std::string_view name, M S::*member, std::string_view help, Fill fill) {
        using G = typename Inner<M>::type;
        Declare<G> nested;
        fill(nested);
        Option& o = start_option(declaration, name, OptionKind::group, help);
        if constexpr (requires { OptionType<G>::kind; })
            o.one = OptionType<G>::kind; // for lists, the kind of a single value
        o.fields = shared(std::move(nested.declaration));
        o.schema = o.fields->schema();
        o.parse = [at = offset_of(defaults_, member)](const Option& self, const Value& v, void* target,
                                                      Problems& problems) {
            M& slot = member_at<M>(target, at);
            if constexpr (Inner<M>::optional)
                return self.fields->parse(v, &slot.emplace(), self.name, problems);
            else
                return self.fields->parse(v, &slot, self.name, problems);
        };
        return last();
    }

    /// Adds the options of a struct within S as if they were members of S. fill(Declare<G>&) declares them.
    template <class G, class Fill>
    void embed(G S::*member, Fill fill) {
        Declare<G> inner(defaults_.*member);
        fill(inner);
        embed_options(declaration, inner.declaration, offset_of(defaults_, member));
    }

    /// Sets how a group reads a value that is not a map.
    template <class Parse>
    void shorthand(ShortForm form, std::string_view help, Json schema, Parse parse) {
        declaration.short_form = form;
        declaration.shorthand_help = help;
        declaration.shorthand_schema = std::move(schema);
        declaration.shorthand = [parse](const Value& v, void* target, Problems& problems) {
            return parse(v, *static_cast<S*>(target), problems);
        };
    }

    void at_most_one(std::vector<std::string> names) { rule(Exclusion::Rule::at_most_one, std::move(names)); }
    void exactly_one(std::vector<std::string> names) { rule(Exclusion::Rule::exactly_one, std::move(names)); }
    void at_least_one(std::vector<std::string> names) {
        rule(Exclusion::Rule::at_least_one, std::move(names));
    }

  private:
    template <class M>
    struct Inner {
        using type = M;
        static constexpr bool optional = false;
    };
    template <class G>
    struct Inner<std::optional<G>> {
        using type = G;
        static constexpr bool optional = true;
    };

    OptionRef last() { return {declaration, declaration.options.size() - 1}; }
    void rule(Exclusion::Rule r, std::vector<std::string> names) {
        declaration.exclusions.push_back({r, std::move(names)});
    }

    const S defaults_;
};

} // namespace facetmill
