#pragma once

namespace facetmill {

/// Whether this build runs under AddressSanitizer: it traces its own process at its end to seek leaks, and
/// reserves terabytes of addresses at its start.
#if defined(__SANITIZE_ADDRESS__) // GCC
inline constexpr bool has_address_sanitizer = true;
#elif defined(__has_feature) // Clang
inline constexpr bool has_address_sanitizer = __has_feature(address_sanitizer) != 0;
#else
inline constexpr bool has_address_sanitizer = false;
#endif

} // namespace facetmill
