#pragma once
// A scene on its way through the steps: itself, or what is known of one that the cache has.

#include "cache/state.hpp"
#include "pipeline/plan.hpp"
#include "report/contents.hpp"
#include "stage/surface_loss.hpp"

#include <algorithm>

namespace facetmill::pipeline {

/// A step that was not run, because the cache knows what it would tell.
struct Recalled {
    const Step* step = nullptr;
    std::size_t trace = 0;    ///< its place in the trace of the run
    double load_diagonal = 0; ///< before it
    cache::Memory memory;
};

struct SceneState {
    Scene scene; ///< as it was before the steps that were recalled
    std::vector<Recalled> recalled;
    /// What the last stage left, as long as `scene` is that.
    struct Left {
        report::Brief brief;
        std::optional<std::vector<PartSurface>> surfaces;
    };
    std::optional<Left> left;
    /// Of the scene after them: scenes with one key are equal. Empty: not known yet.
    std::string key;
    /// Seconds that stages took since the last scene of this way that the cache has, less those that storing
    /// has used up.
    double unsaved = 0;
    double before_branch = 0;       ///< ... of them those before the branch, which all its arms share
    double spent_before_branch = 0; ///< what this arm has used up of them
    /// What the cache gets of these stages as soon as it gets a scene after them: by key.
    std::vector<std::pair<std::string, io::Bytes>> memories;
    /// What a load told, by its key, as long as nobody has asked for the key of the scene that it gave.
    std::optional<std::pair<std::string, cache::Memory>> loaded;
    bool without_cache = false;
    bool in_cells = false;        ///< there is no scene yet: what was loaded is larger than memory
    SceneState* origin = nullptr; ///< the flow that it branched off, which outlives it
    std::size_t inherited = 0;    ///< how many of the recalled steps are the origin's

    /// Whether `scene` is the scene now.
    bool is_here() const { return recalled.empty(); }
    Box bounds() const { return is_here() ? scene.bounds() : recalled.back().memory.bounds; }
    /// The same scene, for an arm: what must be made to get it is made once, for all arms.
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
    /// Storing has used up so many of the seconds: of this way's own first.
    void spend(double seconds) {
        const double shared = std::clamp(seconds - (unsaved - before_branch), 0.0, before_branch);
        unsaved = std::max(0.0, unsaved - seconds);
        before_branch -= shared;
        spent_before_branch += shared;
    }
    /// All so far is stored, or has become worthless.
    void begin_anew() {
        unsaved = before_branch = 0;
        memories.clear();
        loaded.reset();
    }
    /// The scene has become another, which no key is known of.
    void replaced() {
        left.reset();
        key.clear();
        begin_anew();
    }
};

} // namespace facetmill::pipeline
