#pragma once
// The registry of message ids. It supplies the text of `facetmill explain` and the manual page, and the ids
// valid for --strict=ID. tests/golden/ids_test.py compares it with the ids that src uses.

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The few kinds of errors of an id.
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

/// A stable id: the general meaning of its messages, and the remedy.
struct MessageId {
    std::string_view id;      ///< "E-KEY", "W-UNITS"
    ErrorKinds kinds;         ///< for an error: its kinds (exit codes); for a warning: none
    std::string_view meaning; ///< one or two sentences
    std::string_view hint;    ///< the general remedy; a message may have a more specific hint

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
