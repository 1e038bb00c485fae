#pragma once
// The one registry of message ids. What `facetmill explain` and the manual page say of an id, and what
// --strict=ID may name, comes from here; tests/golden/ids_test.py holds it against the ids that src uses.

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The few kinds of errors that an id comes with.
class ErrorKinds {
  public:
    constexpr ErrorKinds(std::initializer_list<ErrorKind> kinds) : size_(kinds.size()) {
        std::copy(kinds.begin(), kinds.end(), kinds_.begin());
    }
    constexpr const ErrorKind* begin() const { return kinds_.data(); }
    constexpr const ErrorKind* end() const { return kinds_.data() + size_; }
    constexpr std::size_t size() const { return size_; }

  private:
    std::array<ErrorKind, 4> kinds_{};
    std::size_t size_;
};

/// A stable id: what a message that bears it means, in general, and what one can do about it.
struct MessageId {
    std::string_view id;      ///< "E-KEY", "W-UNITS"
    ErrorKinds kinds;         ///< of an error: the kinds (exit codes) that it comes with; of a warning: none
    std::string_view meaning; ///< one or two sentences
    std::string_view hint;    ///< what to do; a message has a hint of its own where more is known

    bool is_warning() const { return id.starts_with("W-"); }
};

/// All of them, sorted by id: errors, then warnings.
std::span<const MessageId> message_ids();
/// The entry of an id, or null.
const MessageId* message_id(std::string_view id);
/// The ids of the warnings, sorted.
std::vector<std::string> warning_ids();
/// The exit code and what it means: "2 (the command line or the pipeline is wrong)".
std::string to_string(ErrorKind kind);

} // namespace facetmill
