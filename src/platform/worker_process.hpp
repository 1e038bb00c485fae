#pragma once
// A process that serves this one: it gets orders and gives answers over a socket.

#include "platform/descriptor.hpp"

#include <cstddef>
#include <functional>

namespace facetmill {

/// Starts a process that runs the function and ends with it; it gets its end of a pair of sockets, and the
/// caller the other, which is false when there is no process. Signals that end the caller do not end it: the
/// socket closes then. Call it before threads start.
Descriptor start_worker(const std::function<void(const Descriptor& socket)>& serve);

/// False when the other side has closed.
bool send_all(const Descriptor& socket, const void* data, std::size_t size);
bool receive_all(const Descriptor& socket, void* data, std::size_t size);

} // namespace facetmill
