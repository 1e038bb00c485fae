#pragma once
// Text helpers shared by the summary formats.

#include "batch/batch.hpp"

namespace facetmill::batch {

[[nodiscard]] std::size_t count(const Summary& summary, Outcome::Verdict verdict);
/// "ok", "failed", "interrupted", "not run".
[[nodiscard]] const char* verdict_word(Outcome::Verdict verdict);
/// Replaces control characters, which names may contain, by codes such as \x0a.
[[nodiscard]] std::string one_line(std::string_view text);

[[nodiscard]] std::string to_text(const Summary& summary);
[[nodiscard]] Json to_json(const Summary& summary);
[[nodiscard]] std::string to_junit(const Summary& summary);    ///< an asset is a test case
[[nodiscard]] std::string to_markdown(const Summary& summary); ///< a table, worst first
[[nodiscard]] std::string
to_html(const Summary& summary); ///< one self-contained page, with a picture for each asset

} // namespace facetmill::batch
