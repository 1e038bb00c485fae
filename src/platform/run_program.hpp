#pragma once
// Other programs.

#include "platform/descriptor.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace facetmill {

struct ProgramSettings {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::filesystem::path log; ///< gets what it prints
    std::chrono::seconds limit{0};
};

struct ProgramEnd {
    enum class How { exited, by_signal, late, deserted, not_started };
    How how = How::exited;
    int number = 0; ///< its exit code (127: it cannot be run), the signal, or an errno
};

/// Runs it in the working folder, the only place where it may write, and waits. It ends, with all that it has
/// started, when it takes longer than the limit, or when the other side of the socket closes.
ProgramEnd run_program(const ProgramSettings& settings, const Descriptor& socket);

} // namespace facetmill
