#pragma once
// The building blocks of Markdown reports, of a run and of a batch.

#include <string>
#include <vector>

namespace facetmill::report {

/// A table under a heading; empty without rows. Cells are Markdown already.
std::string markdown_table(const std::string& title, const std::vector<std::string>& heads,
                           const std::vector<std::vector<std::string>>& rows);

} // namespace facetmill::report
