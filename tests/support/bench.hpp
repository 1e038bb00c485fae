#pragma once
// Runs single stages one after the other, with a directory for their files.

#include "support/run_stage.hpp"
#include "support/temporary.hpp"

namespace facetmill::test {

/// Runs single stages in its own directory.
struct Bench {
    TemporaryDirectory dir;
    RunState state;
    report::StageRecord record;
    Scene scene;

    Bench() {
        state.places = {dir.path(), dir.path()};
        state.record.inputs.clear();
    }

    void run(const char* stage, Value given) {
        Problems problems;
        const auto use = use_of(stage_for_test(stage), given, problems);
        problems.throw_if_any(ErrorKind::usage);
        const PartFilter all;
        Context context(state, record, all, scene.bounds(), {});
        scene = use->run(std::move(scene), context);
    }
};

} // namespace facetmill::test
