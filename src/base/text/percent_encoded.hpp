#pragma once
// Paths in URLs.

#include <fmt/format.h>
#include <string>
#include <string_view>

namespace facetmill {

/// The path of a URL: characters other than letters, digits and -._~/ become %20 and the like.
[[nodiscard]] inline std::string percent_encoded(std::string_view path) {
    std::string url;
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           std::string_view("-._~/").find(c) != std::string_view::npos;
        url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return url;
}

} // namespace facetmill
