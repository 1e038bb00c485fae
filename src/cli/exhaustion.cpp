#include "cli/exhaustion.hpp"

#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "io/outputs/clean_up.hpp"

#include <atomic>
#include <cstdlib>
#include <exception>
#include <new>

namespace facetmill::cli {

namespace {

constexpr std::size_t reserve_bytes = std::size_t{1} << 20;
/// The largest request of messages and destructors. Destructors of JSON values allocate a list of their
/// contents, and may not throw.
constexpr std::size_t small_bytes = std::size_t{1} << 16;

std::atomic<void*> reserve{nullptr};

bool small_requests_succeed() {
    void* volatile probe = std::malloc(small_bytes); // volatile, because a compiler may remove the pair
    std::free(probe);
    return probe != nullptr;
}

void end_for_memory() {
    io::end_at_once(static_cast<int>(ErrorKind::limit), "facetmill: error[E-MEMORY]: not enough memory\n");
}

std::terminate_handler usual_end = nullptr;

/// Handles uncaught exceptions: before main, or from a destructor.
[[noreturn]] void on_terminate() {
    try {
        if (const auto why = std::current_exception()) std::rethrow_exception(why);
    } catch (const std::exception& e) {
        if (is_out_of_memory(e) || is_want_of_threads(e)) end_for_memory();
    } catch (...) {
    }
    if (usual_end) usual_end();
    std::abort();
}

/// Runs before the registries of stages and codecs are built, which is before main.
struct BeforeRegistries {
    BeforeRegistries() { usual_end = std::set_terminate(on_terminate); }
};
[[gnu::init_priority(101)]] const BeforeRegistries before_registries;

void on_failed_request() {
    if (small_requests_succeed()) throw std::bad_alloc();
    if (void* const given = reserve.exchange(nullptr)) {
        std::free(given);
        return; // the allocator tries the request again
    }
    end_for_memory();
    throw std::bad_alloc();
}

} // namespace

void prepare_for_exhaustion() {
    if (reserve == nullptr) reserve = std::malloc(reserve_bytes);
    std::set_new_handler(on_failed_request);
}

} // namespace facetmill::cli
