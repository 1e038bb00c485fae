#pragma once
// Text that is not plain UTF-8: editors on Windows save UTF-16, or a byte order mark before UTF-8.

#include "io/bytes.hpp"

namespace facetmill::io {

/// The input as UTF-8 without a byte order mark. It is the same where it is so already; UTF-16 is known by
/// its mark or, without one, by a zero in every second byte of its beginning. For files that no codec is sure
/// of: binary ones may begin in any way. Throws malformed (E-ENCODING) with the offset for UTF-32 and for
/// halves of surrogate pairs.
Input in_utf8(const Input& input);

/// Whether in_utf8 gives the input as it is. Only its beginning is looked at.
bool is_plain_utf8(const Input& input);

} // namespace facetmill::io
