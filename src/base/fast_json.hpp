#pragma once
// Reads, writes and destroys typical JSON several times as fast as the library.

#include "base/json.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace facetmill {

/// Parses a JSON text to the same value as the library. Returns none for invalid JSON, for nesting deeper
/// than `deepest` levels, and for rare texts that only the library reads: a byte order mark, perhaps numbers
/// next to zero. The library then reports the error, if any. The library's time grows with the square of an
/// object's members; this function's time is linear.
/// unread: members of the outermost object that are only checked; their arrays and objects are returned
/// empty.
[[nodiscard]] std::optional<Json> fast_json(std::string_view text, int deepest = 256,
                                            std::span<const std::string_view> unread = {});

/// The text of a value in a single line, equal to json.dump(-1, ' ', false, Json::error_handler_t::replace).
/// It recurses, as the library does.
[[nodiscard]] std::string fast_text(const Json& json);

/// Makes a value null. It is recursive; the library avoids recursion by first moving everything below the
/// value to a list.
void destroy(Json& json);

/// Destroys a value at the end of the scope.
class ScopedDestroy {
  public:
    explicit ScopedDestroy(Json& json) : json_(json) {}
    ~ScopedDestroy() { destroy(json_); }
    ScopedDestroy(const ScopedDestroy&) = delete;
    ScopedDestroy& operator=(const ScopedDestroy&) = delete;

  private:
    Json& json_;
};

} // namespace facetmill
