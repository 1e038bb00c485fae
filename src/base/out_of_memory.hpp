#pragma once
// Recognises exceptions that report a lack of memory or threads.

#include "base/error.hpp"

#include <optional>

namespace facetmill {

/// True if memory ran out in the program, or in a system call (ENOMEM) that std::filesystem reports.
bool is_out_of_memory(const std::exception& e);

/// True if no thread could be started, because of missing memory for its stack or a limit of threads; the
/// system does not distinguish them. std::thread and TBB report it.
bool is_want_of_threads(const std::exception& e);

/// Converts these exceptions to an error of kind limit (E-MEMORY); none for other exceptions. what: the
/// purpose of the memory, or empty.
[[nodiscard]] std::optional<Error> told_as_limit(const std::exception& e, const std::string& what = {},
                                                 Mark where = {});

} // namespace facetmill
