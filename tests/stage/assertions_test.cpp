#include "support/catch.hpp"

#include "stage/assertions.hpp"

using namespace facetmill;

namespace {

Value entry(const char* key, Value value) { return Value::map({{key, {}, std::move(value)}}); }

std::string complaint(const Value& value) {
    Problems problems;
    Assertions out;
    CHECK_FALSE(parse_assertions(value, out, "ensure", problems));
    const auto& d = problems.all().at(0);
    return d.id + " " + d.message + (d.hint.empty() ? "" : " (" + d.hint + ")");
}

report::Check judged(const Value& value, const Properties& properties) {
    Problems problems;
    Assertions out;
    CHECK(parse_assertions(value, out, "ensure", problems));
    return evaluate(out, properties, "ensure").at(0);
}

} // namespace

TEST_CASE("assertions name a property and a bound of its kind", "[stage]") {
    CHECK(complaint(entry("closd", Value::scalar("true"))) ==
          "E-KEY ensure knows no property 'closd' (did you mean 'closed'?)");
    CHECK(complaint(entry("closed", Value::scalar("3"))) == "E-TYPE 'closed' is true or false, found '3'");
    CHECK(complaint(entry("faces", Value::scalar("true"))) ==
          "E-TYPE 'faces' is a number (2) or a range ({min: 1, max: 5}), found 'true'");
    CHECK(complaint(Value::scalar("closed")) ==
          "E-TYPE ensure takes a map of properties ({closed: true}), found 'closed'");
}

TEST_CASE("a bound holds or says what was expected and found", "[stage]") {
    Properties p;
    p.faces = 12;
    p.closed = false;
    CHECK(judged(entry("faces", Value::scalar("12")), p).passed);
    const auto few = judged(entry("faces", entry("max", Value::scalar("10"))), p);
    CHECK_FALSE(few.passed);
    CHECK(few.expected == "at most 10");
    CHECK(few.found == "12");
    const auto closed = judged(entry("closed", Value::scalar("true")), p);
    CHECK_FALSE(closed.passed);
    CHECK(closed.found == "false");
    CHECK(judged(entry("closed", Value::scalar("false")), p).passed);
}

TEST_CASE("a property that does not apply never holds", "[stage]") {
    CHECK_FALSE(judged(entry("volume", entry("min", Value::scalar("0"))), {}).passed);
    CHECK(judged(entry("volume", entry("min", Value::scalar("0"))), {}).found == "not applicable");
    CHECK(judged(entry("self_intersections", Value::scalar("0")), {}).found == "not computed");
}
