#pragma once
// The manual's pages: the files of docs/, embedded when facetmill is built (cmake/Embed.cmake).

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::docs {

struct ManualPage {
    std::string_view name; ///< the file's stem: "scan-to-web"
    std::string_view text; ///< Markdown; the first line is "# TITLE"
};

/// How to do something; sorted by name.
const std::vector<ManualPage>& guides();
/// The other pages; sorted by name.
const std::vector<ManualPage>& manual_pages();
/// The manual page of pipeline files, in roff; its name is that of the page.
const ManualPage& pipeline_man_page();
/// The first line, without its mark.
std::string title_of(const ManualPage& page);

} // namespace facetmill::docs
