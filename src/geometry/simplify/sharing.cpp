// Meshes that share a target; order.cpp collapses their states together.

#include "geometry/simplify/sharing.hpp"

#include "base/progress.hpp"
#include "geometry/simplify/input.hpp"
#include "geometry/simplify/joint.hpp"
#include "geometry/simplify/targets.hpp"
#include "parallel/parallel.hpp"

#include <memory>

namespace facetmill {

namespace {

using namespace simplification;
using Stop = SimplifyResult::Stop;

/// One participant in a shared simplification, from its input meshes to its results.
class Sharer {
  public:
    const std::size_t uses;
    Member member{};

    Sharer(SharingMeshes given, const SimplifySettings& settings)
        : uses(given.uses), scale_(given.scale), settings_(settings), meshes_(std::move(given.meshes)) {
        settings_.lock = std::move(given.lock);
        settings_.max_quadric_error = given.max_quadric_error;
        subject_ = std::make_unique<SimplifyInput>(
            meshes_.size() == 1 ? std::move(meshes_.front()) : joined(pointers()), settings_);
        vertices_given_ = subject_->vertices();
    }
    Sharer(const Sharer&) = delete; // not copyable, because the subject refers to the settings
    Sharer& operator=(const Sharer&) = delete;

    std::size_t faces_given() const { return subject_->faces(); }
    std::size_t vertices_given() const { return vertices_given_; }
    std::size_t faces() const { return state_ ? state_->rings.live_faces : faces_given(); }
    std::size_t vertices() const { return state_ ? state_->rings.live_vertices : vertices_given(); }
    const CoincidentBorders* borders() const { return subject_->borders(); }

    void lay_out() {
        if (state_) return;
        state_ = subject_->state(false);
        member = {&*state_, scale_ / state_->frame.scale, uses};
    }

    /// The unchanged meshes as results.
    std::vector<SimplifyResult> untouched() const { return split(subject_->unchanged()); }
    /// The current state as results. met: the reached target. own: this participant's part of the target. It
    /// may be met even if the total is not.
    std::vector<SimplifyResult> results(Stop met, const Targets& own) {
        const bool stuck = member.done.stuck && !own.goal.met(*state_);
        if (member.done.stuck && !stuck) met = own.met(faces());
        const auto blocked = stuck ? count_blocked(*state_) : SimplifyResult::Blocked{};
        const Stop stop = stuck ? stuck_by(blocked) : met;
        if (member.done.collapses == 0) {
            SimplifyResult r = subject_->unchanged(stop);
            r.blocked = blocked;
            return split(std::move(r));
        }
        compact(*state_);
        SimplifyResult r = subject_->result(stop, *state_, state_->log, member.done);
        r.blocked = blocked;
        return split(std::move(r));
    }

  private:
    std::vector<const Mesh*> pointers() const {
        std::vector<const Mesh*> all;
        all.reserve(meshes_.size());
        for (const Mesh& mesh : meshes_) all.push_back(&mesh);
        return all;
    }

    std::vector<SimplifyResult> split(SimplifyResult r) const {
        if (meshes_.size() > 1) return split_up(std::move(r), pointers());
        std::vector<SimplifyResult> one;
        one.push_back(std::move(r));
        return one;
    }

    double scale_;
    SimplifySettings settings_;
    std::vector<Mesh> meshes_; ///< the input meshes; subject_ takes a single mesh
    std::unique_ptr<SimplifyInput> subject_;
    std::size_t vertices_given_ = 0;
    std::optional<State> state_;
};

class Sharing {
  public:
    using Results = std::vector<std::vector<std::vector<SimplifyResult>>>; ///< [sharing][levels][meshes]

    Sharing(std::vector<SharingMeshes> given, const SimplifySettings& settings)
        : settings_(settings), sharers_(given.size()) {
        each([&](std::size_t i) { sharers_[i] = std::make_unique<Sharer>(std::move(given[i]), settings); });
        for (const auto& s : sharers_) given_ += s->uses * s->faces_given();
        for (const auto& s : sharers_) vertices_given_ += s->uses * s->vertices();
    }

