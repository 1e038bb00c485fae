#pragma once
// Converts text that is not plain UTF-8. Editors on Windows save UTF-16, or put a byte order mark before
// UTF-8.

#include "io/bytes.hpp"

namespace facetmill::io {

/// The input as UTF-8 without a byte order mark; plain UTF-8 is returned unchanged. UTF-16 is detected by
/// its mark or, without a mark, by a zero in every second byte at the start. Use it only for files without a
/// magic number, because binary files may begin with any bytes. Throws a malformed-input error (E-ENCODING)
/// with the offset for UTF-32 and for unpaired surrogates.
[[nodiscard]] Input in_utf8(const Input& input);

/// Whether in_utf8 returns the input unchanged. Looks only at its start.
bool is_plain_utf8(const Input& input);

} // namespace facetmill::io
