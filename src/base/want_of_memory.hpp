#pragma once
// What exceptions say where memory has ended.

#include <exception>
#include <new>
#include <system_error>

namespace facetmill {

/// Whether there was not enough memory: for the program itself, or for a call of the system (ENOMEM), as the
/// functions of std::filesystem tell it.
inline bool is_want_of_memory(const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e)) return true;
    const auto* const call = dynamic_cast<const std::system_error*>(&e);
    return call && call->code() == std::errc::not_enough_memory;
}

} // namespace facetmill
