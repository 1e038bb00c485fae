#pragma once
// Options of a stage in a one-liner: --key value, --key=value, --key and --no-key, with dotted keys.

#include "cli/pipe_words.hpp"
#include "options/declaration.hpp"
#include "stage/stage.hpp"

namespace facetmill::cli {

/// The option of a stage by dotted name: "plane.normal". Null if it does not exist.
[[nodiscard]] const Option* find_dotted(const Declaration& declaration, std::string_view name);
/// A key that every step accepts.
[[nodiscard]] bool is_common(std::string_view key);
[[nodiscard]] std::string with_underscores(std::string key);
/// An option for several texts.
[[nodiscard]] Option list_of_texts();

/// Whether the next word is the option's value. Flags and properties that are truths take only true or false.
[[nodiscard]] bool wants_value(const PipeWords& words, const std::string& key, const Option* known);
/// Sets a value at a dotted key; a repeatable option collects its values.
void add_value(const PipeWords& words, Value& map, const std::string& key, Value value, const Mark& key_mark,
               const Option* known);
/// Reads the option at the current word into the step. stage: null if it is unknown.
void read_option(PipeWords& words, Value& item, const StageInfo* stage);

} // namespace facetmill::cli
