#pragma once
// The files that a tileset names.

#include "io/bytes.hpp"

#include <string>

namespace facetmill::io::tileset {

/// The file that a URI names, below the folder of the tileset or an asset root. place: the URI's position in
/// the JSON. Throws a malformed-input error (E-URI) for a URI that leads elsewhere, and a missing-file error
/// (E-FILE).
[[nodiscard]] Input file_below(const Input& tileset, const std::string& uri, const std::string& place);

} // namespace facetmill::io::tileset
