#pragma once
// The sandbox of a run: what of its plan says which files it needs. See platform/sandbox.hpp.

#include "cli/console.hpp"
#include "io/codec.hpp"
#include "pipeline/plan.hpp"
#include "platform/sandbox.hpp"

namespace facetmill::cli {

class Arguments;

struct SandboxOptions {
    bool off = false;
};

/// --no-sandbox.
void add_sandbox_option(Arguments& arguments, SandboxOptions& options);

/// --asset-root, which may be repeated.
void add_asset_root_option(Arguments& arguments, std::vector<std::string>& folders);

/// How files are read where it named these folders.
io::ReadSettings read_settings(const std::vector<std::string>& asset_roots);

/// Adds an input: itself, and its folder, where its neighbours are.
void allow_input(AllowedFiles& allowed, const std::filesystem::path& input);
/// Adds an output: its folder, for its temporary beside it; a stream itself.
void allow_output(AllowedFiles& allowed, const std::filesystem::path& output);
/// Adds all that the plan names, with what it reads and writes beside: includes, reports, baselines. Of what
/// only the run knows (a foreach over parts) the folder of the part of the path that is known.
void allow_plan(AllowedFiles& allowed, const pipeline::Plan& plan);

/// Starts the processes that run other programs for the plan, while there may be new ones: ktx, where a stage
/// is asked for ktx2.
void start_programs(const pipeline::Plan& plan);

/// Gives up all that is not allowed, and calls of the system that no run needs, unless the options say
/// otherwise. Called before there are threads. Makes the folders of outputs that are not there, which go
/// again when nothing is written there. Tells what is on with --verbose.
void confine(AllowedFiles allowed, const SandboxOptions& options, const Console& console);
/// ... of calls only: for what goes on to read files that are not known yet.
void confine_calls_only(const SandboxOptions& options);

} // namespace facetmill::cli
