#pragma once
// The topics of `facetmill docs`, for its list, suggestions and completions.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::cli {

struct Topic {
    enum class Kind { guide, page, command, stage };
    Kind kind;
    std::string name, about;
    std::string_view text{}; ///< of a guide or a page, in Markdown
};

/// Guides, pages, commands and stages, in the order of the list; for equal names, the first wins.
[[nodiscard]] std::vector<Topic> topics();

} // namespace facetmill::cli
