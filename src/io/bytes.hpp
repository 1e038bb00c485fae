#pragma once
// Bytes of inputs and outputs. Files are mapped when they can be, so a reader sees one contiguous span.

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

/// The number of so many bytes (at most 8) at a place that has them, the least significant first.
[[nodiscard]] inline std::uint64_t little_endian(Span bytes, std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(bytes[at + i]) << (8 * i);
    return value;
}

/// An input, whole: a mapped regular file, or what a pipe or standard input gave. Immutable and shared.
class Input {
  public:
    /// Opens a file, or standard input for "-". Throws missing (E-FILE, E-DIRECTORY, E-PERMISSION) or limit
    /// (E-SIZE, when a stream goes beyond max_stream bytes). What is compressed (gzip, zstd) is unpacked,
    /// within the same limit. Regular files of max_stream bytes and more are mapped.
    static Input open(const std::filesystem::path& path, std::size_t max_stream = std::size_t{4} << 30);
    static Input of(std::string name, Bytes bytes);
    /// The same bytes under another name, for a staged output: that of its target. `instead` says which file
    /// to open for a neighbour (by its whole path), since neighbours are staged too.
    using Instead = std::map<std::filesystem::path, std::filesystem::path>;
    Input staged_as(const std::filesystem::path& target, std::shared_ptr<const Instead> instead) const;
    /// A file named relative to this one: a glTF's buffers and images, an OBJ's materials. Throws as open.
    Input beside(const std::filesystem::path& relative) const;
    /// ... and the path to open for it.
    std::filesystem::path path_beside(const std::filesystem::path& relative) const;
    /// The same file, whose neighbours may lie below these folders, too: links in the paths are resolved.
    /// Throws missing (E-ASSET-ROOT) for what is no folder.
    Input with_asset_roots(const std::vector<std::filesystem::path>& folders) const;
    const std::vector<std::filesystem::path>& asset_roots() const { return asset_roots_; }

    const std::string& name() const { return name_; }           ///< for messages and the report
    const std::filesystem::path& path() const { return path_; } ///< empty for streams
    Span bytes() const { return bytes_; }
    Span stored() const { return stored_; } ///< as the file holds them: still compressed, when it was gzip
    /// The same file with other bytes, made of its own: decoded text.
    Input with(Bytes bytes) const;
    /// The same file without its first bytes.
    Input from(std::size_t offset) const;
    /// Gives back the memory of a part of bytes() that has been read, where the file is mapped: the process
    /// is smaller then. Who reads them again gets them from the file again.
    void release(Span part) const;
    /// False when a file that is mapped is no longer as it was when it was opened (its place, size or times):
    /// who read its bytes may have seen some of before and some of after.
    bool is_as_opened() const;

  private:
    void unpack(std::size_t limit);

    std::string name_;
    std::filesystem::path path_;
    std::optional<FileStamp> mapped_; ///< none: the bytes are a copy
    std::shared_ptr<const void> owner_, stored_owner_;
    std::shared_ptr<const Instead> instead_;
    std::vector<std::filesystem::path> asset_roots_;
    Span bytes_, stored_;
};

} // namespace facetmill::io
