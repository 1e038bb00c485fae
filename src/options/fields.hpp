#pragma once
// Declares fields of results, like declaration.hpp for options. A stage writes
//
//   struct RelaxedPart { std::string part; std::size_t iterations; std::optional<double> last_move; };
//   struct RelaxReport { std::vector<RelaxedPart> parts; }; void declare_report(DeclareFields<RelaxReport>&
//   d) { d.list("parts", &RelaxReport::parts, "Each part.", [](DeclareFields<RelaxedPart>& p) {
//   p.field("part", &RelaxedPart::part, "Its name."); p.field("iterations", &RelaxedPart::iterations, "How
//   many there were."); p.field("last_move", &RelaxedPart::last_move, "The farthest move in the last of
//   them.") .unit("scene units").only_when("until is given"); }); }
//
// and the JSON of the report, its JSON Schema, the help pages and the lines on the terminal follow.

#include "base/function.hpp"
#include "base/json.hpp"
#include "base/math/vec.hpp"
#include "options/declaration.hpp"

#include <array>
#include <cmath>
#include <concepts>
#include <functional>
#include <memory>
#include <variant>

namespace facetmill {

struct Fields;

namespace fields {
/// The printable values of a phrase on the terminal.
using Printable = std::variant<std::uint64_t, std::int64_t, double, std::string>;
/// Visits the object in a record, or each item of the list. False if the record has none.
using Each = Function<bool(const void* record, const std::function<void(const void*)>& look)>;
} // namespace fields

/// The complete declaration of a field, for every consumer.
struct Field {
    Field();
    Field(const Field&);
    Field(Field&&) noexcept;
    Field& operator=(const Field&);
    Field& operator=(Field&&) noexcept;
    ~Field();

    std::string name;
    std::string type; ///< type shown to users: "count", "number", "text", "list of objects"
    std::string unit; ///< "scene units", "degrees"; empty: none
    std::string help;
    std::string null_when; ///< the meaning of null; empty: it is never null
    std::string only_when; ///< the condition for the key; empty: always present
    int optionals =
        0; ///< the number of optionals around the value; of two, an empty outer optional omits the key
    std::vector<Choice> choices;
    Json schema;                          ///< schema of a value that is not null
    std::shared_ptr<const Fields> fields; ///< fields of an object, or of the items of a list

    /// Adds the field to the object.
    Function<void(const Field&, const void* record, Json& object)> put;
    /// The field's value; none if it is empty, or neither number nor text.
    Function<std::optional<facetmill::fields::Printable>(const void* record)> value;
    /// The value as text for the terminal; none if it is not printed.
    Function<std::optional<std::string>(const void* record)> phrase;
    /// The value of a count.
    Function<std::uint64_t(const void* record)> count;
    /// Visits an object or the items of a list.
    facetmill::fields::Each each;
    bool is_list = false;
    /// For a list: the text if all counts of its items are 0. Otherwise their sums are printed by name.
    std::optional<std::string> nothing_counted;
};

/// The fields of a record in the order of the report, type-erased.
struct Fields {
    Fields();
    Fields(const Fields&);
    Fields(Fields&&) noexcept;
    Fields& operator=(const Fields&);
    Fields& operator=(Fields&&) noexcept;
    ~Fields();

    std::vector<Field> all;
    std::string heading; ///< the field whose text begins the line of a record: "part"
    /// Lines for the terminal, if phrases of single fields do not suffice.
    Function<std::vector<std::string>(const void* record)> tell;

