// Checks which results a run takes from the cache, also after changes of the cache or an input.

#include "support/catch.hpp"

#include "pipeline/run.hpp"
#include "pipeline/scene_state.hpp"
#include "support/planning.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>

using namespace facetmill;
using Way = pipeline::TracedStep::Way;

namespace {

constexpr const char* tetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

/// A directory with the input a.off and a cache, in which pipelines run.
struct Works {
    test::TemporaryDirectory directory;
    cache::Store store{{directory / "cache", 1 << 20, true}};
    pipeline::RunSettings settings;
    pipeline::Trace trace;

    Works() {
        test::put(directory / "a.off", tetrahedron);
        settings.store = &store;
        settings.on_trace = [this](const pipeline::Trace& t) { trace = t; };
    }
    report::RunRecord run(const std::string& stages) {
        pipeline::PlanSettings plan;
        plan.places = {directory.path(), directory.path()};
        auto result = planned_stages(stages, plan);
        if (!result.problems.empty()) FAIL(result.problems);
        return pipeline::run_plan(result.plan, settings);
    }
    /// The steps, by the first letters of their outcome: "load r, write a".
    std::string ways() const {
        const char* words[] = {"ran", "recalled", "again", "always", "skipped"};
        std::string out;
        for (const auto& step : trace)
            out += fmt::format("{}{} {}", out.empty() ? "" : ", ", step.name,
                               words[static_cast<std::size_t>(step.way)]);
        return out;
    }
    void remove(const char* suffix) {
        for (const auto& name : directory.names())
            if (name.ends_with(suffix)) std::filesystem::remove(directory / name);
    }
};

const std::string chain = "  - load: a.off\n  - split: midpoint\n  - relax: 2\n  - write: b.ply\n";

} // namespace

TEST_CASE("stages are recalled, and what writes or judges runs", "[pipeline][cache]") {
    Works works;
    const std::string more = "  - validate: {closed: true}\n  - orient\n";
    CHECK(works.run(chain + more).exit_code == 0);
    CHECK(works.ways() == "load ran, split ran, relax ran, write always, validate always, orient ran");
    const auto first = test::get(works.directory / "b.ply");
    const auto record = works.run(chain + more);
    CHECK(works.ways() ==
          "load recalled, split recalled, relax recalled, write always, validate always, orient recalled");
    CHECK(test::get(works.directory / "b.ply") == first);
    REQUIRE(record.stages.size() == 6);
    CHECK(record.stages[1].before.value().faces == 4);
    CHECK(record.stages[1].after.value().faces == 16);
    CHECK(record.inputs.size() == 1);
    CHECK(record.outputs.size() == 1);
    CHECK(record.checks.size() == 1);
}

TEST_CASE("a scene that is gone is made again from the last one that is there", "[pipeline][cache]") {
    Works works;
    works.run(chain);
    const auto first = test::get(works.directory / "b.ply");
    works.remove(".scene");
    works.run(chain);
    CHECK(works.ways() == "load again, split again, relax again, write always");
    CHECK(test::get(works.directory / "b.ply") == first);
    works.run(chain);
    CHECK(works.ways() == "load recalled, split recalled, relax recalled, write always");
}

TEST_CASE("arms that need what was recalled make it once", "[pipeline][cache]") {
    Works works;
    works.run("  - load: a.off\n  - split: midpoint\n  - relax: 1\n");
    works.remove(".scene");
    const auto record = works.run("  - load: a.off\n  - split: midpoint\n  - foreach: {n: [1, 2, 3]}\n"
                                  "    do: [{relax: \"${n}\"}, {write: \"${n}.ply\"}]\n");
    CHECK(record.exit_code == 0);
    CHECK(record.outputs.size() == 3);
    CHECK(works.ways().starts_with("load again, split again, "));
}

TEST_CASE("what takes longer to store than it saves is not stored", "[pipeline][cache]") {
    Works works;
    cache::Store slow({works.directory / "cache", 1 << 20, false});
    for (int i = 0; i < 100; ++i) slow.took(1 << 20, 1e12); // a byte in an hour
    works.settings.store = &slow;
    works.run(chain);
    works.run(chain);
    CHECK(works.ways() == "load ran, split ran, relax ran, write always");
    CHECK(slow.contents().entries == 0);
}

TEST_CASE("what may be otherwise the next time is not stored, and what follows is", "[pipeline][cache]") {
    Works works;
    const std::string stages = "  - load: a.off\n  - test-unrepeatable\n  - relax: 1\n  - write: b.ply\n";
    works.run(stages);
    works.run(stages);
    CHECK(works.ways() == "load recalled, test-unrepeatable ran, relax recalled, write always");
}

TEST_CASE("what one arm of a branch has used up for storing is not there for the next", "[pipeline][cache]") {
    pipeline::SceneState flow;
    flow.unsaved = 10;
    pipeline::SceneState arm = flow.branched_off();
    arm.unsaved += 2;
    arm.spend(1);
    CHECK(arm.spent_before_branch == 0);
    CHECK(arm.unsaved == 11);
    pipeline::SceneState inner = arm.branched_off();
    inner.unsaved += 1;
    inner.spend(5);
    inner.begin_anew();
    CHECK(inner.spent_before_branch == 4);
    arm.spend(inner.spent_before_branch);
    CHECK(arm.spent_before_branch == 3);
    flow.spend(arm.spent_before_branch);
    CHECK(flow.unsaved == 7);
    CHECK(flow.branched_off().unsaved == 7);
    flow.spend(100);
    CHECK(flow.unsaved == 0);
}

TEST_CASE("an input that changes while the pipeline runs is an error", "[pipeline][cache]") {
    Works works;
    works.run(chain);
    works.remove(".scene");
    works.settings.on_stage = [&](const report::StageRecord& stage) {
        if (stage.stage == "load")
            test::put(works.directory / "a.off", std::string(tetrahedron) + "# more\n");
    };
    const auto record = works.run(chain);
    REQUIRE(record.errors.size() == 1);
    CHECK(record.errors[0].id == "E-CHANGED");
    works.settings.on_stage = {};
    CHECK(works.run(chain).exit_code == 0);
}

TEST_CASE("a stage that fails is not stored", "[pipeline][cache]") {
    Works works;
    const std::string failing = "  - load: a.off\n  - clip: {plane: z=5mm}\n  - write: b.ply\n";
    const auto first = works.run(failing), second = works.run(failing);
    CHECK(first.exit_code == 2);
    CHECK(second.exit_code == 2);
    REQUIRE(second.errors.size() == first.errors.size());
    CHECK(render(second.errors[0]) == render(first.errors[0]));
}
