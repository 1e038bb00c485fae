#include "platform/run_program.hpp"

#include <cerrno>

namespace facetmill {

/// Other programs run in a worker process with a sandbox, which needs fork().
std::optional<std::filesystem::path> program_in_path(const std::string&) { return {}; }

ProgramEnd run_program(const ProgramSettings&, const Descriptor&) {
    return {ProgramEnd::How::not_started, ENOSYS};
}

} // namespace facetmill
