#pragma once
// Bytes of inputs and outputs. Files are mapped when they can be, so a reader sees one contiguous span.

#include "base/error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

using Bytes = std::vector<std::byte>;
using Span = std::span<const std::byte>;

inline std::string_view as_text(Span bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

inline Bytes bytes_of_text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// Reads `size` bytes (at most 8) at offset `at` as a little-endian number. The bytes must exist.
inline std::uint64_t little_endian(Span bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// A whole input: a mapped regular file, or the content of a pipe or standard input. Immutable and shared.
class Input {
  public:
    /// Opens a file, or standard input for "-". Throws missing (E-FILE, E-DIRECTORY, E-PERMISSION) or limit
    /// (E-SIZE, if a stream exceeds max_stream bytes). Compressed input (gzip, zstd) is unpacked within the
    /// same limit. Regular files of max_stream bytes and more are mapped.
    static Input open(const std::filesystem::path& path, std::size_t max_stream = std::size_t{4} << 30);
    static Input of(std::string name, Bytes bytes);
    /// The same bytes under the name of the target, for a staged output. `instead` maps the whole path of a
    /// neighbour to the file to open, because neighbours are staged too.
    using Instead = std::map<std::filesystem::path, std::filesystem::path>;
    Input staged_as(const std::filesystem::path& target, std::shared_ptr<const Instead> instead) const;
    /// A file named relative to this one: a glTF's buffers and images, an OBJ's materials. Throws as open.
    Input beside(const std::filesystem::path& relative) const;
    /// The path that beside() opens.
    std::filesystem::path path_beside(const std::filesystem::path& relative) const;
    /// The same file, with these folders allowed for neighbours too. Links in the paths are resolved. Throws
    /// missing (E-ASSET-ROOT) for a path that is not a folder.
    Input with_asset_roots(const std::vector<std::filesystem::path>& folders) const;
    const std::vector<std::filesystem::path>& asset_roots() const { return asset_roots_; }

    const std::string& name() const { return name_; }           ///< for messages and the report
    const std::filesystem::path& path() const { return path_; } ///< empty for streams
    Span bytes() const { return bytes_; }
    Span stored() const { return stored_; } ///< as in the file: still compressed if it is
    /// The same file with other bytes, for example decoded text.
    Input with(Bytes bytes) const;
    /// The same file without its first bytes.
    Input from(std::size_t offset) const;
    /// Releases the memory of a part of bytes() after reading, if the file is mapped. This reduces the
    /// memory use of the process. A later access reads the file again.
    void release(Span part) const;
    /// False if a mapped file has changed since it was opened (location, size or times). Its bytes may then
    /// be a mix of the old and the new content.
    bool is_as_opened() const;

  private:
    void unpack(std::size_t limit);

    std::string name_;
    std::filesystem::path path_;
    /// The file status when the file was opened.
    struct Stamp {
        std::uint64_t device = 0, inode = 0, size = 0;
        std::int64_t seconds = 0, nanoseconds = 0, status_seconds = 0, status_nanoseconds = 0;
        bool operator==(const Stamp&) const = default;
    };
    template <class Stat>
    static Stamp stamp_of(const Stat& about);

    std::optional<Stamp> mapped_; ///< none: the bytes are a copy
    std::shared_ptr<const void> owner_, stored_owner_;
    std::shared_ptr<const Instead> instead_;
    std::vector<std::filesystem::path> asset_roots_;
    Span bytes_, stored_;
};

} // namespace facetmill::io
