#pragma once
// Text to tree and back. The only user of yaml-cpp: its event parser fills our own Value, so that duplicate
// keys, merge keys, aliases, several documents, YAML 1.2 scalars and expansion bombs are ours to judge.

#include "options/value.hpp"

namespace facetmill::pipeline {

/// Reads one YAML document. All that is wrong goes into problems (E-YAML, E-DUPLICATE, E-UNQUOTED for `${x}`
/// unquoted in braces, E-EXPANSION); the result is then only good for finding more problems.
Value parse_yaml(std::shared_ptr<const SourceText> source, Problems& problems);

/// YAML that parse_yaml reads back to the same content; lists of stages in block style, small maps in braces.
std::string emit_yaml(const Value& value);
/// The same on one line, in braces.
std::string emit_flow(const Value& value);

} // namespace facetmill::pipeline
