#pragma once
// The manual's pages: the files of docs/, embedded at build time (cmake/Embed.cmake).

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::docs {

struct ManualPage {
    std::string_view name; ///< the file's stem: "scan-to-web"
    std::string_view text; ///< Markdown; the first line is "# TITLE"
};

/// How-to guides, sorted by name.
const std::vector<ManualPage>& guides();
/// All other pages, sorted by name.
const std::vector<ManualPage>& manual_pages();
/// The roff manual page of pipeline files; its name is the page's name.
const ManualPage& pipeline_man_page();
/// The first line without the heading mark.
[[nodiscard]] std::string title_of(const ManualPage& page);

} // namespace facetmill::docs
