#pragma once
// The reason to refuse settings, returned by the check of an algorithm or a stage. The algorithm throws it,
// and a stage reports it at the option's location.

#include "base/error.hpp"

#include <optional>

namespace facetmill {

struct Refusal {
    std::string option;  ///< name of the option: "min_angle"
    std::string message; ///< for example "'min_angle' cannot be combined with another target"; messages put
                         ///< the owner of the option before it
    std::string hint = {};
    std::string id = "E-CONFLICT";
};

/// An option that has no effect without another: "'drain' needs mode: surface".
[[nodiscard]] inline Refusal needs(const std::string& option, const std::string& other) {
    return {option, "'" + option + "' needs " + other, "add " + other + ", or leave out '" + option + "'"};
}

/// The message with its owner: "split: 'min_angle' cannot be combined with another target".
[[nodiscard]] inline std::string refusal_text(std::string_view owner, const Refusal& refusal) {
    return std::string(owner) + ": " + refusal.message;
}

/// Throws a usage error if given a refusal. owner: the capability, "split".
inline void throw_refusal(std::string_view owner, const std::optional<Refusal>& refusal) {
    if (refusal) throw Error(ErrorKind::usage, refusal->id, refusal_text(owner, *refusal), refusal->hint);
}

} // namespace facetmill
