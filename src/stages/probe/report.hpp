#pragma once
// What probe reports of its answers, and their tables.

#include "geometry/measure/measure.hpp"
#include "geometry/probe/probe.hpp"
#include "options/fields.hpp"

#include <variant>

namespace facetmill::probe_stage {

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

struct ProbedPoint {
    Vec3 point;
    Side side = Side::unknown;
    int winding = 0;
    std::optional<double> distance;
    std::optional<Vec3> closest;
    std::optional<std::string> part;
    std::optional<Index> face;
};

struct ProbedHit {
    double t = 0; ///< 0 to 1 along a segment; of a ray a distance
    Vec3 at;
    bool enters = false;
    std::optional<std::string> part;
    std::optional<Index> face;
};

struct ProbedLine {
    struct InPlane {
        double t = 0;
        Vec3 at;
    };
    Vec3 from;
    std::optional<Vec3> direction, to; ///< of a ray, of a segment
    std::vector<ProbedHit> hits;
    std::optional<std::string> meeting; ///< with the one face
    std::optional<InPlane> plane;
};
using ProbeAnswer = std::variant<ProbedPoint, ProbedLine>;

struct ProbeReport {
    std::size_t count = 0;
    std::optional<std::array<std::size_t, 4>> sides; ///< points by Side
    std::optional<std::size_t> hit, missed, hits;    ///< of lines
    std::optional<NamedCounts> meetings;
    std::optional<Statistics> distance;
    std::vector<ProbeAnswer> answers; ///< the first of them
};
void declare_probe_report(DeclareFields<ProbeReport>& d);

/// The report, with at most so many answers.
ProbeReport report_of(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                      const FaceNames& faces, std::size_t limit);
ProbeReport report_of(const LineAnswers& answers, const FaceNames& faces, std::size_t limit);

std::string points_csv(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                       const FaceNames& faces);
std::string lines_csv(const LineAnswers& answers, const FaceNames& faces);

} // namespace facetmill::probe_stage
