#pragma once
// A helper process that receives requests and answers over a socket.

#include "platform/descriptor.hpp"

#include <chrono>
#include <cstddef>
#include <functional>

namespace facetmill {

/// Starts a process that runs the function and exits afterwards. The process gets one end of a socket pair,
/// and the caller gets the other end. If the start fails, the caller's descriptor is false. Signals that end
/// the caller do not end the process; instead its socket closes. Call it before starting threads.
[[nodiscard]] Descriptor start_worker(const std::function<void(const Descriptor& socket)>& serve);

/// False on Windows, which cannot copy a process.
[[nodiscard]] bool has_workers();

/// Whether the other side sends something, or has closed, within the time.
[[nodiscard]] bool is_readable(const Descriptor& socket, std::chrono::milliseconds time);

/// False if the other side has closed.
bool send_all(const Descriptor& socket, const void* data, std::size_t size);
bool receive_all(const Descriptor& socket, void* data, std::size_t size);

} // namespace facetmill