    /// Collapses until the target is met. ratio: the ratio of the settings, or of a level.
    void go(std::optional<double> ratio) {
        const Targets targets = targets_of(ratio);
        std::size_t faces = 0, vertices = 0;
        for (const auto& s : sharers_) {
            faces += s->uses * s->faces();
            vertices += s->uses * s->vertices();
        }
        moved_ = !targets.goal.met(faces, vertices);
        if (!moved_) return;
        ProgressSteps steps({1, 2});
        each([&](std::size_t i) { sharers_[i]->lay_out(); });
        steps.next();
        std::vector<Member> members;
        std::vector<const CoincidentBorders*> borders;
        for (const auto& s : sharers_) {
            members.push_back(s->member);
            borders.push_back(s->borders());
        }
        run_passes_separate(members, borders, targets.goal);
        faces = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            sharers_[i]->member = members[i];
            faces += members[i].uses * sharers_[i]->faces();
        }
        stop_ = members.front().done.stuck ? Stop::stuck : targets.met(faces);
    }

    /// Appends the current results to the results of finer levels.
    void add_results(std::optional<double> ratio, Results& results) {
        results.resize(sharers_.size());
        each([&](std::size_t i) {
            auto& mine = results[i];
            if (moved_)
                mine.push_back(sharers_[i]->results(stop_, own_part(ratio, *sharers_[i])));
            else
                mine.push_back(mine.empty() ? sharers_[i]->untouched() : mine.back());
        });
    }

    /// The current counts of each participant.
    SimplifyShares shares() const {
        SimplifyShares shares{{}, stop_};
        shares.faces.reserve(sharers_.size());
        for (const auto& s : sharers_) shares.faces.push_back(s->faces());
        return shares;
    }

  private:
    template <class Body>
    void each(Body&& body) {
        parallel_for(sharers_.size(), body, std::clamp<std::size_t>(sharers_.size() / 256, 1, 64));
    }

    Targets targets_of(std::optional<double> ratio) const {
        std::size_t by_ratio = 0;
        for (const auto& s : sharers_)
            if (ratio) by_ratio += s->uses * share_of(s->faces_given(), *ratio);
        return {by_ratio, settings_.faces.value_or(0), settings_.vertices.value_or(0)};
    }

    /// The participant's part of the target, in proportion to its input.
    Targets own_part(std::optional<double> ratio, const Sharer& s) const {
        const auto part = [](std::optional<std::size_t> whole, std::size_t own, std::size_t all) {
            return static_cast<std::size_t>(double(whole.value_or(0)) * (double(own) / double(all)));
        };
        return {ratio ? share_of(s.faces_given(), *ratio) : 0, part(settings_.faces, s.faces_given(), given_),
                part(settings_.vertices, s.vertices_given(), vertices_given_)};
    }

    const SimplifySettings& settings_;
    std::vector<std::unique_ptr<Sharer>> sharers_;
    std::size_t given_ = 0, vertices_given_ = 0; ///< total faces and vertices, weighted by use
    bool moved_ = false;                         ///< the last target required collapses
    Stop stop_ = Stop::nothing;                  ///< why the shared work stopped
};

void check_sharing(const SimplifySettings& s) {
    throw_refusal("simplify", check_simplify_sharing(s));
    throw_first(s.levels.empty() ? check_simplify_settings(s) : check_simplify_levels(s));
}

} // namespace

std::vector<std::vector<std::vector<SimplifyResult>>> simplify_sharing(std::vector<SharingMeshes> given,
                                                                       const SimplifySettings& settings) {
    check_sharing(settings);
    Sharing::Results results;
    if (given.empty()) return results;
    Sharing all(std::move(given), settings);
    std::vector<std::optional<double>> ratios(settings.levels.begin(), settings.levels.end());
    if (ratios.empty()) ratios.push_back(settings.ratio);
    ProgressSteps steps(std::vector<double>(ratios.size(), 1));
    for (const auto& ratio : ratios) {
        all.go(ratio);
        all.add_results(ratio, results);
        steps.next();
    }
    return results;
}

SimplifyShares simplify_shares(std::vector<SharingMeshes> given, const SimplifySettings& settings) {
    SimplifySettings bare = settings;
    bare.max_error.reset();
    bare.self_intersections = SimplifySettings::Intersections::ignore;
    check_sharing(bare);
    if (given.empty()) return {};
    Sharing all(std::move(given), bare);
    all.go(bare.ratio);
    return all.shares();
}

} // namespace facetmill
