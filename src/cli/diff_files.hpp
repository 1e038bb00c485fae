#pragma once
// What `facetmill diff` does with one pair of files, and with two folders of them.

#include "cli/command.hpp"
#include "cli/confine.hpp"
#include "diff/comparison.hpp"

#include <filesystem>

namespace facetmill::cli {

struct DiffOptions {
    std::string a, b, maximum, rms, mean;
    std::vector<std::string> ignored;
    report::ComparisonSettings settings;
    std::size_t samples = SIZE_MAX;      ///< of the deviation, which averages them all then; or not given
    std::vector<std::string> units, ups; ///< of files that state none: of both, or of A and of B
    std::vector<std::string> reports;    ///< pages and Markdown files to write
    std::vector<std::string> others;     ///< those of --report, before they are among these
    std::vector<std::string> asset_roots;
    bool json = false, all = false;
    int threads = 0;
    SandboxOptions sandbox;
};

/// A pair that was read and compared, the second scene in the convention of the first.
struct ComparedFiles {
    Scene a, b;
    report::Comparison comparison;
};
/// Throws as a file is read: missing, malformed, usage for a limit in a unit that the first file has not.
ComparedFiles compared_files(const DiffOptions& options, const std::string& a, const std::string& b,
                             const CommandLine& line, const Console& console);

/// Warns of textures that pictures do without, each once.
void tell_not_drawn(const std::vector<Diagnostic>& not_drawn, const Console& console);

/// Where the pages of the pairs are: "changes.html" -> "changes".
std::filesystem::path folder_of_pages(const std::string& index);
/// Compares the files below both folders one pair after the other, prints, writes the reports, and returns
/// the exit code: the gravest of those of the pairs.
int diff_of_folders(const DiffOptions& options, const CommandLine& line, const Console& console);

} // namespace facetmill::cli
