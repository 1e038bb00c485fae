// Checks the documentation of every registered stage.

#include "docs/describe.hpp"
#include "docs/ready.hpp"
#include "docs/stages.hpp"

#include "pipeline/document.hpp"
#include "pipeline/plan.hpp"
#include "support/catch.hpp"

using namespace facetmill;

namespace {

void check_option(const std::string& where, const Declaration& declaration, const Option& option) {
    INFO(where << ": " << option.name);
    CHECK_FALSE(option.help.empty());
    for (const char c : option.name)
        CHECK(((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'));
    CHECK_FALSE((option.required && !option.default_text.empty()));
    CHECK(declaration.find(option.name) == &option); // no name twice
    for (const auto& choice : option.choices) CHECK_FALSE(choice.help.empty());
    if (option.fields)
        for (const auto& field : option.fields->options)
            check_option(where + "." + option.name, *option.fields, field);
}

/// The stages of the product: the tests of the language register some of their own, named test-*.
std::vector<StageInfo> shipped() {
    std::vector<StageInfo> all;
    for (const auto& stage : stages())
        if (!stage.name.starts_with("test-")) all.push_back(stage);
    return all;
}

/// The default's spelling, read again, is a value inside the range.
void check_default(const StageInfo& stage, const Option& option) {
    if (option.default_text.empty() || option.kind == OptionKind::group ||
        option.kind == OptionKind::assertions)
        return;
    INFO(stage.name << ": " << option.name << " = " << option.default_text);
    Problems problems;
    const auto source =
        std::make_shared<const SourceText>(SourceText{"default", option.name + ": " + option.default_text});
    const Value value = pipeline::parse_yaml(source, problems);
    const auto use = stage.made();
    REQUIRE(problems.size() == 0);
    REQUIRE(value.find(option.name));
    CHECK(option.parse(option, *value.find(option.name), use->target(), problems));
    if (const auto magnitude = option.magnitude ? option.magnitude(use->target()) : std::nullopt)
        CHECK(option.range.holds(*magnitude));
    for (const auto& d : problems.all()) UNSCOPED_INFO(render(d));
    CHECK(problems.size() == 0);
}

} // namespace

TEST_CASE("every option has help, a sound name and described choices", "[docs]") {
    REQUIRE(shipped().size() >= 9);
    for (const auto& stage : shipped())
        for (const auto& option : stage.options->options) check_option(stage.name, *stage.options, option);
}

TEST_CASE("every default reads back and lies in its range", "[docs]") {
    for (const auto& stage : shipped())
        for (const auto& option : stage.options->options) check_default(stage, option);
}

TEST_CASE("every stage says what it does and shows how", "[docs]") {
    for (const auto& stage : shipped()) {
        INFO(stage.name);
        CHECK_FALSE(stage.about.empty());
        CHECK(stage.about.back() == '.');
        CHECK_FALSE(std::string_view(stage.details).empty());
        CHECK_FALSE(stage.examples.empty());
    }
}

TEST_CASE("every example of every stage is a legal step", "[docs]") {
    for (const auto& stage : shipped())
        for (const auto& example : stage.examples) {
            const bool first = stage.loads;
            const std::string text = "facetmill: 1\nstages:\n" +
                                     std::string(first ? "" : "  - load: in.ply\n") + "  - " + example + "\n";
            INFO(text);
            Problems problems;
            const auto source = std::make_shared<const SourceText>(SourceText{"example", text});
            const Value document = pipeline::parse_yaml(source, problems);
            pipeline::PlanSettings settings;
            settings.parameters_needed = false;
            if (!problems.any_errors()) pipeline::make_plan(document, settings, problems);
            for (const auto& d : problems.all()) UNSCOPED_INFO(render(d));
            CHECK_FALSE(problems.any_errors());
        }
}

TEST_CASE("numbers with a dimension say how they are spelled", "[docs]") {
    for (const auto& stage : shipped()) {
        const std::string page = docs::stage_page(stage);
        for (const auto& row : docs::rows(*stage.options)) {
            const std::string help = docs::spelling_help(row.dimension);
            INFO(stage.name << ": " << row.name);
            if (!help.empty()) CHECK(page.find(help.substr(0, 30)) != std::string::npos);
        }
    }
}

TEST_CASE("ready pipelines are embedded and right", "[docs]") {
    REQUIRE(docs::ready_pipelines().size() >= 3);
    for (const auto& ready : docs::ready_pipelines()) {
        INFO(ready.name);
        Problems problems;
        const auto source =
            std::make_shared<const SourceText>(SourceText{std::string(ready.name), std::string(ready.text)});
        const Value document = pipeline::parse_yaml(source, problems);
        pipeline::PlanSettings settings;
        settings.parameters_needed = false;
        pipeline::make_plan(document, settings, problems);
        for (const auto& d : problems.all()) UNSCOPED_INFO(render(d));
        CHECK(problems.size() == 0);
        CHECK(docs::ready_pipeline(ready.name) == &ready);
    }
    CHECK(docs::ready_pipeline("nothing") == nullptr);
}

namespace {

/// Whether field names are distinct within a record and its nested records, if both fields may be present.
bool names_differ(const Fields& fields) {
    std::set<std::string> always;
    for (const Field& field : fields.all) {
        if (field.only_when.empty() && !always.insert(field.name).second) return false;
        if (!field.only_when.empty() && always.contains(field.name)) return false;
        if (field.fields && !names_differ(*field.fields)) return false;
    }
    return true;
}

} // namespace

TEST_CASE("the fields of a record have names of their own, so that none is looked for", "[docs]") {
    for (const StageInfo& stage : stages()) {
        INFO(stage.name);
        CHECK(names_differ(*stage.result));
    }
}
