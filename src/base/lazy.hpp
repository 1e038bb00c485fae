#pragma once
// A value computed on first use, so that runs without it do not pay for it at start.

#include "base/function.hpp"

#include <memory>
#include <mutex>

namespace facetmill {

/// Copies share the value. Access is thread-safe; make() runs once. Empty: a default T.
template <class T>
class Lazy {
  public:
    Lazy() = default;
    explicit Lazy(Function<T()> make) : state_(std::make_shared<State>()) { state_->make = std::move(make); }

    const T& operator*() const {
        static const T empty{};
        if (!state_) return empty;
        std::call_once(state_->once, [this] { state_->value = state_->make(); });
        return state_->value;
    }
    const T* operator->() const { return &**this; }

  private:
    struct State {
        std::once_flag once;
        Function<T()> make;
        T value{};
    };
    std::shared_ptr<State> state_;
};

} // namespace facetmill
