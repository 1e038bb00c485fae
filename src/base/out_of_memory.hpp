#pragma once
// What exceptions say where memory, or threads, have ended.

#include "base/error.hpp"

#include <optional>

namespace facetmill {

/// Whether there was not enough memory: for the program itself, or for a call of the system (ENOMEM), as the
/// functions of std::filesystem tell it.
bool is_out_of_memory(const std::exception& e);

/// Whether no thread could be begun, because there was no memory for its stack or a limit of threads was
/// reached, which the system does not tell apart: as std::thread tells it, or TBB.
bool is_want_of_threads(const std::exception& e);

/// What is told of these, of kind limit (E-MEMORY); none for other exceptions. what: what it was for, or
/// empty.
std::optional<Error> told_as_limit(const std::exception& e, const std::string& what = {}, Mark where = {});

} // namespace facetmill
