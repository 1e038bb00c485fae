#pragma once
// Errors and warnings as reports have them.

#include "base/error.hpp"
#include "base/json.hpp"

namespace facetmill::report {

inline Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// [{id, message, where, hint}]
template <class Diagnostics>
Json diagnostics_json(const Diagnostics& diagnostics) {
    Json all = Json::array();
    for (const auto& d : diagnostics)
        all.push_back({{"id", d.id},
                       {"message", d.message},
                       {"where", text_or_null(facetmill::to_string(d.where))},
                       {"hint", text_or_null(d.hint)}});
    return all;
}

} // namespace facetmill::report
