#pragma once
// Adjusts the paths of a pipeline for use in another folder.

#include "options/value.hpp"

#include <filesystem>

namespace facetmill::pipeline {

/// How to handle a path that begins with ${...}, because its folder is known only at run time.
enum class RunTimePaths {
    refused, ///< throws a usage error (E-SAVE)
    kept,    ///< the variable gives the base folder
};

/// Rewrites the relative input paths of a document's stages, and the defaults of its path params. They then
/// refer to the same files from another folder. Input paths are relative to the pipeline file.
void rebase_inputs(Value& document, const std::filesystem::path& from, const std::filesystem::path& to,
                   RunTimePaths run_time);

/// Adjusts one path, or each path of a list.
void rebase(Value& path, const std::filesystem::path& prefix, RunTimePaths run_time);

/// The relative path from a folder to another: "../scans"; "." for the same folder.
[[nodiscard]] std::filesystem::path way(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace facetmill::pipeline
