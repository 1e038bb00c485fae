#pragma once
// SHA-256 of files and bytes (by Nettle), as hexadecimal.

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace facetmill {

[[nodiscard]] std::string sha256(std::span<const std::byte> bytes);

/// The SHA-256 of bytes added in pieces.
class Sha256 {
  public:
    Sha256();
    ~Sha256();
    Sha256(const Sha256&) = delete;
    Sha256& operator=(const Sha256&) = delete;
    void add(std::span<const std::byte> bytes);
    /// The digest of all added data. No data may be added afterwards.
    std::string digest();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace facetmill
