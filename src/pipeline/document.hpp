#pragma once
// Converts text to a tree and back. Only this file uses yaml-cpp. Its event parser fills our own Value, so
// this code handles duplicate keys, merge keys, aliases, several documents, YAML 1.2 scalars and expansion
// bombs.

#include "options/value.hpp"

namespace facetmill::pipeline {

/// Reads one YAML document. Adds all errors to problems (E-YAML, E-DUPLICATE, E-UNQUOTED for an unquoted
/// `${x}` in braces, E-EXPANSION). After an error, the result is only useful for finding more problems.
Value parse_yaml(std::shared_ptr<const SourceText> source, Problems& problems);

/// YAML that parse_yaml reads back with the same content; lists of stages in block style, small maps in
/// braces.
[[nodiscard]] std::string emit_yaml(const Value& value);
/// The YAML on a single line, in braces.
[[nodiscard]] std::string emit_flow(const Value& value);

} // namespace facetmill::pipeline
