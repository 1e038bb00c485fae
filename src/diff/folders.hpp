#pragma once
// Compares two folders of mesh files: the result of `facetmill diff A/ B/`, as text, JSON and an index.

#include "diff/comparison.hpp"

#include <filesystem>

namespace facetmill::report {

/// The paths of two files in their folders, with slashes; empty: that folder has none.
struct PairedPaths {
    std::string a, b;
    std::string unpaired = {}; ///< why a file has no partner, although the other folder has a similar name

    /// The path of the first file, or the only one.
    const std::string& path() const { return a.empty() ? b : a; }
    /// "sub/a.glb", "sub/a.ply and a.glb".
    std::string text() const;
};

/// A file of either folder, or one of each.
struct FolderPair {
    enum class Outcome { failed, differs, removed, added, same }; ///< the worst first
    PairedPaths paths;
    Outcome outcome = Outcome::same;
    int exit_code = 0;   ///< as that of `facetmill diff` of the two
    std::string verdict; ///< "agree", or why it failed
    std::optional<double>
        percent; ///< the largest deviation, of the first file's diagonal; none: not measured
    std::uint64_t faces_a = 0, faces_b = 0, bytes_a = 0, bytes_b = 0;
    std::string differs_in;            ///< "counts, geometry"
    std::string page;                  ///< the page of this pair, relative to the index; empty: none
    std::string picture_a, picture_b;  ///< small PNGs in base64; empty: none
    std::vector<Diagnostic> not_drawn; ///< textures that pictures do without
};
const char* to_string(FolderPair::Outcome outcome);

struct FolderComparison {
    std::vector<FolderPair> pairs; ///< in the order of their paths
    bool differs() const;          ///< anything but the same files that agree
};

/// The mesh files below both folders in the order of their paths. Files of the same path are a pair. Of the
/// rest, files whose paths differ only in the suffix (a.ply, a.glb) are a pair if neither folder has a
/// second candidate. Links to folders are not followed. Throws missing (E-FILE) when a folder cannot be
/// read.
std::vector<PairedPaths> pairs_in(const std::filesystem::path& a, const std::filesystem::path& b);

/// Sets the index entries of a pair.
void tell(const Comparison& comparison, FolderPair& pair);

/// Numbers of the pairs, the worst first: failures, then by how far they are apart.
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
