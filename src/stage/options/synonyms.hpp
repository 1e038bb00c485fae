#pragma once
// Other programs' names for options of several stages, separated by blanks. Only for hints.

#include <string_view>

namespace facetmill {

inline constexpr std::string_view path_synonyms = "file filename output out input in svg dxf csv";
inline constexpr std::string_view weld_synonyms =
    "merge_vertices weld_vertices merge_close_vertices merge weld_distance";
inline constexpr std::string_view format_synonyms = "type file_type filetype output_format";
inline constexpr std::string_view with_synonyms = "other mesh path file tool";
inline constexpr std::string_view attribute_synonyms = "scalar scalars field scalar_field";
inline constexpr std::string_view plane_synonyms = "normal axis origin at";
inline constexpr std::string_view plane_is = "(plane: z=0)"; ///< the text to write instead

} // namespace facetmill
