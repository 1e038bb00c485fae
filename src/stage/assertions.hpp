#pragma once
// Assertions on properties, shared by `validate`, `ensure` (stage and common key) and `when`.

#include "geometry/inspect/inspect.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"

namespace facetmill {

class Context;

/// A property and its required values.
struct Assertion {
    std::string property;
    Bound bound{};           ///< for a word, its index; for a length, set when resolved
    Mark where{};            ///< mark of the required value
    bool if_applies = false; ///< also holds if the property does not apply
    /// Lengths as written: one for a length property, three for a corner of a box, otherwise none.
    std::vector<Length> min{}, max{};
    std::vector<Mark> min_at{}, max_at{}; ///< marks of each length
    Box within{};                         ///< bounds of a box after resolving; infinite if unspecified
};

/// The bound as text: "true", "2", "at most 5".
[[nodiscard]] std::string expectation(const Bound& bound);
bool holds(const Bound& bound, double value);
/// The assertion's value in the syntax of pipelines: "true", "mm", "{max: 5mm}".
[[nodiscard]] std::string to_string(const Assertion& assertion);

/// A map from property names to bounds, {closed: true, euler: 2, faces: {max: 5000}}, in written order.
struct Assertions {
    std::vector<Assertion> all;
    /// The settings with which inspect measures these properties.
    InspectSettings settings() const;
    struct PhysicalLength {
        std::string property;
        const Length* length;
        Mark where;
    };
    /// The lengths with a physical unit.
    std::vector<PhysicalLength> physical() const;
};

/// Converts the lengths to scene units; percentages refer to the input of the context's stage. Throws a
/// usage error (E-UNIT) for a physical unit if the scene has no unit.
[[nodiscard]] Assertions resolved(Assertions assertions, const Scene& scene, Context& context);

/// Reads assertions from a map value. Unknown properties are problems, as are truth values instead of
/// numbers, and vice versa.
bool parse_assertions(const Value& value, Assertions& out, std::string_view owner, Problems& problems,
                      const std::set<std::string>& also_known = {});
/// Adds E-MISSING unless at least one assertion or other key is given.
void verify_any(bool any, const Value& given, std::string_view owner, Problems& problems);
/// The JSON Schema of such a map.
[[nodiscard]] Json assertions_schema();
/// The manual's text for a property: its help, and the unit if the type does not imply it.
[[nodiscard]] std::string help_of(const Property& property);
/// The words of a property with their meanings; none for other kinds.
[[nodiscard]] std::vector<Choice> word_choices(const Property& property);

/// Declares an option per property of the table. Each option in use is added to the struct's assertions.
template <class S>
void declare_properties(Declare<S>& d, Assertions S::*member, std::string owner) {
    const Json schema = assertions_schema();
    for (const auto& p : property_table()) {
        Option o;
        o.name = p.name;
        o.kind = p.truth()                      ? OptionKind::boolean
                 : p.kind == PropertyKind::word ? OptionKind::choice
                                                : OptionKind::bound;
        o.one = o.kind;
        const bool length = p.kind == PropertyKind::length || p.kind == PropertyKind::box;
        o.dimension = length                          ? Dimension::length
                      : p.kind == PropertyKind::angle ? Dimension::angle
                                                      : Dimension::none;
        o.choices = word_choices(p);
        o.help = help_of(p);
        o.synonyms = synonyms_of(p);
        o.schema = schema["properties"][o.name];
        o.parse = [member, owner](const Option& self, const Value& v, void* target, Problems& problems) {
            const Value map = Value::map({{self.name, v.mark, v}}, v.mark);
            return parse_assertions(map, static_cast<S*>(target)->*member, owner, problems);
        };
        d.declaration.options.push_back(std::move(o));
    }
}

/// A check per assertion, in order. Lengths must be resolved. The check fails if the property does not apply
/// (volume of an open mesh).
[[nodiscard]] std::vector<report::Check> evaluate(const Assertions& assertions, const Properties& properties,
                                                  const std::string& stage);
/// True if the assertion holds; none if the property does not apply.
[[nodiscard]] std::optional<bool> holds(const Assertion& assertion, const Properties& properties);

template <>
struct OptionType<Assertions> {
    static constexpr OptionKind kind = OptionKind::assertions;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& v, Assertions& out, Problems& p) {
        return parse_assertions(v, out, "assertions", p);
    }
    static std::string print(const Assertions&) { return ""; }
    static Json schema() { return assertions_schema(); }
    static std::optional<double> magnitude(const Assertions&) { return {}; }
};

} // namespace facetmill
