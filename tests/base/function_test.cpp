#include "support/catch.hpp"

#include "base/function.hpp"

#include <memory>
#include <string>
#include <utility>

using namespace facetmill;

TEST_CASE("copies of a function share what it holds, which goes with the last of them", "[base]") {
    const auto held = std::make_shared<int>(7);
    Function<int(int)> first = [held](int x) { return x + *held; };
    CHECK(held.use_count() == 2);
    {
        Function<int(int)> second = first, third;
        third = second;
        second = {};
        CHECK_FALSE(second);
        CHECK(third(1) == 8);
        CHECK(held.use_count() == 2);
    }
    first = Function<int(int)>(std::move(first));
    CHECK(first(2) == 9);
    Function<int(int)> taken = std::move(first);
    CHECK(taken(3) == 10);
    const auto other = std::make_shared<int>(1);
    taken = [other](int x) { return x - *other; };
    CHECK(held.use_count() == 1);
    CHECK(taken(3) == 2);
    taken = std::as_const(taken);
    CHECK(taken(3) == 2);
    CHECK(other.use_count() == 2);
}

TEST_CASE("a function passes its arguments on as they are given", "[base]") {
    const Function<std::string(std::unique_ptr<std::string>, std::string&)> f =
        [](std::unique_ptr<std::string> owned, std::string& changed) {
            changed += "!";
            return *owned + changed;
        };
    std::string changed = "b";
    CHECK(f(std::make_unique<std::string>("a"), changed) == "ab!");
    CHECK(changed == "b!");
    CHECK_FALSE(Function<void()>());
}
