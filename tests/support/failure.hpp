#pragma once
// The full text of an error: "malformed [E-PLY] a.ply:3: message | hint".

#include "base/error.hpp"

#include <fmt/format.h>
#include <string>

namespace facetmill::test {

inline const char* kind_name(ErrorKind kind) {
    switch (kind) {
    case ErrorKind::check:
        return "check";
    case ErrorKind::usage:
        return "usage";
    case ErrorKind::missing:
        return "missing";
    case ErrorKind::output:
        return "output";
    case ErrorKind::stage:
        return "stage";
    case ErrorKind::malformed:
        return "malformed";
    case ErrorKind::limit:
        return "limit";
    default:
        return "bug";
    }
}

/// Runs the body and returns the first diagnostic of its Error as text; "nothing" without an error.
template <class Body>
std::string failure(Body&& body) {
    try {
        body();
    } catch (const Error& error) {
        const Diagnostic& d = error.diagnostics().front();
        std::string text = fmt::format("{} [{}] ", kind_name(error.kind()), d.id);
        if (d.where.known()) text += facetmill::to_string(d.where) + ": ";
        text += d.message;
        return d.hint.empty() ? text : text + " | " + d.hint;
    }
    return "nothing";
}

/// The id only: "E-PLY"; empty without an error.
template <class Body>
std::string failure_id(Body&& body) {
    const std::string text = failure(body);
    const auto begin = text.find('['), end = text.find(']');
    return begin == text.npos ? "" : text.substr(begin + 1, end - begin - 1);
}

} // namespace facetmill::test
