#include "platform/confined_program.hpp"

#include <cerrno>

namespace facetmill {

/// As in run_program.cpp: a worker process would start it.
ConfinedEnd run_confined(const ConfinedProgram&, const Descriptor&, const Descriptor&,
                         const Function<void(std::span<const std::byte>)>&) {
    return {{ProgramEnd::How::not_started, ENOSYS}};
}

Descriptor file_in_memory(std::span<const std::byte>) { return {}; }

std::filesystem::path executable() { return {}; }

} // namespace facetmill
