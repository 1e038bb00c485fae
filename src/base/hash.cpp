#include "base/hash.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"

#include <algorithm>
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

/// Where memory ends while OpenSSL starts, it has no algorithms for the rest of the process, or crashes.
void prepare_openssl() {
    [[maybe_unused]] static const int set =
        CRYPTO_set_mem_functions(openssl_malloc, openssl_realloc, openssl_free);
}

using Digest = std::array<unsigned char, EVP_MAX_MD_SIZE>;

std::string as_hexadecimal(const Digest& digest, unsigned int size) {
    std::string text;
    for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
}

void check_openssl(int done) {
    if (done != 1)
        throw out_of_memory("OpenSSL does not compute SHA-256: memory has ended, or it lacks the algorithm");
}

} // namespace

std::string sha256(std::span<const std::byte> bytes) {
    constexpr std::size_t piece = std::size_t{16} << 20;
    if (bytes.size() > piece) { // this takes long, so it tells how far it is
        Sha256 sum;
        for (std::size_t at = 0; at < bytes.size(); at += piece) {
            Share::tell(static_cast<double>(at) / static_cast<double>(bytes.size()));
            sum.add(bytes.subspan(at, std::min(piece, bytes.size() - at)));
        }
        return sum.digest();
    }
    prepare_openssl();
    Digest digest{};
    unsigned int size = 0;
    check_openssl(EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr));
    return as_hexadecimal(digest, size);
}

struct Sha256::State {
    EVP_MD_CTX* context = nullptr;
    ~State() { EVP_MD_CTX_free(context); }
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
    prepare_openssl();
    state_->context = EVP_MD_CTX_new();
    check_openssl(state_->context ? EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) : 0);
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
    check_openssl(EVP_DigestUpdate(state_->context, bytes.data(), bytes.size()));
}

std::string Sha256::digest() {
    Digest digest{};
    unsigned int size = 0;
    check_openssl(EVP_DigestFinal_ex(state_->context, digest.data(), &size));
    return as_hexadecimal(digest, size);
}

} // namespace facetmill
