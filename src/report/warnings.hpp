#pragma once
// All warnings by their stable ids: what --strict=ID may name, and what the manual explains.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::report {

struct KnownWarning {
    std::string_view id;    ///< "W-UNITS"
    std::string_view about; ///< one sentence
};

/// Sorted by id.
const std::vector<KnownWarning>& known_warnings();

} // namespace facetmill::report
