#pragma once
// The registry of message ids. Each room registers the ids that it raises in its messages.cpp. If several
// rooms raise an id, the lowest layer of them registers it. `facetmill explain`, the manual page and
// --strict=ID read the registry. tests/golden/text_test.py compares it with the ids in src.

#include "base/error.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The few kinds of an error; empty for a warning.
class ErrorKinds {
  public:
    constexpr ErrorKinds() = default;
    constexpr ErrorKinds(ErrorKind kind) : ErrorKinds({kind}) {}
    constexpr ErrorKinds(std::initializer_list<ErrorKind> kinds) : size_(kinds.size()) {
        ErrorKind* next = kinds_;
        for (const ErrorKind kind : kinds) *next++ = kind;
    }
    constexpr const ErrorKind* begin() const { return kinds_; }
    constexpr const ErrorKind* end() const { return kinds_ + size_; }

  private:
    ErrorKind kinds_[4] = {};
    std::size_t size_ = 0;
};

/// A stable id, and the data that its messages share.
struct MessageId {
    std::string_view id;      ///< "E-KEY", "W-UNITS"
    std::string_view meaning; ///< one or two sentences
    std::string_view hint;    ///< a suggestion; a message may have a more specific one
    ErrorKinds kinds = {};    ///< the exit codes of an error

    bool is_warning() const { return id.starts_with("W-"); }
};

/// Adds rows to the registry when the program starts. Use it as a constant at namespace scope.
struct RegisterMessages {
    RegisterMessages(std::initializer_list<MessageId> rows);
};

/// All ids in order: errors, then warnings. Throws if an id is registered twice.
const std::vector<MessageId>& message_ids();
/// The entry of an id, or null.
[[nodiscard]] const MessageId* message_id(std::string_view id);
/// The ids of the warnings, in order.
[[nodiscard]] std::vector<std::string> warning_ids();

} // namespace facetmill
