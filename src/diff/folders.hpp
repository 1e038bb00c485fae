#pragma once
// Compares two folders of mesh files, for `facetmill diff A/ B/`, as text, JSON and an index.

#include "diff/comparison.hpp"

#include <filesystem>

namespace facetmill::report {

/// The paths of two files in their folders, with slashes; empty: missing in that folder.
struct PairedPaths {
    std::string a, b;
    std::string unpaired =
        {}; ///< why a file has no counterpart, though the other folder has one of the same name

    /// The path of the first, or of the only file.
    const std::string& path() const { return a.empty() ? b : a; }
    /// "sub/a.glb", "sub/a.ply and a.glb".
    std::string text() const;
};

/// A file of either folder, or a pair of files.
struct FolderPair {
    enum class Outcome { failed, differs, removed, added, same }; ///< worst first
    PairedPaths paths;
    Outcome outcome = Outcome::same;
    int exit_code = 0;   ///< the exit code of `facetmill diff` for these two files
    std::string verdict; ///< "agree", or the reason of the failure
    std::optional<double>
        percent; ///< largest deviation, in percent of the first file's diagonal; none: not measured
    std::uint64_t faces_a = 0, faces_b = 0, bytes_a = 0, bytes_b = 0;
    std::string differs_in;            ///< "counts, geometry"
    std::string page;                  ///< page of this pair, relative to the index; empty: no page
    std::string picture_a, picture_b;  ///< small PNGs in base64; empty: none
    std::vector<Diagnostic> not_drawn; ///< textures missing in pictures
};
[[nodiscard]] const char* to_string(FolderPair::Outcome outcome);

struct FolderComparison {
    std::vector<FolderPair> pairs; ///< by path
    bool differs() const;          ///< false if the files are the same and all agree
};

/// The mesh files below both folders, sorted by path. Files with the same path are a pair. Remaining files
/// whose paths differ only by suffix are pairs too (a.ply, a.glb), if each folder has only one. Does not
/// follow links to folders. Throws a missing-file error (E-FILE) for an unreadable folder.
[[nodiscard]] std::vector<PairedPaths> pairs_in(const std::filesystem::path& a,
                                                const std::filesystem::path& b);

/// Sets the pair's data for the index.
void tell(const Comparison& comparison, FolderPair& pair);

/// Indices of the pairs, the worst first: failures, then by deviation.
[[nodiscard]] std::vector<std::size_t> worst_first(const FolderComparison& comparison);

[[nodiscard]] std::string to_text(const FolderComparison& comparison, const std::string& name_a,
                                  const std::string& name_b, bool all);
[[nodiscard]] Json to_json(const FolderComparison& comparison, const std::string& name_a,
                           const std::string& name_b);
/// A page with a row for each pair, linked to the pair's page.
[[nodiscard]] std::string to_html(const FolderComparison& comparison, const std::string& name_a,
                                  const std::string& name_b);
[[nodiscard]] std::string to_markdown(const FolderComparison& comparison, const std::string& name_a,
                                      const std::string& name_b);
[[nodiscard]] Json folder_comparison_schema();

} // namespace facetmill::report
