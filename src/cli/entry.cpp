// The one catch, and the exit codes.

#include "cli/entry.hpp"

#include "base/error.hpp"
#include "cli/command.hpp"
#include "io/outputs.hpp"

#include <algorithm>
#include <new>

namespace facetmill::cli {

namespace {

int fail(const Console& console, ErrorKind kind, std::string id, std::string message, std::string hint = {}) {
    console.diagnostic({Severity::error, std::move(id), std::move(message), {}, std::move(hint)});
    return static_cast<int>(kind);
}

} // namespace

int entry(int argc, char** argv) {
    Console console;
    try {
        io::clean_up_on_signals();
        return program({argv + 1, argv + std::max(argc, 1)}, console);
    } catch (const Error& e) {
        console.diagnostics(e);
        return static_cast<int>(e.kind());
    } catch (const std::bad_alloc&) {
        const Error error = out_of_memory("not enough memory");
        console.diagnostics(error);
        return static_cast<int>(error.kind());
    } catch (const std::exception& e) {
        return fail(console, ErrorKind::bug, "E-BUG", e.what(), "this is a bug in facetmill");
    }
}

} // namespace facetmill::cli
