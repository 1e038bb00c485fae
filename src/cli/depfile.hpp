#pragma once
// What a run read and wrote as a rule for Make and Ninja.

#include "report/record.hpp"

namespace facetmill::cli {

/// The name as Make reads it: blanks, #, $, colons, in a target %, and backslashes before them escaped.
/// Throws output (E-DEPFILE) for a line break, which Make cannot spell.
std::string make_spelling(const std::string& path, bool target);

/// "target: inputs", and an empty rule for each input, so that Make does not stop when one is deleted.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

/// The rule of a run: its inputs, the pipeline's file unless it is empty, and the files that inputs name and
/// that are not there. Ninja knows one target, so it is the one given, else the first mesh that was written,
/// else the first output, the first report, or the depfile itself.
void write_depfile(const std::string& depfile, const report::RunRecord& record, const std::string& pipeline,
                   const std::string& target);

} // namespace facetmill::cli
