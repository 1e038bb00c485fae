#pragma once
// What a run read and wrote as a rule for Make and Ninja.

#include "pipeline/plan.hpp"

namespace facetmill::cli {

/// The name as Make reads it: blanks, #, $, colons, in a target %, and backslashes before them escaped.
/// Throws output (E-DEPFILE) for a line break, which Make cannot spell.
std::string make_spelling(const std::string& path, bool target);

/// "outputs: inputs", and an empty rule for each input, so that Make does not stop when one is deleted.
std::string depfile_text(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs);

void write_depfile(const std::string& depfile, const pipeline::Plan& plan, const report::RunRecord& record,
                   const std::string& pipeline);

} // namespace facetmill::cli
