#pragma once
// Compressed files: gzip and zstd, known by how they begin when they are read and by their names when they
// are written.

#include "io/bytes.hpp"

namespace facetmill::io {

/// deflate: without a header, as archives have it; no file is.
enum class Packing { none, gzip, zstd, deflate };

/// How the bytes are compressed, by their first ones.
Packing packing_of(Span bytes);
/// How a file of this name is to be compressed: .gz, .zst.
Packing packing_named(const std::filesystem::path& path);
/// The path without .gz or .zst.
std::filesystem::path without_packing(const std::filesystem::path& path);
/// What the names of files beside an output begin with (.bin, .mtl, images): its stem, in which a backslash,
/// which readers take for a slash, is _.
std::string stem_of_neighbours(const std::filesystem::path& output);

/// How many bytes a compressed file of that size may hold: 64 MiB, or 200 times its size when that is more.
/// Meshes as text come to 50 times at most; deflate can do 1032, which nothing but a bomb does.
std::size_t most_unpacked(std::size_t compressed);

/// The bytes that a compressed file holds, of one or more members. Memory is taken as they come, and no more
/// than the limit and most_unpacked(). Throws limit (E-SIZE) beyond, malformed (E-GZIP, E-ZSTD) with
/// the offset.
Bytes unpacked(Span bytes, Packing packing, std::size_t limit, const std::string& name);

/// The bytes as a compressed file without name and time, so that the same bytes give the same file.
Bytes packed(Span bytes, Packing packing);

/// Throws limit (E-SIZE): the file, or what it holds, has more bytes than that.
[[noreturn]] void too_large(const std::string& name, std::size_t limit);

} // namespace facetmill::io
