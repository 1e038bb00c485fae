#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "stage/contract.hpp"

using namespace facetmill;

namespace {

Value map(const char* key, Value value) { return Value::map({{key, {}, std::move(value)}}); }

std::string deviation_complaint(const Value& deviation) {
    Problems problems;
    Contract out;
    CHECK_FALSE(parse_contract(map("deviation", deviation), out, problems));
    const auto& d = problems.all().at(0);
    return d.id + " " + d.message + (d.hint.empty() ? "" : " (" + d.hint + ")");
}

DeviationLimits limits(const Value& deviation) {
    Problems problems;
    Contract out;
    REQUIRE(parse_contract(map("deviation", deviation), out, problems));
    return out.deviation.value();
}

Scene lifted_scene(Mesh mesh, double lift = 0) {
    Scene scene;
    scene.parts.emplace_back().mesh = std::move(mesh);
    scene.parts[0].transform.m[2][3] = lift;
    return scene;
}

/// The checks of a sheet lifted by 0.01 of its diagonal of 5.
std::vector<report::Check> judged_deviation(const Value& deviation, double lift = 0.05) {
    RunState run;
    report::StageRecord record;
    const PartFilter all;
    Context context(run, record, all, {}, {});
    check_deviation(limits(deviation), {}, surface_of(lifted_scene(shapes::grid(4, 3))),
                    lifted_scene(shapes::grid(4, 3), lift), context);
    CHECK(record.result["deviation"]["seed"] == 1);
    return run.record.checks;
}

} // namespace

TEST_CASE("a bare deviation limits the maximum", "[stage]") {
    CHECK(limits(Value::scalar("0.5%")).max->text == "0.5%");
    CHECK_FALSE(limits(Value::scalar("2")).rms.has_value());
    CHECK(to_string(limits(map("rms", Value::scalar("1mm")))) == "rms 1mm");
}

TEST_CASE("a deviation without a limit, or with an unknown key, is refused", "[stage]") {
    CHECK(deviation_complaint(map("samples", Value::scalar("10"))) ==
          "E-MISSING deviation needs a limit: max, rms or mean (deviation: {max: 0.5%})");
    CHECK(deviation_complaint(map("maximum", Value::scalar("1"))) ==
          "E-KEY deviation has no option 'maximum' (expected one of: max, rms, mean, from, samples, seed, "
          "certify)");
    CHECK(deviation_complaint(Value::scalar("-1")).starts_with("E-RANGE"));
    CHECK(deviation_complaint(Value::scalar("true")).starts_with("E-TYPE"));
}

TEST_CASE("a lift within the limit passes, one beyond it fails with its place", "[stage]") {
    const auto passed = judged_deviation(Value::scalar("1.1%"));
    REQUIRE(passed.size() == 1);
    CHECK(passed[0].passed);
    CHECK(passed[0].name == "deviation");
    CHECK(passed[0].expected == "at most 1.1% (0.055)");
    CHECK(std::get<double>(passed[0].found) == Approx(0.05));
    CHECK(passed[0].found_words == "0.05 (1 % of the diagonal)");
    CHECK_FALSE(passed[0].evidence);
    const auto failed = judged_deviation(map("max", Value::scalar("0.04")));
    CHECK_FALSE(failed[0].passed);
    CHECK(failed[0].expected == "at most 0.04");
    CHECK(failed[0].evidence.value().at(0).at.value().z == 0);
    CHECK(failed[0].evidence->at(0).nearest.value().z == Approx(0.05));
}

TEST_CASE("every limit is a check of its own", "[stage]") {
    Value all = map("max", Value::scalar("1"));
    all.set("rms", Value::scalar("0.01"));
    all.set("mean", Value::scalar("0.06"));
    const auto checks = judged_deviation(all);
    REQUIRE(checks.size() == 3);
    CHECK(checks[1].name == "deviation.rms");
    CHECK((checks[0].passed && !checks[1].passed && checks[2].passed));
}

TEST_CASE("certified, the bound is held against the limit", "[stage]") {
    Value sure = map("max", Value::scalar("1.1%"));
    sure.set("certify", Value::scalar("true"));
    const auto checks = judged_deviation(sure);
    CHECK(checks[0].passed);
    CHECK(checks[0].found_words.starts_with("certainly at most 0.05"));
}

TEST_CASE("nothing deviates infinitely from something", "[stage]") {
    RunState run;
    report::StageRecord record;
    const PartFilter all;
    Context context(run, record, all, {}, {});
    check_deviation(limits(Value::scalar("10%")), {}, {}, lifted_scene(shapes::cube()), context);
    CHECK_FALSE(run.record.checks.at(0).passed);
    CHECK(run.record.checks.at(0).found_words == "nothing to compare with");
}
