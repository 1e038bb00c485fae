#pragma once
// Skips stages whose results for the same scene and options are in the cache, and stores the results of
// stages that ran.
//
// A stage can be recalled if it reads only the scene, its options and `only`. It may only return a scene and
// fill its record (warnings may contain its name). A load can be recalled if the files that it read are
// unchanged. Stages that check or write always run. If a stage turns out to have had other effects, its
// result is not stored.
//
// The key of a stage's result is computed from the previous scene's key, the stage, its options, this
// program and its libraries. The key of any other scene (loaded, joined ...) is computed from its contents,
// so its history does not matter. A scene is stored if that takes at most a tenth of the stages' time since
// the last stored scene. The report entries of these stages are stored together with it.

#include "cache/store.hpp"
#include "pipeline/scene_state.hpp"
#include "pipeline/trace.hpp"
#include "stage/context.hpp"

namespace facetmill::pipeline {

/// The key of a stage's result, given the key of its input: 64 digits.
[[nodiscard]] std::string key_after(const std::string& key, const Step& step);

class StageCache {
  public:
    /// store: null disables recalling and storing. trace: its last entry is the current step's.
    StageCache(cache::Store* store, const Folders& places, Trace& trace)
        : store_(store), places_(places), trace_(trace) {}

    /// From now on, steps that load always run.
    void keep_loads() { loads_run_ = true; }

    /// True if the step need not run; then its record is filled, and the run has its inputs.
    bool recall(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage);

    /// The state of a run before a stage, to decide afterwards whether its result may be stored.
    struct Before {
        std::string key; ///< key of the stage with this scene; empty: not stored
        std::size_t inputs = 0, absent = 0, outputs = 0, staged = 0, checks = 0, warnings = 0,
                    unrepeatable = 0;
        double load_diagonal = 0;
    };
    Before before(const Step& step, const SceneState& flow, const RunState& run) const;
    /// Call it after a successful stage; the flow contains its scene. drawn: io::drawn_bounds of the scene,
    /// found here if it is needed and not yet known.
    void keep(const Step& step, SceneState& flow, const RunState& run, const report::StageRecord& stage,
              const Before& before, std::optional<Box>& drawn);

    /// Call it before a flow branches into these arms, so that common work is done once.
    void before_arms(SceneState& flow, const std::vector<Arm>& arms) const;

    /// Brings the scene of a flow into memory: from the cache, or by running the recalled steps. Throws
    /// their errors, and a malformed-input error (E-CHANGED) if an input has changed.
    void fetch(SceneState& flow);

  private:
    bool may_recall(const Step& step) const;
    bool recall_known(const Step& step, SceneState& flow, RunState& run, report::StageRecord& stage);
    void keep_known(const Step& step, SceneState& flow, const RunState& run, const report::StageRecord& stage,
                    const Before& before, std::optional<Box>& drawn);
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
    std::vector<std::shared_ptr<const Document>> documents_; ///< documents of all scenes of the run
};

} // namespace facetmill::pipeline
