#pragma once
// The elements of Markdown reports for runs and batches.

#include <string>
#include <vector>

namespace facetmill::report {

/// A table under a heading; empty without rows. Cells are already Markdown.
[[nodiscard]] std::string markdown_table(const std::string& title, const std::vector<std::string>& heads,
                                         const std::vector<std::vector<std::string>>& rows);

} // namespace facetmill::report
