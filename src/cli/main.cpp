// Catches all exceptions that reach the top, and maps them to exit codes.

#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "cli/command.hpp"
#include "cli/exhaustion.hpp"
#include "io/outputs/outputs.hpp"
#include "platform/pages.hpp"
#include "platform/terminal.hpp"

namespace facetmill::cli {

namespace {

int fail(const Console& console, const Error& error) {
    console.diagnostics(error);
    return static_cast<int>(error.kind());
}

int entry(int argc, char** argv) {
    keep_freed_memory();
    prepare_streams();
    Console console;
    try {
        io::clean_up_on_signals();
        prepare_for_exhaustion();
        return program(arguments_of_program(argc, argv), console);
    } catch (const Error& e) {
        return fail(console, e);
    } catch (const std::exception& e) {
        if (const auto limit = told_as_limit(e)) return fail(console, *limit);
        return fail(console, Error(ErrorKind::bug, "E-BUG", e.what(), "this is a bug in facetmill"));
    }
}

} // namespace

} // namespace facetmill::cli

int main(int argc, char** argv) { return facetmill::cli::entry(argc, argv); }
