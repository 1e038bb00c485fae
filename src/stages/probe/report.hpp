#pragma once
// Answers to probes as reports and tables have them.

#include "base/json.hpp"
#include "geometry/probe/probe.hpp"

namespace facetmill::report {

/// Faces of a surface of several parts, by part and number there.
class FaceNames {
  public:
    explicit FaceNames(const std::vector<const Part*>& parts);
    std::pair<const std::string*, Index> of(Index face) const; ///< null for none

  private:
    std::vector<Index> first_;
    std::vector<const std::string*> names_;
};

struct LineAnswers {
    std::vector<Line> lines;
    HitLists hits;
    std::vector<SegmentFacet> meetings; ///< with one face, when that was asked; else empty
};

/// {count, inside, outside, on, unknown, distance: statistics, answers: the first `limit`}.
Json points_json(std::span<const Vec3> points, std::span<const PointAnswer> answers, const FaceNames& faces,
                 std::size_t limit);
/// {count, hit, missed, hits, answers: the first `limit`}. t is 0 to 1 along a segment; of a ray a distance.
Json lines_json(const LineAnswers& answers, const FaceNames& faces, std::size_t limit);
std::string points_csv(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                       const FaceNames& faces);
std::string lines_csv(const LineAnswers& answers, const FaceNames& faces);

} // namespace facetmill::report