    Json json(const void* record) const;
    /// The schema of an object with exactly these keys.
    Json schema() const;
    /// The lines for the terminal: from `tell`, or a line of the phrases and a line for each list item with
    /// phrases.
    std::vector<std::string> lines(const void* record) const;
};

namespace fields {
template <class T>
inline constexpr int optionals = 0;
template <class T>
inline constexpr int optionals<std::optional<T>> = 1 + optionals<T>;
template <class T>
inline constexpr bool is_optional = optionals<T> > 0;

template <class T>
struct Inner {
    using type = T;
};
template <class T>
struct Inner<std::optional<T>> : Inner<T> {};

/// The JSON Schemas of plain values, and of lists of plain values. may_be_null: the items may be null.
[[nodiscard]] Json schema_of_type(const char* type);
[[nodiscard]] Json schema_of_count();
[[nodiscard]] Json schema_of_list(Json items, bool may_be_null, std::optional<std::size_t> size = {});
} // namespace fields

/// The text, schema and JSON of the C++ type of a field. Each specialisation has name, schema() and json().
template <class T>
struct FieldType;

template <>
struct FieldType<bool> {
    static constexpr const char* name = "bool";
    static Json schema() { return fields::schema_of_type("boolean"); }
    static Json json(bool value) { return value; }
};

template <std::convertible_to<std::string> T>
struct FieldType<T> {
    static constexpr const char* name = "text";
    static Json schema() { return fields::schema_of_type("string"); }
    static Json json(const T& value) { return value; }
};

template <std::integral T>
struct FieldType<T> {
    static constexpr const char* name = std::is_signed_v<T> ? "integer" : "count";
    static Json schema() {
        return std::is_signed_v<T> ? fields::schema_of_type("integer") : fields::schema_of_count();
    }
    static Json json(T value) { return value; }
};

/// Null beyond the range of numbers; such a field declares it (null_when).
template <>
struct FieldType<double> {
    static constexpr const char* name = "number";
    static Json schema() { return fields::schema_of_type("number"); }
    static Json json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
};

template <>
struct FieldType<Vec3> {
    static constexpr const char* name = "vector";
    static Json schema();
    static Json json(const Vec3& p);
};

template <class T>
struct FieldType<std::vector<T>> {
    static constexpr const char* name = "list";
    static Json schema() { return fields::schema_of_list(FieldType<T>::schema(), fields::is_optional<T>); }
    static Json json(const std::vector<T>& values) {
        Json list = Json::array();
        for (const auto& value : values) list.push_back(FieldType<T>::json(value));
        return list;
    }
};

template <class T, std::size_t N>
struct FieldType<std::array<T, N>> {
    static constexpr const char* name = "list";
    static Json schema() { return fields::schema_of_list(FieldType<T>::schema(), fields::is_optional<T>, N); }
    static Json json(const std::array<T, N>& values) {
        Json list = Json::array();
        for (const auto& value : values) list.push_back(FieldType<T>::json(value));
        return list;
    }
};

template <class T>
struct FieldType<std::optional<T>> {
    static constexpr const char* name = FieldType<T>::name;
    static Json schema() { return FieldType<T>::schema(); }
    static Json json(const std::optional<T>& value) {
        return value ? FieldType<T>::json(*value) : Json(nullptr);
    }
};

/// Counts above 0, by name.
using NamedCounts = std::vector<std::pair<std::string, std::uint64_t>>;

/// Refines the field declared last.
class FieldRef {
  public:
    FieldRef(Fields& owner, std::size_t index) : owner_(&owner), index_(index) {}

    FieldRef& unit(std::string_view text);
    FieldRef& null_when(std::string_view text);
    /// For an optional value: without a value the key is omitted instead of null.
    FieldRef& only_when(std::string_view text);
    /// Begins the line of its record on the terminal.
    FieldRef& heads();
    /// Prints the value on the terminal in place of {} in the format, unless it has no value.
    FieldRef& said(std::string_view format);
    /// For a list: prints the sums of its items' counts, or `nothing` if all are 0.
    FieldRef& tallied(std::string_view nothing);
    Field& field() { return owner_->all[index_]; }

