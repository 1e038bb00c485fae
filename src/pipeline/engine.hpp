#pragma once
// Runs steps: for each its condition, its result from a source (cache, memory or cells), its record and its
// contract. Observers watch the events of a run (observers.hpp).

#include "pipeline/failures.hpp"
#include "pipeline/stage_cache.hpp"

namespace facetmill::pipeline {

struct Event {
    enum class Kind {
        begins,   ///< a stage is next; its record has its name and options
        skipped,  ///< ... but its condition does not hold
        before,   ///< nothing has been done yet to the scene
        enters,   ///< the stage is about to work on the scene; `left` is what is known of it
        ran,      ///< the stage has left this scene; what is thrown now is its failure
        after,    ///< it is done
        failed,   ///< ... or it is not
        judged,   ///< the contract of a stage or of a branch has been checked
        arm,      ///< an arm of a branch begins
        arm_done, ///< ... and ends
        ended     ///< all steps are done
    };
    Kind kind;
    const Step* step = nullptr;                    ///< none at the end
    report::StageRecord* stage = nullptr;          ///< of a stage
    std::size_t first_output = 0, first_check = 0; ///< of the stage, in the record
    const SceneState::Left* left = nullptr;
    const Scene* scene = nullptr;
};

/// An observer of events of one kind.
struct Watch {
    Event::Kind kind;
    /// What the observer makes of the scene, in words: the scene is fetched first, and an exception of
    /// `call` fails the run. Null: it needs no scene.
    const char* scene_for;
    std::function<void(const Event&)> call;
    std::function<bool(const Event&)> wants = {}; ///< empty: all of them
};

/// What a run has, and how its steps are run.
struct Engine {
    const Plan& plan;
    const RunSettings& settings;
    RunState& state;
    Failures& failures;
    StageCache& cache;
    std::vector<Watch> watches{}; ///< in the order of their calls
    bool keeps_loaded = false;    ///< a later step compares with the scene as loaded

    report::RunRecord& record() const { return state.record; }
    /// Runs the steps on the scene. False when the chain ended early; the scene is then worth nothing.
    /// needed: whether the scene is looked at afterwards. first: the steps before it are done.
    bool run_steps(const Steps& steps, SceneState& flow, bool needed, std::size_t first = 0);
    /// Records the stage of a step. source: does its work and fills the record; false after a failure.
    bool run_stage(const Step& step, SceneState& flow,
                   const std::function<bool(report::StageRecord&)>& source);
    /// Makes the scene of the flow be there. False after a failure.
    bool fetch(const Mark& where, const std::string& what, SceneState& flow);
    /// flow: where the scene can be had.
    void emit(Event event, SceneState* flow = nullptr);
    /// Runs body; what it throws becomes a failure of the step. False then.
    template <class Body>
    bool guarded(const Step& step, Body&& body) {
        return failures.guarded(step.where, step.name, std::forward<Body>(body));
    }
    /// Until its end, work that is not of a stage reports its progress.
    ProgressScope beside_stages(const std::string& what) const;
};

} // namespace facetmill::pipeline
