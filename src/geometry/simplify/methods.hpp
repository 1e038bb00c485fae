#pragma once
// What brings a state to its goal: passes of collapses, passes within a bound on the deviation, OpenMesh's
// decimater, and clusters.

#include "geometry/deviation/deviation.hpp"
#include "geometry/simplify/collapse.hpp"

#include <span>

namespace facetmill::simplification {

/// At most so many faces, or so many vertices, whichever comes first.
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
    bool stuck = false; ///< no collapse was left, and the goal is not met
};

/// Collapses edges in the order of their costs until the goal is met or none can go.
Outcome run_passes(State& s, const Goal& goal);

/// One of several states that go to a goal together.
struct Member {
    State* state;
    double unit = 1;      ///< of the state's frame, as a length that all members share
    std::size_t uses = 1; ///< how often its faces, its vertices and what its collapses take away count
    Outcome done{};       ///< of all work on it
};
/// As run_passes, of all members in one order of cost, for a goal of all together; what is used several times
/// may go beyond it by one collapse of each use.
void run_passes(std::span<Member> members, const Goal& goal);
/// The edges that the last pass left, by reason; means something once the work is stuck.
SimplifyResult::Blocked count_blocked(const State& s);

/// What a method that ends the work came to.
struct Ended {
    Shape shape;
    std::optional<Log> log; ///< as the state's
    Outcome outcome;
    bool by_error = false;             ///< the bound stopped it
    std::optional<double> measured{};  ///< the deviation of what is left, with max_error; in the mesh's units
    SimplifyResult::Blocked blocked{}; ///< when stuck, or stopped by the bound
    std::size_t rolled_back = 0, measurements = 0;
    std::optional<double> cell{}; ///< of clusters, in the mesh's units
};

/// Passes as far as the goal and the measured deviation, in the units of `from`, allow. from: what the state
/// was laid out of. The state must have a log.
Ended run_within(State s, const Mesh& from, const Goal& goal, double max_error, std::size_t samples);

/// The method constrained. vertices: of the mesh that the state was laid out of. The state must have a log.
Ended run_constrained(State s, std::size_t vertices, const Goal& goal,
                      const SimplifyConstraints& constraints);

/// The method cluster: as coarse as the goal needs, or as max_error (in the mesh's units) allows.
///
/// After J. Rossignac and P. Borrel, 'Multi-resolution 3D approximations for rendering complex scenes'
/// (1993), and P. Lindstrom, 'Out-of-core simplification of large polygonal models' (2000).
Ended run_cluster(State s, const Mesh& from, const Goal& goal, std::optional<double> max_error,
                  std::size_t samples);

// For max_error while collapsing, see FollowedPoints.

/// Finds the face that takes each point of the faces around; false when one would be farther from all than is
/// allowed, or the new faces farther from the surface that came in.
bool points_stay_near(State& s, Around& around, const Vec3& to);
/// Gives each point to the face that points_stay_near found.
void hand_over_points(State& s, const Around& around);

// The bound afterwards: the deviation is judged, and collapses are taken back along the log.

/// Judges shapes by their deviation from the mesh that came in, whose tree is built once.
class Judge {
  public:
    /// bound: in the mesh's units. samples: of the area, each way.
    Judge(const Mesh& from, double bound, std::size_t samples);

    const FaceTree& tree() const { return tree_; }
    /// Whether the deviation, as `deviation` would measure it, is within the bound; stops at the first sample
    /// beyond.
    bool within(const Mesh& mesh) const;
    double deviation(const Mesh& mesh) const;

  private:
    Surface surface_;
    FaceTree tree_;
    double bound_;
    DeviationSettings settings_;
};

/// What a state was before its first collapse.
struct Origin {
    Shape shape;
    std::vector<Index> number; ///< of each vertex of the input, in the shape

    /// vertices: of the input.
    Origin(const Shape& now, std::size_t vertices);
};
/// The shape after the first so many steps of the log; the log is cut to them.
Shape rolled_back(const Origin& origin, Log& log, std::size_t steps);

/// Counts the self-intersections of the mesh that a shape was finished as; when there are more than allowed,
/// lowers the limits (see Bounds::limits) of all vertices of the input that went into the vertices of the
/// faces concerned: to a part of the largest error there, or to 0.
std::size_t limit_intersecting(const Shape& shape, const Log& log, const Mesh& finished, std::size_t allowed,
                               bool to_zero, std::vector<float>& limits);

} // namespace facetmill::simplification
