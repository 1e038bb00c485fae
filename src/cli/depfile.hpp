#pragma once
// The files read and written by a run, as a rule for Make and Ninja.

#include "pipeline/plan.hpp"

namespace facetmill::cli {

/// The name in Make's notation: escapes blanks, #, $, colons, % in a target, and backslashes before these.
/// Throws an output error (E-DEPFILE) for a line break, which Make cannot represent.
std::string make_escaped(const std::string& path, bool target);

/// "target: inputs", and an empty rule for each input, so that Make does not stop if an input is deleted.
[[nodiscard]] std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

/// Call it before a run with a depfile. Throws the errors of make_escaped for the target (if empty: for the
/// first planned output), and for the plan's inputs.
void require_spellable(const std::string& target, const pipeline::Plan& plan);

/// Writes the rule of a run; the record's paths must be valid from the working directory. The target is the
/// given one, because Ninja needs a single target. If empty, it is the first written mesh, otherwise the
/// first output, the first report, or the depfile itself. The rule depends on the pipeline's file, if given,
/// and on all inputs. Missing files that an input names are not listed: Ninja would run the rule each time,
/// and their folder would run it for every new file there.
void write_depfile(const std::string& depfile, const std::string& target, const std::string& pipeline_file,
                   const pipeline::Plan& plan, const report::RunRecord& record);

} // namespace facetmill::cli
