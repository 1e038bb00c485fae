#pragma once
// Assertions on properties: what `validate`, `ensure` (stage and common key) and `when` have in common.

#include "geometry/inspect.hpp"
#include "options/declaration.hpp"
#include "report/record.hpp"

namespace facetmill {

/// A property and what it must be, with the place where it was written.
struct Assertion {
    std::string property;
    Bound bound;
    Mark where;
    bool if_applies = false; ///< holds where the property does not apply
};

/// "true", "2", "at most 5".
std::string expectation(const Bound& bound);
bool holds(const Bound& bound, double value);

/// A map from property names to bounds, {closed: true, euler: 2, faces: {max: 5000}}; in the order written.
struct Assertions {
    std::vector<Assertion> all;
    /// What inspect has to be asked for.
    InspectSettings settings() const;
};

/// Reads assertions from a map value; unknown properties, truths where numbers belong and the reverse are
/// problems.
bool parse_assertions(const Value& value, Assertions& out, std::string_view owner, Problems& problems,
                      const std::set<std::string>& also_known = {});
/// JSON Schema of such a map.
Json assertions_schema();

/// Declares one option per property of the table; each given one is appended to the struct's assertions.
template <class S>
void declare_properties(Declare<S>& d, Assertions S::*member, std::string owner) {
    const Json schema = assertions_schema();
    for (const auto& p : property_table()) {
        Option o;
        o.name = p.name;
        o.type = p.truth ? "bool" : OptionType<Bound>::name;
        o.help = p.help;
        o.schema = schema["properties"][o.name];
        o.parse = [member, owner](const Option& self, const Value& v, void* target, Problems& problems) {
            const Value map = Value::map({{self.name, v.mark, v}}, v.mark);
            return parse_assertions(map, static_cast<S*>(target)->*member, owner, problems);
        };
        d.declaration.options.push_back(std::move(o));
    }
}

/// One check per assertion, in order. A property that does not apply (volume of an open mesh) does not hold.
std::vector<report::Check> evaluate(const Assertions& assertions, const Properties& properties,
                                    const std::string& stage);

template <>
struct OptionType<Assertions> {
    static constexpr const char* name = "assertions";
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& v, Assertions& out, Problems& p) {
        return parse_assertions(v, out, "assertions", p);
    }
    static std::string print(const Assertions&) { return ""; }
    static Json schema() { return assertions_schema(); }
    static std::optional<double> magnitude(const Assertions&) { return {}; }
};

} // namespace facetmill
