#pragma once
// The JSON type used throughout: keys keep their order, so reports read as they were written.

// The literals of the library are inline functions, so that every file that includes it would compile the
// parser of nlohmann::json, which is used nowhere: a second a file. Made templates, they cost nothing. (Where
// the library spells them ""_json, from 3.11.3 on, this changes nothing.)
#define JSON_USE_GLOBAL_UDLS 0
#define _json                                                                                                \
    _json(const char*, std::size_t);                                                                         \
    template <class>                                                                                         \
    nlohmann::json unused_literal
#define _json_pointer                                                                                        \
    _json_pointer(const char*, std::size_t);                                                                 \
    template <class>                                                                                         \
    nlohmann::json::json_pointer unused_pointer_literal
#include <nlohmann/json.hpp>
#undef _json
#undef _json_pointer

namespace facetmill {
using Json = nlohmann::ordered_json;

/// Parses a JSON text. Throws Json::parse_error; with Broken::discarded an invalid text gives a value that
/// is_discarded(). Compiled once, unlike Json::parse, which is a template.
enum class Broken { thrown, discarded };
Json parse_json(std::string_view text, Broken broken = Broken::thrown);
} // namespace facetmill

// Compiled once, in json.cpp: as templates, their code was made again in fifty files.
extern template class nlohmann::basic_json<nlohmann::ordered_map>;
extern template class std::vector<facetmill::Json>;
