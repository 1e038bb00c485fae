#include "support/catch.hpp"

#include "stage/assertions.hpp"
#include "stage/context.hpp"

using namespace facetmill;

namespace {

Value entry(const char* key, Value value) { return Value::map({{key, {}, std::move(value)}}); }

std::string limits_complaint(const Value& value) {
    Problems problems;
    Assertions out;
    CHECK_FALSE(parse_assertions(value, out, "ensure", problems));
    const auto& d = problems.all().at(0);
    return d.id + " " + d.message + (d.hint.empty() ? "" : " (" + d.hint + ")");
}

Box unit_box() {
    Box box;
    box.add(Vec3{0, 0, 0});
    box.add(Vec3{1, 1, 1});
    return box;
}

/// Judged in a scene in metres with the diagonal of the unit cube.
report::Check judged_limits(const Value& value, const Properties& properties) {
    Problems problems;
    Assertions out;
    CHECK(parse_assertions(value, out, "ensure", problems));
    RunState run;
    report::StageRecord record;
    const PartFilter all;
    Scene scene;
    scene.unit = Unit::m;
    Context context(run, record, all, unit_box(), {});
    return evaluate(resolved(out, scene, context), properties, "ensure").at(0);
}

Value numbers(std::initializer_list<const char*> texts) {
    std::vector<Value> items;
    for (const char* t : texts) items.push_back(Value::scalar(t));
    return Value::list(std::move(items));
}

} // namespace

TEST_CASE("assertions name a property and a bound of its kind", "[stage]") {
    CHECK(limits_complaint(entry("closd", Value::scalar("true"))) ==
          "E-KEY ensure has no property 'closd' (did you mean 'closed'?)");
    CHECK(limits_complaint(entry("closed", Value::scalar("3"))) ==
          "E-TYPE 'closed' is true or false, found '3'");
    CHECK(limits_complaint(entry("faces", Value::scalar("true"))) ==
          "E-TYPE 'faces' is a number (2) or a range ({min: 1, max: 5}), found 'true'");
    CHECK(limits_complaint(Value::scalar("closed")) ==
          "E-TYPE ensure needs a map of properties ({closed: true}), found 'closed'");
}

TEST_CASE("a bound holds or says what was expected and found", "[stage]") {
    Properties p;
    p.faces = 12;
    p.closed = false;
    CHECK(judged_limits(entry("faces", Value::scalar("12")), p).passed);
    const auto few = judged_limits(entry("faces", entry("max", Value::scalar("10"))), p);
    CHECK_FALSE(few.passed);
    CHECK(few.expected == "at most 10");
    CHECK(few.found == report::Found(12));
    CHECK(judged_limits(entry("faces", entry("max", Value::scalar("100000"))), p).expected ==
          "at most 100000");
    const auto closed = judged_limits(entry("closed", Value::scalar("true")), p);
    CHECK_FALSE(closed.passed);
    CHECK(closed.found == report::Found(false));
    CHECK(judged_limits(entry("closed", Value::scalar("false")), p).passed);
}

TEST_CASE("a hint is for the way that it helps", "[stage]") {
    Properties p;
    p.faces = 1;
    p.requested = {{property_named("min_angle"), 12}};
    CHECK_FALSE(judged_limits(entry("min_angle", entry("min", Value::scalar("20"))), p).hint.empty());
    const auto too_large = judged_limits(entry("min_angle", entry("max", Value::scalar("5"))), p);
    CHECK_FALSE(too_large.passed);
    CHECK(too_large.hint.empty());
    p.faces = 0;
    const auto nothing = judged_limits(entry("min_angle", entry("max", Value::scalar("5"))), p);
    CHECK(nothing.hint.starts_with("no faces are left"));
}

TEST_CASE("a property that does not apply never holds", "[stage]") {
    CHECK_FALSE(judged_limits(entry("volume", entry("min", Value::scalar("0"))), {}).passed);
    CHECK(judged_limits(entry("volume", entry("min", Value::scalar("0"))), {}).found == report::Found());
    CHECK(judged_limits(entry("self_intersections", Value::scalar("0")), {}).found_words == "not computed");
}

