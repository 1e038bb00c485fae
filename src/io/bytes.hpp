#pragma once
// Bytes of inputs and outputs. Files are mapped if possible, so a reader sees a contiguous span.

#include "base/error.hpp"
#include "platform/file_status.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io {

using Bytes = std::vector<std::byte>;
using Span = std::span<const std::byte>;

[[nodiscard]] inline std::string_view as_text(Span bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

[[nodiscard]] inline Bytes bytes_of_text(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

/// Reads a little-endian number of `size` bytes (at most 8) at an offset. The bytes must exist.
[[nodiscard]] inline std::uint64_t little_endian(Span bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// Reads a big-endian number in the same way.
[[nodiscard]] inline std::uint64_t big_endian(Span bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | std::to_integer<std::uint64_t>(bytes[at + i]);
    return value;
}

/// A complete input: a mapped regular file, or the contents of a pipe or standard input. Immutable and
/// shared.
class Input {
  public:
    /// Opens a file, or standard input for "-". Throws a missing-file error (E-FILE, E-DIRECTORY,
    /// E-PERMISSION) or a limit error (E-SIZE, when a stream goes beyond max_stream bytes). Compressed input
    /// (gzip, zstd) is unpacked, within the same limit. Regular files of max_stream bytes or more are
    /// mapped.
    static Input open(const std::filesystem::path& path, std::size_t max_stream = std::size_t{4} << 30);
    static Input of(std::string name, Bytes bytes);
    /// The same bytes under another name. A staged output gets the name of its target. `instead` maps the
    /// path of a neighbour to the file to open, because neighbours are staged too.
    using Instead = std::map<std::filesystem::path, std::filesystem::path>;
    Input staged_as(const std::filesystem::path& target, std::shared_ptr<const Instead> instead) const;
    /// A file named relative to this one: a glTF's buffers and images, an OBJ's materials. Throws the errors
    /// of open.
    Input beside(const std::filesystem::path& relative) const;
    /// The path to open for such a file.
    std::filesystem::path path_beside(const std::filesystem::path& relative) const;
    /// The same file, but neighbours may also be below these folders. Links in the paths are resolved.
    /// Throws a missing-file error (E-ASSET-ROOT) if a path is not a folder.
    Input with_asset_roots(const std::vector<std::filesystem::path>& folders) const;
    const std::vector<std::filesystem::path>& asset_roots() const { return asset_roots_; }

    const std::string& name() const { return name_; }           ///< shown in messages and the report
    const std::filesystem::path& path() const { return path_; } ///< empty for streams
    Span bytes() const { return bytes_; }
    Span stored() const {
        return stored_;
    } ///< the bytes as stored in the file, still compressed if it was compressed
    /// The same file with other bytes that were derived from its bytes, for example decoded text.
    Input with(Bytes bytes) const;
    /// The same file without its first bytes.
    Input from(std::size_t offset) const;
    /// If the file is mapped, releases the memory of a part of bytes() that has been read. Reading it again
    /// reads the file again.
    void release(Span part) const;
    /// False if a mapped file has changed since it was opened (its location, size or times). Readers may
    /// then have seen a mixture of old and new bytes.
    bool is_as_opened() const;

  private:
    void unpack(std::size_t limit);

    std::string name_;
    std::filesystem::path path_;
    std::optional<FileStamp> mapped_; ///< empty if the bytes are a copy
    std::shared_ptr<const void> owner_, stored_owner_;
    std::shared_ptr<const Instead> instead_;
    std::vector<std::filesystem::path> asset_roots_;
    Span bytes_, stored_;
};

} // namespace facetmill::io
