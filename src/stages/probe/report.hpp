#pragma once
// The report of probe's answers, and their tables.

#include "geometry/measure/measure.hpp"
#include "geometry/probe/probe.hpp"
#include "options/fields.hpp"

#include <variant>

namespace facetmill::probe_stage {

/// Maps faces of a joined surface to the part and the face number in it.
class FaceNames {
  public:
    explicit FaceNames(const std::vector<const Part*>& parts);
    std::pair<const std::string*, Index> of(Index face) const; ///< null if the point hit no face

  private:
    std::vector<Index> first_;
    std::vector<const std::string*> names_;
};

struct LineAnswers {
    std::vector<Line> lines;
    HitLists hits;
    std::vector<SegmentFacet>
        meetings; ///< intersections with the requested face; empty if none was requested
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
    double t = 0; ///< for a segment, the position from 0 to 1; for a ray, the distance
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
    std::optional<Vec3> direction, to; ///< a ray's direction, or a segment's end
    std::vector<ProbedHit> hits;
    std::optional<std::string> meeting; ///< the intersection with the requested face
    std::optional<InPlane> plane;
};
using ProbeAnswer = std::variant<ProbedPoint, ProbedLine>;

struct ProbeReport {
    std::size_t count = 0;
    std::optional<std::array<std::size_t, 4>> sides; ///< point counts by Side
    std::optional<std::size_t> hit, missed, hits;    ///< counts for lines
    std::optional<NamedCounts> meetings;
    std::optional<Statistics> distance;
    std::vector<ProbeAnswer> answers; ///< the first answers
};
void declare_probe_report(DeclareFields<ProbeReport>& d);

/// The report, with at most `limit` answers.
[[nodiscard]] ProbeReport report_of(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                                    const FaceNames& faces, std::size_t limit);
[[nodiscard]] ProbeReport report_of(const LineAnswers& answers, const FaceNames& faces, std::size_t limit);

[[nodiscard]] std::string points_csv(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                                     const FaceNames& faces);
[[nodiscard]] std::string lines_csv(const LineAnswers& answers, const FaceNames& faces);

} // namespace facetmill::probe_stage
