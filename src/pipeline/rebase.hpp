#pragma once
// Paths of a pipeline that is used in another folder than its own.

#include "options/value.hpp"

#include <filesystem>

namespace facetmill::pipeline {

/// What becomes of a path that begins with ${...}, whose folder is known only at run time.
enum class RunTimePaths {
    refused, ///< throws usage (E-SAVE)
    kept,    ///< the variable says where it starts
};

/// Rewrites the relative paths that the stages of a document read, and the defaults of its params of type
/// path, so that they mean the same from another folder: what a pipeline file reads is relative to that file.
void rebase_inputs(Value& document, const std::filesystem::path& from, const std::filesystem::path& to,
                   RunTimePaths run_time);

/// One path, or each of a list.
void rebase(Value& path, const std::filesystem::path& prefix, RunTimePaths run_time);

/// What leads from a folder to another: "../scans"; "." when they are the same.
std::filesystem::path way(const std::filesystem::path& from, const std::filesystem::path& to);

} // namespace facetmill::pipeline
