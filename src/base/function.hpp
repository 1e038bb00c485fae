#pragma once
// The function type of declarations. A std::function makes the compiler generate about ten functions for
// each stored lambda, and the stages have hundreds; this type needs two.

#include <atomic>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace facetmill {

/// The shared state of a Function and its copies. (Compiled once, in function.cpp.)
class FunctionHandle {
  public:
    struct Held {
        explicit Held(void (*drop_it)(const Held*)) : drop(drop_it) {}
        Held(const Held&) = delete;
        Held& operator=(const Held&) = delete;

        mutable std::atomic<std::size_t> owners{1};
        void (*drop)(const Held*); ///< deletes it as its original type
    };

    FunctionHandle() = default;
    FunctionHandle(const FunctionHandle& other) noexcept;
    FunctionHandle(FunctionHandle&& other) noexcept;
    FunctionHandle& operator=(const FunctionHandle& other) noexcept;
    FunctionHandle& operator=(FunctionHandle&& other) noexcept;
    ~FunctionHandle();

    explicit operator bool() const { return held != nullptr; }

  protected:
    explicit FunctionHandle(const Held* owned) : held(owned) {}
    const Held* held = nullptr;
};

template <class Signature>
class Function;

/// An immutable function of these arguments, or empty. Copies share it. Calls are thread-safe if the stored
/// function is. Call only when not empty.
template <class Result, class... Arguments>
class Function<Result(Arguments...)> : public FunctionHandle {
    struct Callable : Held {
        Result (*call)(const Held*, Arguments&&...);
        Callable(void (*drop_it)(const Held*), Result (*call_it)(const Held*, Arguments&&...))
            : Held(drop_it), call(call_it) {}
    };

    template <class F>
    struct Of final : Callable {
        F function;
        explicit Of(F&& given) : Callable(&drop, &call), function(std::move(given)) {}
        static void drop(const Held* held) { delete static_cast<const Of*>(held); }
        static Result call(const Held* held, Arguments&&... arguments) {
            return static_cast<const Of*>(held)->function(std::forward<Arguments>(arguments)...);
        }
    };

  public:
    Function() = default;
    template <class F>
    requires(!std::derived_from<F, FunctionHandle>) Function(F function)
        : FunctionHandle(new Of<F>(std::move(function))) {}

    Result operator()(Arguments... arguments) const {
        return static_cast<const Callable*>(held)->call(held, std::forward<Arguments>(arguments)...);
    }
};

} // namespace facetmill
