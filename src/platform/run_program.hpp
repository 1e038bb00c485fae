#pragma once
// Runs other programs.

#include "platform/descriptor.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace facetmill {

/// The executable file of this name in the folders of PATH; a name with a slash is used as a path.
[[nodiscard]] std::optional<std::filesystem::path> program_in_path(const std::string& name);

struct ProgramSettings {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::filesystem::path log; ///< receives its output
    std::chrono::seconds limit{0};
};

struct ProgramEnd {
    enum class How { exited, by_signal, late, deserted, not_started };
    How how = How::exited;
    int number = 0; ///< its exit code (127: it cannot be run), the signal, or an errno
};

/// Runs the program in the working folder and waits. If the kernel has Landlock, the program may write only
/// in this folder. It is killed with its children after the time limit, or when the other side of the socket
/// closes or sends a byte.
ProgramEnd run_program(const ProgramSettings& settings, const Descriptor& socket);

} // namespace facetmill
