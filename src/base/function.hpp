#pragma once
// What declarations hold of functions. A std::function costs the compiler some ten functions for each lambda
// that is put into one, and the stages have hundreds; this one costs it two.

#include <atomic>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace facetmill {

/// What a Function holds, shared by its copies. (Compiled once, in function.cpp.)
class FunctionHandle {
  public:
    struct Held {
        explicit Held(void (*drop_it)(const Held*)) : drop(drop_it) {}
        Held(const Held&) = delete;
        Held& operator=(const Held&) = delete;

        mutable std::atomic<std::size_t> owners{1};
        void (*drop)(const Held*); ///< deletes it as what it was made
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

/// A function of these arguments that cannot change, or none. Copies share it; calling it is safe from
/// several threads when it is so of what was put in. There must be one to call.
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
