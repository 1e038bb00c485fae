#pragma once
// SHA-256 of files and bytes (OpenSSL's), as hexadecimal.

#include <cstddef>
#include <span>
#include <string>

namespace facetmill {
std::string sha256(std::span<const std::byte> bytes);
}
