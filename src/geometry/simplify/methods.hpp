#pragma once
// The algorithms that bring a state to its goal: passes of collapses, passes within a bound on the deviation,
// OpenMesh's decimater, and clustering.

#include "geometry/deviation/deviation.hpp"
#include "geometry/simplify/collapse.hpp"

#include <span>

namespace facetmill::simplification {

/// The work stops at this many faces or this many vertices, whichever comes first.
struct Goal {
    std::size_t faces = 0, vertices = 0;

    bool met(std::size_t faces_now, std::size_t vertices_now) const {
        return faces_now <= faces || vertices_now <= vertices;
    }
    bool met(const State& s) const { return met(s.rings.live_faces, s.rings.live_vertices); }
    bool met(const Shape& s) const { return met(s.face_slots(), s.vertex_slots()); }
};

struct Outcome {
    std::size_t passes = 0, collapses = 0;
    double largest = 0; ///< largest error squared, in the frame
    bool stuck = false; ///< no collapse was left, and the goal was not met
};

/// Collapses edges in order of cost until the goal is met or no edge may be collapsed.
[[nodiscard]] Outcome run_passes(State& s, const Goal& goal);

/// A state that is simplified together with others.
struct Member {
    State* state;
    double unit = 1;      ///< length of the state's frame unit, in a length unit that all members share
    std::size_t uses = 1; ///< weight of its faces, vertices and collapses: the number of uses
    Outcome done{};       ///< outcome of all work on the member
};
/// Like run_passes for one mesh, but all members share a goal and one order of cost. A member with several
/// uses may take the total below the goal, by one collapse per use.
void run_passes(std::span<Member> members, const Goal& goal);
/// Counts the edges that the last pass left, by reason. Meaningful only when the work is stuck.
[[nodiscard]] SimplifyResult::Blocked count_blocked(const State& s);

/// The outcome of a method that runs to its end.
struct Ended {
    Shape shape;
    std::optional<Log> log; ///< the log of the state
    Outcome outcome;
    bool by_error = false;             ///< stopped by the error bound
    std::optional<double> measured{};  ///< the deviation of the result, with max_error; in the mesh's units
    SimplifyResult::Blocked blocked{}; ///< when stuck, or when the bound stopped the work
    std::size_t rolled_back = 0, measurements = 0;
    std::optional<double> cell{}; ///< cell size of clustering, in the mesh's units
};

/// Runs passes until the goal or the measured deviation (in the units of `from`) stops them. from: the mesh
/// that the state was built from. The state must have a log.
[[nodiscard]] Ended run_within(State s, const Mesh& from, const Goal& goal, double max_error,
                               std::size_t samples);

/// The method constrained. vertices: the count in the mesh that the state was built from. The state must have
/// a log.
[[nodiscard]] Ended run_constrained(State s, std::size_t vertices, const Goal& goal,
                                    const SimplifyConstraints& constraints);

/// The method cluster, as coarse as the goal needs or as max_error (in the mesh's units) allows.
///
/// After J. Rossignac and P. Borrel, 'Multi-resolution 3D approximations for rendering complex scenes'
/// (1993), and P. Lindstrom, 'Out-of-core simplification of large polygonal models' (2000).
[[nodiscard]] Ended run_cluster(State s, const Mesh& from, const Goal& goal, std::optional<double> max_error,
                                std::size_t samples);

// Bounding the error during the collapses, see FollowedPoints.

/// Finds the new face for each point of the faces around. Returns false if a point would be farther than
/// allowed from all of them, or the new faces too far from the input surface.
bool points_stay_near(State& s, Around& around, const Vec3& to);
/// Assigns each point to the face that points_stay_near found.
void hand_over_points(State& s, const Around& around);

// Bounding the error after the collapses: the deviation is measured, and collapses are undone along the log.

/// Measures how far shapes deviate from the input mesh, whose tree is built once.
class Judge {
  public:
    /// bound: in the mesh's units. samples: by area, in each direction.
    Judge(const Mesh& from, double bound, std::size_t samples);

    const FaceTree& tree() const { return tree_; }
    /// True if the deviation, as measured by `deviation`, is within the bound. Stops at the first sample
    /// beyond it.
    bool within(const Mesh& mesh) const;
    double deviation(const Mesh& mesh) const;

  private:
    Surface surface_;
    FaceTree tree_;
    double bound_;
    DeviationSettings settings_;
};

/// A state before its first collapse.
struct Origin {
    Shape shape;
    std::vector<Index> number; ///< [vertices of the input] numbers in the shape

    /// vertices: the count in the input.
    Origin(const Shape& now, std::size_t vertices);
};
/// The shape after the first `steps` steps of the log. Truncates the log to them.
[[nodiscard]] Shape rolled_back(const Origin& origin, Log& log, std::size_t steps);

/// Counts the self-intersections of the finished mesh of a shape. If there are more than allowed, it lowers
/// the limits (see Bounds::limits) of all input vertices that merged into vertices of the intersecting faces.
/// The new limit is a fraction of the largest error at that vertex, or 0.
[[nodiscard]] std::size_t limit_intersecting(const Shape& shape, const Log& log, const Mesh& finished,
                                             std::size_t allowed, bool to_zero, std::vector<float>& limits);

} // namespace facetmill::simplification
