#pragma once
// Text helpers shared by the summary formats.

#include "batch/batch.hpp"

namespace facetmill::batch {

std::size_t count(const Summary& summary, Outcome::Verdict verdict);
/// "ok", "failed", "interrupted", "not run".
const char* verdict_word(Outcome::Verdict verdict);
/// Replaces control characters, which names may contain, by codes such as \x0a.
std::string one_line(std::string_view text);

std::string to_text(const Summary& summary);
Json to_json(const Summary& summary);
std::string to_junit(const Summary& summary);    ///< an asset is a test case
std::string to_markdown(const Summary& summary); ///< a table, worst first
std::string to_html(const Summary& summary);     ///< one self-contained page, with a picture for each asset

} // namespace facetmill::batch
