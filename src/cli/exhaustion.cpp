#include "cli/exhaustion.hpp"

#include "base/error.hpp"
#include "io/clean_up.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace facetmill::cli {

namespace {

constexpr std::size_t reserve_bytes = std::size_t{1} << 20;
/// Messages and destructors ask for no more at a time (those of JSON values ask for a list of what is in
/// them, and may not throw).
constexpr std::size_t small_bytes = std::size_t{1} << 16;

std::atomic<void*> reserve{nullptr};

bool small_requests_succeed() {
    void* volatile probe = std::malloc(small_bytes); // volatile: a compiler may leave out the pair
    std::free(probe);
    return probe != nullptr;
}

void on_failed_request() {
    if (small_requests_succeed()) throw std::bad_alloc();
    if (void* const given = reserve.exchange(nullptr)) {
        std::free(given);
        return; // the request is tried again
    }
    io::end_at_once(static_cast<int>(ErrorKind::limit), "facetmill: error[E-MEMORY]: not enough memory\n");
    throw std::bad_alloc();
}

} // namespace

void prepare_for_exhaustion() {
    if (reserve == nullptr) reserve = std::malloc(reserve_bytes);
    std::set_new_handler(on_failed_request);
}

} // namespace facetmill::cli
