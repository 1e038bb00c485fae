#pragma once
// The JSON type used throughout: keys keep their order, so reports read as they were written.

#define JSON_USE_GLOBAL_UDLS 0
#include <nlohmann/json.hpp>

namespace facetmill {
using Json = nlohmann::ordered_json;

/// The value that a JSON text stands for. Throws Json::parse_error; with Broken::discarded a broken text
/// gives a value that is_discarded(). Compiled once, as Json::parse, a template, would not be.
enum class Broken { thrown, discarded };
Json parse_json(std::string_view text, Broken broken = Broken::thrown);
} // namespace facetmill

// Compiled once, in json.cpp: as templates, their code was made again in fifty files.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
