#include "report/check_text.hpp"
#include "support/catch.hpp"

using namespace facetmill;
using report::EvidenceEntry;
using report::found_text;
using report::locations_text;
using Of = report::EvidenceEntry::Of;

namespace {

std::string in_words(std::optional<report::CheckEvidence> evidence, std::optional<std::size_t> locations = {},
                     std::optional<std::size_t> fresh = {}) {
    report::Check check;
    check.evidence = std::move(evidence);
    check.locations = locations;
    check.fresh = fresh;
    return locations_text(check);
}

} // namespace

TEST_CASE("what speaks against an assertion, in words", "[report]") {
    const EvidenceEntry place{
        .of = Of::part, .name = "a", .at = Vec3{1, 2.5, 3}, .face = 7, .with = 9, .attribute = "NORMAL"};
    using Places = report::CheckEvidence;
    CHECK(in_words(Places{place}) == "first: face 7 and 9 of 'a' at 1 2.5 3 in NORMAL");
    CHECK(in_words(Places{place}, 12).starts_with("12 locations, first: face 7"));
    CHECK(in_words(Places{place}, 1).starts_with("1 location, first: face 7"));
    CHECK(in_words(Places{place}, 12, 2).starts_with("12 locations, 2 new, first: face 7"));
    CHECK(in_words(Places{place}, {}, 2).starts_with("2 new, first: face 7"));
    CHECK(in_words(Places{place}, 12, 0).starts_with("12 locations, first: face 7"));
    CHECK(in_words({}) == "");
    CHECK(in_words(Places{}) == "");
}

TEST_CASE("what was found, in words", "[report]") {
    const auto found = [](report::Found value, std::string words = {}) {
        report::Check check;
        check.found = std::move(value);
        check.found_words = std::move(words);
        return found_text(check);
    };
    CHECK(found(12) == "12");
    CHECK(found(0.1) == "0.1");
    CHECK(found(false) == "false");
    CHECK(found("mm") == "mm");
    CHECK(found(report::Corners{{0, 0, 0.5}, {1, 1, 1}}) == "[0, 0, 0.5] to [1, 1, 1]");
    CHECK(found(std::vector<std::string>{"a", "b"}) == "a, b");
    CHECK(found({}) == "not applicable");
    CHECK(found(0.05, "0.05 (1 % of the diagonal)") == "0.05 (1 % of the diagonal)");
}

TEST_CASE("what counts towards a limit, in words", "[report]") {
    using Shares = report::CheckEvidence;
    CHECK(in_words(Shares{{.of = Of::part, .name = "wheel", .amount = 1200000},
                          {.of = Of::part, .name = "body", .amount = 0.5}}) ==
          "part 'wheel' 1200000, part 'body' 0.5");
    CHECK(in_words(
              Shares{{.of = Of::image, .name = "wood", .width = 2048, .height = 1024, .amount = 2097152}}) ==
          "image 'wood' 2048 x 1024");
    CHECK(in_words(Shares{{.of = Of::extension, .name = "KHR_a", .document = "b.glb"}}) ==
          "extension 'KHR_a' of 'b.glb'");
    CHECK(in_words(Shares{{.of = Of::bytes, .name = "b.glb: buffer 0", .amount = 1000}}) ==
          "b.glb: buffer 0, 1000 bytes");
    Shares parts;
    for (const char* name : {"a", "b", "c", "d"}) parts.push_back({.of = Of::part, .name = name});
    CHECK(in_words(parts) == "part 'a', part 'b', part 'c' ...");
}
