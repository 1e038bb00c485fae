#pragma once

#include <string_view>

namespace facetmill::report {

/// The text of viewer.js; cmake/Embed.cmake embeds it in the executable.
[[nodiscard]] std::string_view viewer_script();

} // namespace facetmill::report
