#pragma once
// Runs a program that parses an untrusted file: it gets the file as its standard input, may only read, and
// has limits of memory and time.

#include "base/function.hpp"
#include "platform/run_program.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace facetmill {

struct ConfinedProgram {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    std::vector<std::filesystem::path> read; ///< the files and folders that it may read, besides its input
    std::uint64_t memory = 0;                ///< bytes that it may allocate
    std::uint64_t most_output = 0;           ///< bytes that it may write to its standard output
    std::chrono::seconds limit{0};
};

struct ConfinedEnd : ProgramEnd {
    bool too_much = false; ///< it was killed because it wrote too much
    std::string said = {}; ///< the end of its standard error
};

/// Runs the program and waits. It cannot write files. With Landlock it can only read the listed files,
/// libraries and system information. It is killed after the limit, beyond most_output, and when the other
/// side of the socket closes or sends a byte. on_output gets its output piece by piece.
ConfinedEnd run_confined(const ConfinedProgram& settings, const Descriptor& input, const Descriptor& socket,
                         const Function<void(std::span<const std::byte>)>& on_output);

/// A file in memory with these bytes, to read from its begin. False, with errno, on failure.
[[nodiscard]] Descriptor file_in_memory(std::span<const std::byte> bytes);

/// The path of this executable; empty if it is unknown.
[[nodiscard]] std::filesystem::path executable();

} // namespace facetmill
