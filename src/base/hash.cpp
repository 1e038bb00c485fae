#include "base/hash.hpp"

#include "base/progress.hpp"

#include <algorithm>
#include <array>
#include <nettle/sha2.h>

namespace facetmill {

std::string sha256(std::span<const std::byte> bytes) {
    constexpr std::size_t piece = std::size_t{16} << 20;
    const bool tells = bytes.size() > piece; // reports progress, because it takes long
    Sha256 sum;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
        if (tells) ProgressScope::report(static_cast<double>(at) / static_cast<double>(bytes.size()));
        sum.add(bytes.subspan(at, std::min(piece, bytes.size() - at)));
    }
    return sum.digest();
}

struct Sha256::State {
    sha256_ctx context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) { sha256_init(&state_->context); }

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
    sha256_update(&state_->context, bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

std::string Sha256::digest() {
    std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
    sha256_digest(&state_->context, digest.size(), digest.data());
    constexpr const char* digits = "0123456789abcdef";
    std::string text;
    text.reserve(2 * digest.size());
    for (const std::uint8_t byte : digest) {
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

} // namespace facetmill
