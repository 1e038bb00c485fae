#pragma once
// The comparison of a pair of files, and of two folders, for `facetmill diff`.

#include "cli/command.hpp"
#include "cli/confine.hpp"
#include "diff/comparison.hpp"

#include <filesystem>

namespace facetmill::cli {

struct DiffOptions {
    std::string a, b, maximum, rms, mean;
    std::vector<std::string> ignored;
    report::ComparisonSettings settings;
    std::size_t samples = SIZE_MAX; ///< samples for the deviation; the default averages all samples
    std::vector<std::string> units,
        ups; ///< for files that do not state them: a value for both, or values for A and B
    std::vector<std::string> reports; ///< HTML and Markdown files to write
    std::vector<std::string> others;  ///< files of --report, before they are added to reports
    std::vector<std::string> asset_roots;
    bool json = false, all = false;
    int threads = 0;
    SandboxOptions sandbox;
};

/// A compared pair; the second scene is in the convention of the first.
struct ComparedFiles {
    Scene a, b;
    report::Comparison comparison;
};
/// Throws the errors of reading a file, and a usage error for a limit with a unit if the first file has no
/// unit.
[[nodiscard]] ComparedFiles compared_files(const DiffOptions& options, const std::string& a,
                                           const std::string& b, const CommandLine& line,
                                           const Console& console);

/// Warns of textures missing from pictures, each once.
void tell_not_drawn(const std::vector<Diagnostic>& not_drawn, const Console& console);

/// The folder of the pairs' pages: "changes.html" -> "changes".
[[nodiscard]] std::filesystem::path folder_of_pages(const std::string& index);
/// Compares the files below both folders pair by pair, prints the result and writes the reports. Returns the
/// worst exit code of the pairs.
[[nodiscard]] int diff_of_folders(const DiffOptions& options, const CommandLine& line,
                                  const Console& console);

} // namespace facetmill::cli
