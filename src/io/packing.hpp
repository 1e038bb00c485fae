#pragma once
// Compressed files: gzip and zstd, detected by magic numbers when reading and by file names when writing.

#include "io/bytes.hpp"

namespace facetmill::io {

/// deflate: raw streams without a header, as in archives; never a whole file.
enum class Packing { none, gzip, zstd, deflate };

/// The compression of the bytes, by their magic number.
[[nodiscard]] Packing packing_of(Span bytes);
/// The compression for a file name that ends in .gz or .zst.
[[nodiscard]] Packing packing_named(const std::filesystem::path& path);
/// The path without .gz or .zst.
[[nodiscard]] std::filesystem::path without_packing(const std::filesystem::path& path);
/// The start of the names of an output's neighbours (.bin, .mtl, images). It is the output's stem, with _
/// for backslashes, because readers treat a backslash as a slash.
[[nodiscard]] std::string stem_of_neighbours(const std::filesystem::path& output);

/// The maximum unpacked size of a compressed file: 64 MiB or 200 times its size, whichever is larger. Text
/// meshes compress at most 50 times. Deflate can reach 1032, which only a decompression bomb does.
[[nodiscard]] std::size_t most_unpacked(std::size_t compressed);

/// Unpacks a compressed file of one or more members. Memory grows with the output, up to the limit and
/// most_unpacked(). Throws a limit error (E-SIZE) beyond these, and a malformed-input error (E-GZIP, E-ZSTD)
/// with the offset.
[[nodiscard]] Bytes unpacked(Span bytes, Packing packing, std::size_t limit, const std::string& name);

/// The bytes as a compressed file without name and time, so that equal bytes give equal files.
[[nodiscard]] Bytes packed(Span bytes, Packing packing);

/// Throws a limit error (E-SIZE): the file, or its content, is larger than the limit.
[[noreturn]] void too_large(const std::string& name, std::size_t limit);

} // namespace facetmill::io
