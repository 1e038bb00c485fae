#pragma once
// The JSON type used everywhere: keys keep their order, so reports keep the order of writing.

#define JSON_USE_GLOBAL_UDLS 0
#include <nlohmann/json.hpp>

namespace facetmill {
using Json = nlohmann::ordered_json;

/// Parses a JSON text. Throws Json::parse_error; with Broken::discarded, an invalid text gives a value that
/// is_discarded(). Compiled once, unlike the template Json::parse.
enum class Broken { thrown, discarded };
[[nodiscard]] Json parse_json(std::string_view text, Broken broken = Broken::thrown);
} // namespace facetmill

// Compiled once, in json.cpp: otherwise fifty files would compile these templates again.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
