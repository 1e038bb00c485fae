#include "base/hash.hpp"

#include "base/error.hpp"

#include <array>
#include <fmt/format.h>
#include <openssl/evp.h>

namespace facetmill {

std::string sha256(std::span<const std::byte> bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (!EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr))
        throw Error(ErrorKind::bug, "E-BUG", "OpenSSL has no SHA-256");
    std::string text;
    for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
}

} // namespace facetmill
