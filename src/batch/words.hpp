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
[[nodiscard]] std::string to_junit(const Summary& summary); ///< an asset is a test case
/// Causes and assets, worst first. path: the file of the report, from which links start.
[[nodiscard]] std::string to_markdown(const Summary& summary, const std::string& path);
/// A self-contained page, with a picture for each asset.
[[nodiscard]] std::string to_html(const Summary& summary, const std::string& path);

/// The folder of the inputs, or the only input; otherwise the pipeline.
[[nodiscard]] std::string title_of(const Summary& summary);
/// The address of a file of the output folder, from the file of a report.
[[nodiscard]] std::string link_to(const Summary& summary, const std::string& report, const std::string& file);
/// "33 of 40 assets are ok; exit code 1"
[[nodiscard]] std::string verdict_line(const Summary& summary);
/// The measured columns of an asset in one line: "volume 12, area 3".
[[nodiscard]] std::string measures_text(const Figures& figures);

} // namespace facetmill::batch
