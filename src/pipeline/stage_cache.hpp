#pragma once
// Which stages need not be run, because the cache knows what they did with the same scene and options; and
// what it is told of those that were run.
//
// A stage is recalled when it reads nothing but the scene, its options and `only`, and does nothing but give
// a scene and fill its own record (its name may be in a warning only); or when it loads, and the files that
// it read are the same. Those that judge or write always run. What a stage did besides is looked at after it
// ran, too, and then not stored.
//
// The key of a scene that a stage made is of the scene before it, the stage, its options, this program and
// its libraries; that of any other scene (loaded, joined ...) is of its contents, so that it does not matter
// how it came about. A scene is stored when that takes at most a tenth of the time of the stages since the
// last one that is stored; what the report says of these stages is stored with it, and only then.

#include "cache/store.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/trace.hpp"
#include "stage/context.hpp"

namespace facetmill::pipeline {

/// The key of what a stage makes, with its options, of that which has this key: 64 digits.
std::string key_after(const std::string& key, const Step& step);

class StageCache {
  public:
    /// store: none, and nothing is recalled or stored. trace: its last entry is that of the present step.
    StageCache(cache::Store* store, const Folders& places, Trace& trace)
        : store_(store), places_(places), trace_(trace) {}

    /// Steps that load always run from now on.
    void keep_loads() { loads_run_ = true; }

    /// Whether the step need not be run: then its record is filled, and the run has its inputs.
    bool recall(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage);

    /// What is to be known of a run before a stage for judging it afterwards.
    struct Before {
        std::string key; ///< of the stage with this scene; empty: it is not stored
        std::size_t inputs = 0, absent = 0, outputs = 0, staged = 0, checks = 0, warnings = 0,
                    unrepeatable = 0;
        double load_diagonal = 0;
    };
    Before before(const Step& step, const SceneState& flow, const RunState& run) const;
    /// After a stage that ran and did what it should: its scene is the flow's.
    void keep(const Step& step, SceneState& flow, const RunState& run, const report::StageRecord& stage,
              const Before& before);

    /// Before a flow branches off into these arms, so that what they all would compute is computed once.
    void before_arms(SceneState& flow, const std::vector<Arm>& arms) const;

    /// Makes the scene of a flow be there: from the cache, or by running the steps that were recalled. Throws
    /// as they do, and malformed (E-CHANGED) when an input is another by now.
    void fetch(SceneState& flow);

  private:
    bool may_recall(const Step& step) const;
    bool recall_known(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage);
    void keep_known(const Step& step, SceneState& flow, const RunState& run, const report::StageRecord& stage,
                    const Before& before);
    static void know_key(SceneState& flow);
    std::string key_of(const Step& step, const SceneState& flow, double load_diagonal) const;
    void run_again(SceneState& flow, std::size_t first);
    void know_documents(const Scene& scene);
    void share_documents(Scene& scene);
    void store_scene(SceneState& flow);
    std::optional<Scene> stored_scene(const std::string& key);

    cache::Store* store_;
    const Folders& places_;
    Trace& trace_;
    bool loads_run_ = false;
    std::vector<std::shared_ptr<const Document>> documents_; ///< of all scenes of the run
};

} // namespace facetmill::pipeline
