#pragma once
// The comparison of two folders of mesh files for `facetmill diff A/ B/`, as text, JSON and an index.

#include "diff/comparison.hpp"

#include <filesystem>

namespace facetmill::report {

/// The paths of a pair relative to the folders, with slashes; empty: missing in that folder.
struct PairedPaths {
    std::string a, b;
    std::string unpaired =
        {}; ///< the reason why a file is unpaired although the other folder has a file of the same name

    /// The first path, or the only path.
    const std::string& path() const { return a.empty() ? b : a; }
    /// "sub/a.glb", "sub/a.ply and a.glb".
    std::string text() const;
};

/// A file of either folder, or a pair.
struct FolderPair {
    enum class Outcome { failed, differs, removed, added, same }; ///< worst first
    PairedPaths paths;
    Outcome outcome = Outcome::same;
    int exit_code = 0;   ///< the same as for `facetmill diff` of the pair
    std::string verdict; ///< "agree", or the reason for the failure
    std::optional<double>
        percent; ///< the largest deviation in percent of the first file's diagonal; none: not measured
    std::uint64_t faces_a = 0, faces_b = 0, bytes_a = 0, bytes_b = 0;
    std::string differs_in;            ///< "counts, geometry"
    std::string page;                  ///< the pair's page, relative to the index; empty: none
    std::string picture_a, picture_b;  ///< small PNGs in base64; empty: none
    std::vector<Diagnostic> not_drawn; ///< textures missing from the pictures
};
const char* to_string(FolderPair::Outcome outcome);

struct FolderComparison {
    std::vector<FolderPair> pairs; ///< sorted by path
    bool differs() const;          ///< false only if all pairs have both files and agree
};

/// The mesh files below both folders, sorted by path. Files with the same path are a pair. Remaining files
/// with the same path except for the suffix (a.ply, a.glb) are a pair if each folder has only one such file.
/// Links to folders are not followed. Throws missing (E-FILE) if a folder cannot be read.
std::vector<PairedPaths> pairs_in(const std::filesystem::path& a, const std::filesystem::path& b);

/// Sets the fields of a pair from its comparison.
void tell(const Comparison& comparison, FolderPair& pair);

/// The indices of the pairs, worst first: failures, then by deviation.
std::vector<std::size_t> worst_first(const FolderComparison& comparison);

std::string to_text(const FolderComparison& comparison, const std::string& name_a, const std::string& name_b,
                    bool all);
Json to_json(const FolderComparison& comparison, const std::string& name_a, const std::string& name_b);
/// A page with a row for each pair, linked to the pair's own page.
std::string to_html(const FolderComparison& comparison, const std::string& name_a, const std::string& name_b);
std::string to_markdown(const FolderComparison& comparison, const std::string& name_a,
                        const std::string& name_b);
Json folder_comparison_schema();

} // namespace facetmill::report
