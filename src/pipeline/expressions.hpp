#pragma once
// ${name} and ${name.property} in values. Expressions are resolved in the tree, value by value: what a
// parameter holds never becomes structure of the pipeline.

#include "options/value.hpp"

#include <functional>

namespace facetmill::pipeline {

/// A value as it compares with others of its type.
struct Comparable {
    std::optional<double>
        number;       ///< a ratio, an angle in radians, a length in metres, scene units or percent
    std::string kind; ///< numbers compare within a kind: "metres" is not "percent"
};
/// Reads a value as a type would; none after adding a problem.
using ReadComparable = std::function<std::optional<Comparable>(const Value&, Problems&)>;

/// Something that ${name} stands for: a parameter, or a variable of a foreach.
struct Variable {
    std::string name;
    Value value;                       ///< null: an optional parameter that was not given
    std::optional<std::int64_t> index; ///< of a foreach: which of its values this is, from 0
    bool from_file = false;            ///< a name found in a file: made safe for file names inside texts
    ReadComparable comparable = {};    ///< of a parameter: what it is compared with is read by its type
};

using Scope = std::vector<Variable>;

const Variable* find_variable(const Scope& scope, std::string_view name);
bool is_variable_name(std::string_view text);

/// The value with all its expressions replaced. A scalar that is exactly "${x}" becomes x's value, whatever
/// its type; inside a text x becomes its spelling; $${ is a literal ${. An option that is exactly an optional
/// parameter that was not given is left out. Adds E-VARIABLE and E-EXPRESSION.
Value resolved(const Value& value, const Scope& scope, Problems& problems);

/// Whether the value is exactly "${x}", x being a name that was found in a file.
bool is_name_from_file(const Value& value, const Scope& scope);

/// Whether anything in the tree is known only at run time.
bool is_deferred(const Value& value);

/// The place of piece inside what the mark underlines, the first that begins `from` bytes or more after the
/// mark; or the mark when it is not on its line.
Mark mark_within(const Mark& mark, std::string_view piece, std::size_t from = 0);

/// Of a path's text: the file's name without its suffix (and without .gz or .zst), and that suffix.
std::string stem_of(const std::string& path);
std::string extension_of(const std::string& path);
/// A name that is safe as part of a file's name anywhere: no separators, no control or shell characters.
std::string safe_name(const std::string& name);

} // namespace facetmill::pipeline
