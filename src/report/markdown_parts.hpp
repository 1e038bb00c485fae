#pragma once
// What Markdown reports are made of, of a run and of a batch.

#include <string>
#include <vector>

namespace facetmill::report {

/// A table under a heading; nothing when there are no rows. Cells are Markdown already.
std::string markdown_table(const std::string& title, const std::vector<std::string>& heads,
                           const std::vector<std::vector<std::string>>& rows);

} // namespace facetmill::report
