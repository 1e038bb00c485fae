#pragma once

#include <string_view>

namespace facetmill::report {

/// The text of viewer.js; cmake/Embed.cmake puts it into the executable.
std::string_view viewer_script();

} // namespace facetmill::report
