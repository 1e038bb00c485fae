#pragma once
// Tar archives: ustar (POSIX.1-1988), its pax headers (POSIX.1-2001), and GNU's long names.

#include "io/bytes.hpp"

#include <functional>

namespace facetmill::io {

/// Calls take for each regular file in the archive, in its order. Skips folders, links and devices. Throws a
/// malformed-input error (E-TAR) with the offset; sizes beyond the end of the archive are refused before
/// they are used. name: for messages.
void read_tar(Span archive, const std::string& name,
              const std::function<void(const std::string& path, Span bytes)>& take);

/// Puts a file into an archive: without time and owner, so that equal files give equal bytes.
void put_tar_file(const std::string& path, Span bytes, const std::function<void(Span)>& put);
/// The end of an archive.
void put_tar_end(const std::function<void(Span)>& put);

} // namespace facetmill::io
