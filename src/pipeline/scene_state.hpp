#pragma once
// The scene between steps: in memory, or as a description of a cached scene.

#include "cache/state.hpp"
#include "io/gltf/gltf.hpp"
#include "pipeline/plan.hpp"
#include "report/contents.hpp"
#include "stage/surface_loss.hpp"

#include <algorithm>

namespace facetmill::pipeline {

/// A step that did not run, because the cache has its output.
struct Recalled {
    const Step* step = nullptr;
    std::size_t trace = 0;    ///< its index in the trace of the run
    double load_diagonal = 0; ///< diagonal before the step
    cache::Memory memory;
};

struct SceneState {
    Scene scene; ///< the scene before the recalled steps
    std::vector<Recalled> recalled;
    /// The result of the last stage, as long as `scene` is that result.
    struct Left {
        report::Brief brief;
        std::optional<std::vector<PartSurface>> surfaces;
        std::optional<Box> drawn; ///< io::drawn_bounds, once it is known
    };
    std::optional<Left> left;
    /// The key of the scene after the recalled steps: equal keys mean equal scenes. Empty: not yet known.
    std::string key;
    /// Seconds that stages took since the last cached scene, minus the seconds already used for storing.
    double unsaved = 0;
    double before_branch = 0;       ///< the seconds before the branch, which all its arms share
    double spent_before_branch = 0; ///< seconds that this arm has used from them
    /// Data about these stages for the cache, by key; stored together with the next scene.
    std::vector<std::pair<std::string, io::Bytes>> memories;
    /// The output of a load, with its key, until the key of its scene is computed.
    std::optional<std::pair<std::string, cache::Memory>> loaded;
    bool without_cache = false;
    bool in_cells = false;        ///< no scene yet: the loaded mesh is larger than memory
    SceneState* origin = nullptr; ///< the flow before the branch, which outlives this flow
    std::size_t inherited = 0;    ///< the number of recalled steps that belong to the origin

    /// True if `scene` is the current scene.
    bool is_here() const { return recalled.empty(); }
    /// Found once for each scene, because documents must be parsed for it.
    Box drawn_bounds() {
        if (!is_here()) return recalled.back().memory.bounds;
        if (!left) return io::drawn_bounds(scene);
        if (!left->drawn) left->drawn = io::drawn_bounds(scene);
        return *left->drawn;
    }
    /// The same scene for an arm. Work to fetch it is done once, for all arms.
    SceneState branched_off() {
        SceneState arm;
        if (is_here())
            arm = *this;
        else {
            arm.recalled = recalled;
            arm.key = key;
            arm.unsaved = unsaved;
            arm.memories = memories;
            arm.without_cache = without_cache;
            arm.origin = this;
            arm.inherited = recalled.size();
        }
        arm.before_branch = unsaved;
        arm.spent_before_branch = 0;
        return arm;
    }
    /// Records the seconds used for storing; takes them from this flow's own time first.
    void spend(double seconds) {
        const double shared = std::clamp(seconds - (unsaved - before_branch), 0.0, before_branch);
        unsaved = std::max(0.0, unsaved - seconds);
        before_branch -= shared;
        spent_before_branch += shared;
    }
    /// Everything so far is stored, or no longer useful.
    void begin_anew() {
        unsaved = before_branch = 0;
        memories.clear();
        loaded.reset();
    }
    /// The scene was replaced by a scene with an unknown key.
    void replaced() {
        left.reset();
        key.clear();
        begin_anew();
    }
};

} // namespace facetmill::pipeline
