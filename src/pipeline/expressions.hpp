#pragma once
// ${name} and ${name.property} in values. Expressions are resolved value by value in the tree, so the
// contents of a parameter never become structure of the pipeline.

#include "options/value.hpp"

#include <functional>

namespace facetmill::pipeline {

/// A value in a form that can be compared with others of its type.
struct Comparable {
    std::optional<double>
        number;       ///< a ratio, an angle in radians, a length in metres, scene units or percent
    std::string kind; ///< only equal kinds can be compared: "metres" is not "percent"
};
/// Parses a value according to a type; none after adding a problem.
using ReadComparable = std::function<std::optional<Comparable>(const Value&, Problems&)>;

/// The value of a ${name}: a parameter, or a variable of a foreach.
struct Variable {
    std::string name;
    Value value;                       ///< null: an optional parameter without a value
    std::optional<std::int64_t> index; ///< in a foreach: the index of this value, from 0
    bool from_file = false;            ///< a name found in a file: made safe for use in file names
    ReadComparable comparable = {};    ///< for a parameter: parses the other side of a comparison by its type
};

using Scope = std::vector<Variable>;

[[nodiscard]] const Variable* find_variable(const Scope& scope, std::string_view name);
bool is_variable_name(std::string_view text);

/// The value with all its expressions replaced. A scalar that is exactly "${x}" becomes x's value of any
/// type; within a text, x becomes its text; $${ is a literal ${. An option whose value is exactly an optional
/// parameter without a value is dropped. Adds E-VARIABLE and E-EXPRESSION.
[[nodiscard]] Value resolved(const Value& value, const Scope& scope, Problems& problems);

/// True if the value is exactly "${x}", and x is a name that was found in a file.
bool is_name_from_file(const Value& value, const Scope& scope);

/// True if any value in the tree is known only at run time.
bool is_deferred(const Value& value);

/// The position of the first occurrence of piece within the mark, at least `from` bytes after its start. If
/// its line has none, the mark itself.
[[nodiscard]] Mark mark_within(const Mark& mark, std::string_view piece, std::size_t from = 0);

/// The stem of the path's file name (without .gz or .zst), and its suffix.
[[nodiscard]] std::string stem_of(const std::string& path);
[[nodiscard]] std::string extension_of(const std::string& path);
/// A name that is safe as part of a file name on any system: without separators, control or shell characters.
[[nodiscard]] std::string safe_name(const std::string& name);

} // namespace facetmill::pipeline
