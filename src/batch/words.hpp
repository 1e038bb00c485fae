#pragma once
// Shared code of the summary renderers.

#include "batch/batch.hpp"

namespace facetmill::batch {

std::size_t count(const Summary& summary, Outcome::Verdict verdict);
/// "ok", "failed", "interrupted", "not run".
const char* verdict_word(Outcome::Verdict verdict);
/// The text with control characters as \x0a; names may contain them.
std::string one_line(std::string_view text);

std::string to_text(const Summary& summary);
Json to_json(const Summary& summary);
std::string to_junit(const Summary& summary);    ///< a test case per asset
std::string to_markdown(const Summary& summary); ///< a table, worst first
std::string to_html(const Summary& summary);     ///< a self-contained page with a picture per asset

} // namespace facetmill::batch
