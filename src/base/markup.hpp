#pragma once
// Texts inside HTML and XML.

#include <string>
#include <string_view>

namespace facetmill {

/// The text with & < > and both quotes as entities; control characters and bytes that are no UTF-8, which XML
/// cannot hold, become U+FFFD, each.
std::string escaped(std::string_view text);

} // namespace facetmill