TEST_CASE("lengths are written with units and percentages, and resolved", "[stage]") {
    Properties p;
    p.requested.emplace_back(property_named("longest_edge"), 0.25);
    const auto longest = [&](Value bound) {
        return judged_limits(entry("longest_edge", std::move(bound)), p);
    };
    CHECK(longest(entry("max", Value::scalar("25cm"))).passed);
    const auto failed = longest(entry("max", Value::scalar("20cm")));
    CHECK_FALSE(failed.passed);
    CHECK(failed.expected == "at most 20cm (0.2)");
    CHECK(failed.found == report::Found(0.25));
    CHECK(longest(entry("max", Value::scalar("0.2"))).expected == "at most 0.2");
    CHECK(longest(entry("min", Value::scalar("10%"))).expected == "at least 10% (0.173205)");
    CHECK(longest(Value::scalar("250mm")).passed);
    CHECK(limits_complaint(entry("longest_edge", Value::scalar("true"))) ==
          "E-TYPE 'longest_edge' is a length (2mm) or a range ({min: 1mm, max: 5%}), found 'true'");
    CHECK(limits_complaint(entry("max_extent", Value::map({{"min", {}, Value::scalar("2mm")},
                                                           {"max", {}, Value::scalar("1mm")}}))) ==
          "E-RANGE min is larger than max, so no length is in the range (exchange min and max)");
}

TEST_CASE("bounds lie between two corners", "[stage]") {
    Properties p;
    p.bounds = unit_box();
    const auto within = [&](const char* key, Value corner) {
        return judged_limits(entry("bounds", entry(key, std::move(corner))), p);
    };
    CHECK(within("max", numbers({"1", "100cm", "1"})).passed);
    const auto low = within("max", numbers({"1", "1", "99cm"}));
    CHECK_FALSE(low.passed);
    CHECK(low.expected == "at most [1, 1, 99cm] (1, 1, 0.99)");
    CHECK(low.found == report::Found(report::Corners{{0, 0, 0}, {1, 1, 1}}));
    CHECK(within("min", numbers({"0", "0", "0"})).passed);
    CHECK_FALSE(within("min", numbers({"0", "0.1", "0"})).passed);
    CHECK(judged_limits(entry("bounds", entry("max", Value::scalar("1,1,1"))), p)
              .passed); // as a one-liner has it
    CHECK(judged_limits(entry("bounds", entry("max", numbers({"1", "1", "1"}))), {}).found ==
          report::Found());
    CHECK(limits_complaint(entry("bounds", Value::scalar("5"))) ==
          "E-TYPE 'bounds' is a box ({min: [0, 0, 0], max: [20cm, 20cm, 5cm]}), found '5'");
    CHECK(limits_complaint(entry("bounds", entry("max", numbers({"1", "1"})))).substr(0, 30) ==
          "E-TYPE expected three lengths ");
}

TEST_CASE("unit, up, parts and materials are asserted like the rest", "[stage]") {
    Scene scene;
    scene.unit = Unit::mm;
    scene.up = UpAxis::z;
    scene.parts.resize(2);
    const Properties p = inspect(scene);
    CHECK(judged_limits(entry("unit", Value::scalar("mm")), p).passed);
    const auto inches = judged_limits(entry("unit", Value::scalar("in")), p);
    CHECK_FALSE(inches.passed);
    CHECK((inches.expected == "in" && inches.found == report::Found("mm")));
    CHECK(judged_limits(entry("up", Value::scalar("z")), p).passed);
    CHECK(judged_limits(entry("parts", Value::scalar("2")), p).passed);
    CHECK(judged_limits(entry("materials", entry("max", Value::scalar("0"))), p).passed);
    CHECK(
        limits_complaint(entry("unit", Value::scalar("mn"))) ==
        "E-CHOICE 'unit' must be one of unknown, um, mm, cm, m, km, in, ft, found 'mn' (did you mean 'mm'?)");
}

TEST_CASE("assertions are spelled as they can be written", "[stage]") {
    const auto again = [](Value value) {
        Problems problems;
        Assertions out;
        CHECK(parse_assertions(value, out, "ensure", problems));
        return to_string(out.all.at(0));
    };
    CHECK(again(entry("unit", Value::scalar("mm"))) == "mm");
    CHECK(again(entry("closed", Value::scalar("true"))) == "true");
    CHECK(again(entry("faces", entry("max", Value::scalar("5")))) == "{max: 5}");
    CHECK(again(entry("max_extent", entry("max", Value::scalar("5mm")))) == "{max: 5mm}");
    CHECK(again(entry("bounds", entry("min", numbers({"0", "0", "1mm"})))) == "{min: [0, 0, 1mm]}");
}