  private:
    Fields* owner_;
    std::size_t index_;
};

namespace fields {

template <class T>
inline constexpr bool is_count = std::unsigned_integral<T> && !std::same_as<T, bool>;

inline constexpr auto to_json = []<class T>(const T& value) { return FieldType<T>::json(value); };

/// Adds a field to a record. optionals: the number of optionals around its value.
Field& start(Fields& fields, std::string_view name, const char* type, Json schema, std::string_view help,
             int optionals);
/// Adds an object with these fields, or a list of such objects.
FieldRef object_field(Fields& fields, std::string_view name, std::string_view help,
                      std::shared_ptr<const Fields> inner, int optionals, Each each);
FieldRef list_field(Fields& fields, std::string_view name, std::string_view help,
                    std::shared_ptr<const Fields> inner, int optionals, Each each);
/// Adds the fields of a nested record: within() of the outer record.
void embed(Fields& fields, const Fields& inner, const Function<const void*(const void*)>& within);
/// Moves the fields into shared ownership.
[[nodiscard]] std::shared_ptr<const Fields> shared(Fields&& fields);

/// Adds a member to an object without a member of this name. The names of a record's fields differ.
void add_member(Json& object, const std::string& name, Json value);

template <class T, class ToJson>
[[nodiscard]] Json inner_json(const T& value, const ToJson& json) {
    if constexpr (is_optional<T>)
        return value ? Json(json(*value)) : Json(nullptr);
    else
        return json(value);
}

/// Sets the key of the field. An empty value becomes null or is omitted. json: converts a value that is not
/// empty.
template <class T, class ToJson>
void put_value(const Field& field, const T& value, const ToJson& json, Json& object) {
    if constexpr (is_optional<T>) {
        if (value)
            add_member(object, field.name, inner_json(*value, json));
        else if (field.only_when.empty())
            add_member(object, field.name, nullptr);
    } else {
        add_member(object, field.name, json(value));
    }
}

/// The printable value for the terminal; none if it is empty, or neither number nor text.
template <class T>
[[nodiscard]] std::optional<Printable> told_value(const T& value) {
    if constexpr (is_optional<T>)
        return value ? told_value(*value) : std::nullopt;
    else if constexpr (std::unsigned_integral<T>)
        return static_cast<std::uint64_t>(value);
    else if constexpr (std::integral<T>)
        return static_cast<std::int64_t>(value);
    else if constexpr (std::same_as<T, double>)
        return value;
    else if constexpr (std::convertible_to<T, std::string>)
        return std::string(value);
    else
        return {};
}

/// A field whose value is the T at the offset.
template <class T>
FieldRef typed_field(Fields& fields, std::string_view name, std::size_t offset, std::string_view help) {
    using Type = FieldType<typename Inner<T>::type>;
    Field& f = start(fields, name, Type::name, Type::schema(), help, optionals<T>);
    f.put = [offset](const Field& self, const void* record, Json& object) {
        put_value(self, member_at<T>(record, offset), to_json, object);
    };
    if constexpr (is_count<T>)
        f.count = [offset](const void* record) { return std::uint64_t{member_at<T>(record, offset)}; };
    f.value = [offset](const void* record) { return told_value(member_at<T>(record, offset)); };
    return {fields, fields.all.size() - 1};
}

// The types that most fields have are compiled once, in fields.cpp.
#define FACETMILL_COMMON_FIELD_TYPES(X)                                                                      \
    X(bool)                                                                                                  \
    X(double)                                                                                                \
    X(std::size_t)                                                                                           \
    X(std::string)                                                                                           \
    X(Vec3)                                                                                                  \
    X(std::optional<double>)                                                                                 \
    X(std::optional<std::size_t>)                                                                            \
    X(std::optional<std::string>)                                                                            \
    X(std::vector<std::string>)
#define FACETMILL_ELSEWHERE(T)                                                                               \
    extern template FieldRef typed_field<T>(Fields&, std::string_view, std::size_t, std::string_view);
FACETMILL_COMMON_FIELD_TYPES(FACETMILL_ELSEWHERE)
#undef FACETMILL_ELSEWHERE

} // namespace fields

/// Fills Fields for the record R. Getters are members of R or functions of it. They may return an optional:
/// an empty optional is null, or omits the key with only_when.
template <class R>
class DeclareFields {
  public:
    Fields fields;

    template <class Get>
    FieldRef field(std::string_view name, Get get, std::string_view help) {
        using T = Value<Get>;
        if constexpr (std::is_convertible_v<Get, T R::*>) {
            T R::*member = get;
            return facetmill::fields::typed_field<T>(fields, name, offset_of(R{}, member), help);
        } else {
            using Type = FieldType<typename facetmill::fields::Inner<T>::type>;
            Field& f = start<T>(name, Type::name, Type::schema(), help);
            f.put = putting(get, facetmill::fields::to_json);
            if constexpr (facetmill::fields::is_count<T>)
                f.count = [get](const void* record) {
                    return static_cast<std::uint64_t>(std::invoke(get, as_record(record)));
                };
            f.value = [get](const void* record) {
                const auto& value = std::invoke(get, as_record(record));
                return facetmill::fields::told_value(value);
            };
            return {fields, fields.all.size() - 1};
        }
    }

    /// Adds an enumeration: value, name and meaning of each choice.
    template <class Get, class E = typename facetmill::fields::Inner<
                             std::remove_cvref_t<std::invoke_result_t<Get, const R&>>>::type>
    FieldRef choice(std::string_view name, Get get, const std::vector<NamedChoice<E>>& choices,
                    std::string_view help) {
        std::vector<Choice> told;
        told.reserve(choices.size());
        for (const auto& c : choices) told.push_back({c.name, c.help});
        Json schema = choice_schema(told);
        Field& f = start<Value<Get>>(name, "choice", std::move(schema), help);
        f.choices = std::move(told);
        f.put = putting(get, [choices](const E& value) {
            for (const auto& c : choices)
                if (c.value == value) return Json(c.name);
            return Json(nullptr);
        });
        return {fields, fields.all.size() - 1};
    }

