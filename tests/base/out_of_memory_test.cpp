#include "support/catch.hpp"

#include "base/out_of_memory.hpp"

#include <stdexcept>
#include <system_error>

using namespace facetmill;

TEST_CASE("what ends for want of memory or threads is told as a limit", "[base]") {
    const std::system_error no_memory(std::make_error_code(std::errc::not_enough_memory)),
        no_thread(std::make_error_code(std::errc::resource_unavailable_try_again)),
        other(std::make_error_code(std::errc::permission_denied));
    const auto told = [](const std::exception& e) {
        const auto error = told_as_limit(e, "'relax'");
        return error ? error->diagnostics().front().message : "nothing";
    };
    CHECK(told(std::bad_alloc()) == "not enough memory for 'relax'");
    CHECK(told(no_memory) == "not enough memory for 'relax'");
    CHECK(told(no_thread).starts_with("a thread cannot start for 'relax'"));
    CHECK(told(std::runtime_error("pthread_create has failed: Resource temporarily unavailable")) ==
          told(no_thread));
    CHECK(told(other) == "nothing");
    CHECK(told(std::runtime_error("a pthread")) == "nothing");
    CHECK(told_as_limit(std::bad_alloc())->kind() == ErrorKind::limit);
    CHECK(told_as_limit(no_thread)->diagnostics().front().out_of_memory);
}
