#pragma once
// What a run read and wrote as a rule for Make and Ninja.

#include "pipeline/plan.hpp"

namespace facetmill::cli {

/// The name as Make reads it: blanks, #, $, colons, in a target %, and backslashes before them escaped.
/// Throws output (E-DEPFILE) for a line break, which Make cannot spell.
std::string make_escaped(const std::string& path, bool target);

/// "target: inputs", and an empty rule for each input, so that Make does not stop when one is deleted.
std::string depfile_text(const std::string& target, const std::vector<std::string>& inputs);

/// Throws as make_escaped for the target, or what would be it, and for what the plan reads: before a run that
/// a rule is wanted of.
void require_spellable(const std::string& target, const pipeline::Plan& plan);

/// The rule of a run whose record names outputs and reports as they are found from here. Its target is the
/// one given, since Ninja knows only one; empty: the first mesh that was written, else the first output, the
/// first report, or the depfile itself. It depends on the pipeline's file, unless that is empty, on all that
/// is read, and for a file that an input names and that is not there on the folder in which it would appear:
/// the run is due when it does, and not before. For that outputs become newer than such a folder; with
/// kept_before, those that are older than that time keep their times (--restat).
void write_depfile(const std::string& depfile, const std::string& target, const std::string& pipeline_file,
                   const pipeline::Plan& plan, const report::RunRecord& record,
                   std::optional<std::filesystem::file_time_type> kept_before = {});

} // namespace facetmill::cli
