#pragma once
// The sandbox of a run, with the files that its plan needs. See platform/sandbox.hpp.

#include "cli/console.hpp"
#include "io/codec.hpp"
#include "pipeline/plan.hpp"
#include "platform/sandbox.hpp"

namespace facetmill::cli {

class Arguments;

struct SandboxOptions {
    bool off = false;
};

/// Adds --no-sandbox.
void add_sandbox_option(Arguments& arguments, SandboxOptions& options);

/// Adds --asset-root, which is repeatable.
void add_asset_root_option(Arguments& arguments, std::vector<std::string>& folders);

/// The read settings with these asset roots.
[[nodiscard]] io::ReadSettings read_settings(const std::vector<std::string>& asset_roots);

/// Adds an input and its folder, which holds its neighbours.
void allow_input(AllowedFiles& allowed, const std::filesystem::path& input);
/// Adds an output: its folder, because of the temporary file in it; for a stream only the stream.
void allow_output(AllowedFiles& allowed, const std::filesystem::path& output);
/// Adds all files that the plan names, with its includes, reports and baselines. For names known only at run
/// time (a foreach over parts), adds the folder of the known part of the path.
void allow_plan(AllowedFiles& allowed, const pipeline::Plan& plan);

/// Starts helper processes for external programs before the sandbox forbids new processes: ktx, if a stage
/// needs KTX2.
void start_programs(const pipeline::Plan& plan);

/// Starts the processes that read files of other formats. Then drops access to all other files and to
/// unneeded system calls, unless the options disable the sandbox.
/// Call it before starting threads. Creates missing output folders, and removes them at the end if they stay
/// empty. Reports the active restrictions with --verbose.
void confine(AllowedFiles allowed, const SandboxOptions& options, const Console& console);
/// Drops access to unneeded system calls only, for commands that read files not yet known.
void confine_calls_only(const SandboxOptions& options);

} // namespace facetmill::cli