    /// Adds a nested record, declared by fill(DeclareFields<T>&).
    template <class Get, class Fill>
    FieldRef object(std::string_view name, Get get, std::string_view help, Fill fill) {
        constexpr int optionals = facetmill::fields::optionals<Value<Get>>;
        static_assert(optionals < 2, "one that is missing and one that is null look the same");
        using T = typename facetmill::fields::Inner<Value<Get>>::type;
        return facetmill::fields::object_field(
            fields, name, help, nested<T>(fill), optionals,
            [get](const void* record, const std::function<void(const void*)>& look) {
                const auto& value = std::invoke(get, as_record(record));
                if constexpr (optionals > 0) {
                    if (value) look(&*value);
                    return value.has_value();
                } else {
                    look(&value);
                    return true;
                }
            });
    }

    /// Adds a list of records, each declared by fill(DeclareFields<item>&).
    template <class Get, class Fill>
    FieldRef list(std::string_view name, Get get, std::string_view help, Fill fill) {
        constexpr int optionals = facetmill::fields::optionals<Value<Get>>;
        static_assert(optionals < 2, "one that is missing and one that is null look the same");
        using List = typename facetmill::fields::Inner<Value<Get>>::type;
        return facetmill::fields::list_field(
            fields, name, help, nested<typename List::value_type>(fill), optionals,
            [get](const void* record, const std::function<void(const void*)>& look) {
                const auto& items = std::invoke(get, as_record(record));
                if constexpr (optionals > 0) {
                    if (!items) return false;
                    for (const auto& item : *items) look(&item);
                } else {
                    for (const auto& item : items) look(&item);
                }
                return true;
            });
    }

    /// Adds the fields of a nested record at the same level: get returns a reference to it.
    template <class Get, class Fill>
    void embed(Get get, Fill fill) {
        using T = Value<Get>;
        DeclareFields<T> inner;
        fill(inner);
        facetmill::fields::embed(fields, inner.fields, [get](const void* record) -> const void* {
            const T& embedded = std::invoke(get, as_record(record));
            return &embedded;
        });
    }

    /// Adds counts by name (NamedCounts). All names must be among the given names.
    template <class Get>
    FieldRef counts(std::string_view name, Get get, const std::vector<std::string>& names,
                    std::string_view help) {
        Json schema = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
        for (const auto& one : names) schema["properties"][one] = FieldType<std::uint64_t>::schema();
        Field& f = start<Value<Get>>(name, "counts by name", std::move(schema), help);
        f.put = putting(get, [](const NamedCounts& counts) {
            Json all = Json::object();
            for (const auto& [key, count] : counts) all[key] = count;
            return all;
        });
        return {fields, fields.all.size() - 1};
    }

    /// Sets a function that returns the terminal lines of the record.
    template <class Tell>
    void tell(Tell tell) {
        fields.tell = [tell](const void* record) -> std::vector<std::string> {
            return tell(as_record(record));
        };
    }

  private:
    template <class Get>
    using Value = std::remove_cvref_t<std::invoke_result_t<Get, const R&>>;

    static const R& as_record(const void* record) { return *static_cast<const R*>(record); }

    template <class T, class Fill>
    static std::shared_ptr<const Fields> nested(Fill fill) {
        DeclareFields<T> inner;
        fill(inner);
        return facetmill::fields::shared(std::move(inner.fields));
    }

    template <class T>
    Field& start(std::string_view name, const char* type,
                 Json schema,             // NOLINT(performance-unnecessary-value-param)
                 std::string_view help) { // moved from, which the check misses in templates
        return facetmill::fields::start(fields, name, type, std::move(schema), help,
                                        facetmill::fields::optionals<T>);
    }

    /// json: converts a value that is not an empty optional.
    template <class Get, class ToJson>
    static auto putting(Get get, ToJson json) {
        return [get, json](const Field& self, const void* record, Json& object) {
            const auto& value = std::invoke(get, as_record(record));
            facetmill::fields::put_value(self, value, json, object);
        };
    }
};

/// A getter for records that are one of several structs (std::variant): returns the member if the record is
/// an A.
template <class A, class T>
[[nodiscard]] auto where_it_is(T A::*member) {
    return [member](const auto& either) {
        const A* a = std::get_if<A>(&either);
        return a ? std::optional<T>(a->*member) : std::nullopt;
    };
}

/// The fields of the record R, as `fill` declares them.
template <class R, class Fill>
[[nodiscard]] Fields fields_of(Fill fill) {
    DeclareFields<R> d;
    fill(d);
    return std::move(d.fields);
}

} // namespace facetmill
