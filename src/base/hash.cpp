#include "base/hash.hpp"

#include "base/error.hpp"

#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <new>
#include <openssl/crypto.h>
#include <openssl/evp.h>

namespace facetmill {

namespace {

/// Asks again as long as a handler of failed requests (std::set_new_handler) finds something to give back.
template <class Ask>
void* asked(Ask&& ask) {
    while (true) {
        if (void* const got = ask()) return got;
        const auto handler = std::get_new_handler();
        if (!handler) return nullptr;
        try {
            handler();
        } catch (const std::bad_alloc&) {
            return nullptr;
        }
    }
}

void* openssl_malloc(std::size_t bytes, const char*, int) {
    return asked([&] { return std::malloc(bytes); });
}
void openssl_free(void* old, const char*, int) { std::free(old); }
void* openssl_realloc(void* old, std::size_t bytes, const char* file, int line) {
    if (bytes > 0) return asked([&] { return std::realloc(old, bytes); });
    openssl_free(old, file, line);
    return nullptr;
}

} // namespace

std::string sha256(std::span<const std::byte> bytes) {
    // Where memory ends while OpenSSL starts, it has no algorithms for the rest of the process, or crashes.
    [[maybe_unused]] static const int set =
        CRYPTO_set_mem_functions(openssl_malloc, openssl_realloc, openssl_free);
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
        throw out_of_memory("OpenSSL does not compute SHA-256: memory has ended, or it lacks the algorithm");
    std::string text;
    for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
}

} // namespace facetmill
