#include "support/catch.hpp"

#include "base/message_ids.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/customer.hpp"

#include <regex>

using namespace facetmill;
using namespace facetmill::report;

namespace {

RunRecord failed_at(const std::string& property, Found found, CheckEvidence evidence = {}) {
    RunRecord record;
    record.exit_code = 1;
    Check check;
    check.name = property;
    check.passed = false;
    check.expected = "true";
    check.found = std::move(found);
    check.evidence = std::move(evidence);
    record.checks.push_back(check);
    record.errors.push_back({{Severity::error, "E-CHECK", "'closed' must be true", {}, ""}, true});
    return record;
}

EvidenceEntry hole_at(const Vec3& at, std::size_t loop) {
    EvidenceEntry entry{EvidenceEntry::Of::part, "a"};
    entry.at = at;
    entry.loop = loop;
    return entry;
}

void add_clean(RunRecord& record, const char* step, const char* why) {
    StageRecord stage;
    stage.stage = "clean";
    stage.result = {{"parts", Json::array({{{"not_done", Json::array({{{"step", step}, {"why", why}}})}}})}};
    record.stages.push_back(stage);
}

/// Whole sentences, without ids, options and names in underscores.
void check_plain(const std::string& text) {
    INFO(text);
    REQUIRE_FALSE(text.empty());
    CHECK(text.back() == '.');
    CHECK_FALSE(std::regex_search(text, std::regex("[EW]-[A-Z]|_|\\{|--")));
}

} // namespace

TEST_CASE("a customer reads where a hole is and why it stays", "[customer]") {
    RunRecord record = failed_at("closed", false, {hole_at({1, 2, 3.5}, 0)});
    CHECK(customer_text(record) == "The model has a hole near (1, 2, 3.5). We did not close it, because this "
                                   "check does not change models. "
                                   "Please close it in your modelling program, and send the file again.");
    add_clean(record, "holes", "a patch would intersect other faces");
    CHECK(customer_text(record) ==
          "The model has a hole near (1, 2, 3.5). We could not close it, because a cover would pass through "
          "other "
          "parts of the model. Please close it in your modelling program, and send the file again.");
    record.checks[0].evidence->push_back(hole_at({4, 5, 6}, 1));
    CHECK(customer_text(record).starts_with("The model has 2 holes, one of them near (1, 2, 3.5). "));
    record.stages.clear();
    add_clean(record, "holes", "it is the boundary of a single face");
    CHECK(customer_text(record).starts_with("The model consists of loose triangles"));
}

TEST_CASE("the cause stands for its consequences", "[customer]") {
    RunRecord record = failed_at("closed", false);
    Check other = record.checks[0];
    other.name = "boundary_loops";
    record.checks.push_back(other);
    other.name = "oriented";
    record.checks.push_back(other);
    StageRecord orient;
    orient.stage = "orient";
    orient.result = {{"parts", Json::array({{{"non_orientable_components", 1}}})}};
    record.stages.push_back(orient);
    const std::string text = customer_text(record);
    CHECK(text.starts_with("The surface of the model has only one side"));
    CHECK(text.find("hole") == text.npos);
}

TEST_CASE("a customer reads which file is missing, and that a file has no faces", "[customer]") {
    const Diagnostic missing{
        Severity::error, "E-FILE", "buffers[0].uri: the file \"in/a b.bin\" is missing", {}, ""};
    CHECK(customer_text(missing, ErrorKind::missing)
              .starts_with("The file refers to 'a b.bin', which we did not"));
    RunRecord record = failed_at("faces", std::int64_t{0});
    Check other = record.checks[0];
    other.name = "wall_thickness";
    other.found = {};
    record.checks.push_back(other);
    CHECK(customer_text(record).starts_with("The file has no surface"));
    CHECK(customer_text(record).find("wall") == std::string::npos);
}

TEST_CASE("every property and every error has a text in plain words", "[customer]") {
    for (const Property& property : property_table())
        for (const bool repaired : {false, true}) {
            RunRecord record = failed_at(std::string(property.name), 0.5, {hole_at({1, 2, 3}, 0)});
            if (repaired) add_clean(record, "", "");
            check_plain(customer_text(record));
        }
    for (const MessageId& id : message_ids())
        for (const ErrorKind kind : id.kinds)
            check_plain(customer_text(Diagnostic{Severity::error, std::string(id.id), "a_b", {}, ""}, kind));
}

TEST_CASE("the customer is not blamed for our faults", "[customer]") {
    for (const ErrorKind kind : {ErrorKind::usage, ErrorKind::output, ErrorKind::bug})
        CHECK(customer_text(Diagnostic{Severity::error, "E-EMPTY", "", {}, ""}, kind).find("our side") !=
              std::string::npos);
    RunRecord passed;
    CHECK(customer_text(passed).empty());
}
