#include "base/function.hpp"

namespace facetmill {

FunctionHandle::FunctionHandle(const FunctionHandle& other) noexcept : held(other.held) {
    if (held) held->owners.fetch_add(1, std::memory_order_relaxed);
}

FunctionHandle::FunctionHandle(FunctionHandle&& other) noexcept : held(std::exchange(other.held, nullptr)) {}

FunctionHandle& FunctionHandle::operator=(const FunctionHandle& other) noexcept {
    return *this = FunctionHandle(other);
}

FunctionHandle& FunctionHandle::operator=(FunctionHandle&& other) noexcept {
    std::swap(held, other.held);
    return *this;
}

FunctionHandle::~FunctionHandle() {
    if (held && held->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) held->drop(held);
}

} // namespace facetmill
