#include "base/function.hpp"

namespace facetmill {

FunctionHandle::FunctionHandle(const FunctionHandle& other) noexcept : held_(other.held_) {
    if (held_) held_->owners.fetch_add(1, std::memory_order_relaxed);
}

FunctionHandle::FunctionHandle(FunctionHandle&& other) noexcept
    : held_(std::exchange(other.held_, nullptr)) {}

FunctionHandle& FunctionHandle::operator=(const FunctionHandle& other) noexcept {
    return *this = FunctionHandle(other);
}

FunctionHandle& FunctionHandle::operator=(FunctionHandle&& other) noexcept {
    std::swap(held_, other.held_);
    return *this;
}

FunctionHandle::~FunctionHandle() {
    if (held_ && held_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) held_->drop(held_);
}

} // namespace facetmill
