#include "base/out_of_memory.hpp"

#include <fmt/format.h>
#include <new>
#include <string_view>
#include <system_error>

namespace facetmill {

bool is_out_of_memory(const std::exception& e) {
    if (dynamic_cast<const std::bad_alloc*>(&e)) return true;
    const auto* const call = dynamic_cast<const std::system_error*>(&e);
    return call && call->code() == std::errc::not_enough_memory;
}

bool is_want_of_threads(const std::exception& e) {
    if (const auto* const call = dynamic_cast<const std::system_error*>(&e))
        return call->code() == std::errc::resource_unavailable_try_again;
    return std::string_view(e.what()).starts_with("pthread_create has failed"); // TBB gives only a text
}

std::optional<Error> told_as_limit(const std::exception& e, const std::string& what, Mark where) {
    const std::string whom = what.empty() ? "" : " for " + what;
    if (is_out_of_memory(e))
        return out_of_memory("not enough memory" + whom,
                             what.empty() ? "" : "simplify earlier, or use a machine with more memory",
                             std::move(where));
    if (is_want_of_threads(e))
        return out_of_memory(
            fmt::format(
                "a thread cannot start{}: there is not enough memory, or the limit of threads is reached",
                whom),
            "use -j 1, which needs no other threads, or raise the limits (ulimit -v and -u, or the "
            "container)",
            std::move(where));
    return {};
}

} // namespace facetmill
