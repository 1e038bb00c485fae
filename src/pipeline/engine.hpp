#pragma once
// Runs steps: evaluates the condition, gets the result from a source (cache, memory or cells), and handles
// the record and the contract. Observers receive the events of a run (observers.hpp).

#include "pipeline/failures.hpp"
#include "pipeline/stage_cache.hpp"

namespace facetmill::pipeline {

struct Event {
    enum class Kind {
        begins,   ///< the next stage; its record has its name and options
        skipped,  ///< its condition does not hold
        before,   ///< before any work on the scene
        enters,   ///< the stage is about to change the scene; `left` describes its input
        ran,      ///< the stage has returned this scene; an exception now counts as its failure
        after,    ///< finished
        failed,   ///< not finished
        judged,   ///< the contract of a stage or of a branch has been checked
        arm,      ///< an arm of a branch begins
        arm_done, ///< an arm of a branch ends
        ended     ///< all steps are done
    };
    Kind kind;
    const Step* step = nullptr;           ///< null at the end
    report::StageRecord* stage = nullptr; ///< record of a stage
    std::size_t first_output = 0,
                first_check = 0; ///< first output and check of the stage, as indices in the record
    const SceneState::Left* left = nullptr;
    const Scene* scene = nullptr;
};

/// An observer of a kind of event.
struct Watch {
    Event::Kind kind;
    /// The purpose of the scene in words: the engine then fetches the scene first, and an exception of `call`
    /// fails the run. Null: no scene is needed.
    const char* scene_for;
    std::function<void(const Event&)> call;
    std::function<bool(const Event&)> wants = {}; ///< empty: all events
};

/// The components of a run, and the functions that run its steps.
struct Engine {
    const Plan& plan;
    const RunSettings& settings;
    RunState& state;
    Failures& failures;
    StageCache& cache;
    std::vector<Watch> watches{};    ///< in calling order
    bool keeps_loaded = false;       ///< a later step needs the surface of the scene as loaded
    bool keeps_loaded_scene = false; ///< a later step needs all of that scene

    report::RunRecord& record() const { return state.record; }
    /// Runs the steps on the scene. Returns false if the chain ended early or a check failed; the scene must
    /// then not be used. needed: the scene is used afterwards. first: the number of completed steps.
    bool run_steps(const Steps& steps, SceneState& flow, bool needed, std::size_t first = 0);
    /// Records the stage of a step. source: does the work and fills the record; returns false after a
    /// failure.
    bool run_stage(const Step& step, SceneState& flow,
                   const std::function<bool(report::StageRecord&)>& source);
    /// Brings the scene of the flow into memory. Returns false after a failure.
    bool fetch(const Mark& where, const std::string& what, SceneState& flow);
    /// flow: provides the scene.
    void emit(Event event, SceneState* flow = nullptr);
    /// Runs body; an exception becomes a failure of the step. Then it returns false.
    template <class Body>
    bool guarded(const Step& step, Body&& body) {
        return failures.guarded(step.where, step.name, std::forward<Body>(body));
    }
    /// During its lifetime, work outside of stages reports its progress.
    ProgressScope beside_stages(const std::string& what) const;
};

} // namespace facetmill::pipeline
