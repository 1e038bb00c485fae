#pragma once
// File operations for a single output: links and permissions.

#include "io/bytes.hpp"
#include "platform/descriptor.hpp"

#include <filesystem>

namespace facetmill::io {

/// A hint for a target that cannot be written: the sandbox's hint, otherwise another folder. error: an
/// errno.
[[nodiscard]] std::string hint_to_write(const std::filesystem::path& target, int error);

/// Throws an output error with a readable message: E-SPACE, E-DIRECTORY, otherwise E-WRITE. error: an errno.
[[noreturn]] void cannot_write(const std::filesystem::path& target, int error);

/// Throws the errors of cannot_write, with the target's name.
void write_all(const Descriptor& file, Span bytes, const std::filesystem::path& target);

/// Whether the target is a stream, which a rename cannot replace.
bool is_stream(const std::filesystem::path& target);

/// The file to replace: follows symbolic links at the end, even if their target does not exist.
[[nodiscard]] std::filesystem::path followed(std::filesystem::path path);

/// The same path for every spelling of a file's path; "-" stays. Links in unreadable folders are not
/// followed.
[[nodiscard]] std::filesystem::path identity(const std::filesystem::path& path);

/// Gives the temporary the permissions, and as far as allowed the owner, of the file it will replace.
void keep_permissions(const Descriptor& file, const std::filesystem::path& target,
                      const std::filesystem::path& given);

/// Makes a hard link to the file at target, or a copy if hard links are not supported, and returns its path.
/// Empty if the target does not exist.
[[nodiscard]] std::filesystem::path set_aside(const std::filesystem::path& target);

} // namespace facetmill::io
