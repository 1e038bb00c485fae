#include "stages/probe/report.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/measure/statistics_fields.hpp"
#include "io/csv.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::probe_stage {

namespace {

/// The parameter shown to users: for a ray, the distance from its start.
double shown(const Line& line, double t) { return line.ray ? t * length(line.to - line.from) : t; }

/// Sets the face's part and number in the answer. Leaves both unset without a face.
template <class Answer>
void name_face(Answer& answer, const FaceNames& faces, Index face) {
    const auto [part, number] = faces.of(face);
    if (!part) return;
    answer.part = *part;
    answer.face = number;
}

std::string face_csv(const FaceNames& faces, Index face) {
    const auto [part, number] = faces.of(face);
    return part ? fmt::format("{},{}", io::csv_text(*part), number) : ",";
}

std::string point_csv(const Vec3& p) {
    return fmt::format("{},{},{}", io::csv_number(p.x), io::csv_number(p.y), io::csv_number(p.z));
}

bool crosses_plane(const SegmentFacet& m) {
    return m.meeting != Meeting::parallel && m.meeting != Meeting::in_plane;
}

ProbedLine answer_of(const LineAnswers& answers, std::size_t i, const FaceNames& faces) {
    const Line& line = answers.lines[i];
    ProbedLine answer{line.from, {}, {}, {}, {}, {}};
    if (line.ray)
        answer.direction = line.to - line.from;
    else
        answer.to = line.to;
    for (const auto& hit : answers.hits.of(i)) {
        answer.hits.push_back({shown(line, hit.t), hit.point, hit.way < 0, {}, {}});
        name_face(answer.hits.back(), faces, hit.face);
    }
    if (answers.meetings.empty()) return answer;
    const SegmentFacet& m = answers.meetings[i];
    answer.meeting = to_string(m.meeting);
    if (crosses_plane(m)) answer.plane = ProbedLine::InPlane{shown(line, m.t), m.point};
    return answer;
}

// --- fields

constexpr const char* points = "points are queried";
constexpr const char* lines = "segments or rays are queried";
constexpr const char* one_face = "lines are tested against one face";
constexpr const char* no_face = "the surface has no faces";

void declare_hit(DeclareFields<ProbedHit>& d) {
    d.field("t", &ProbedHit::t,
            "The position on the line: 0 to 1 along a segment, the distance along a ray.");
    d.field("at", &ProbedHit::at, "Where.");
    d.field("enters", &ProbedHit::enters, "Whether the line enters the solid at this point.");
    d.field("part", &ProbedHit::part, "The part that was hit.");
    d.field("face", &ProbedHit::face, "The number of the face in that part.");
}

void declare_in_plane(DeclareFields<ProbedLine::InPlane>& d) {
    d.field("t", &ProbedLine::InPlane::t,
            "The position on the line: 0 to 1 along a segment, the distance along a ray.");
    d.field("at", &ProbedLine::InPlane::at, "Where.");
}

void declare_point_answer(DeclareFields<ProbeAnswer>& d) {
    d.field("point", where_it_is(&ProbedPoint::point), "The queried point.").only_when(points);
    d.choice("side", where_it_is(&ProbedPoint::side),
             {{"inside", Side::inside, "the winding number is not 0"},
              {"outside", Side::outside, "the winding number is 0"},
              {"on", Side::on, "the point is on the surface"},
              {"unknown", Side::unknown, "the surface is open"}},
             "The side of the surface that contains the point.")
        .only_when(points);
    d.field("winding", where_it_is(&ProbedPoint::winding),
            "The winding number of the surface around the point. 0 if the point is on the surface.")
        .only_when(points);
    d.field("distance", where_it_is(&ProbedPoint::distance), "The distance to the surface.")
        .unit("scene units")
        .only_when(points)
        .null_when(no_face);
    d.field("closest", where_it_is(&ProbedPoint::closest), "The closest point on the surface.")
        .only_when(points)
        .null_when(no_face);
    d.field("part", where_it_is(&ProbedPoint::part), "The part with the closest point.")
        .only_when(points)
        .null_when(no_face);
    d.field("face", where_it_is(&ProbedPoint::face), "The number of the face in that part.")
        .only_when(points)
        .null_when(no_face);
}

void declare_answer(DeclareFields<ProbeAnswer>& d) {
    declare_point_answer(d);
    d.field("from", where_it_is(&ProbedLine::from), "The start of the line.").only_when(lines);
    const auto direction = [](const ProbeAnswer& a) {
        const auto* line = std::get_if<ProbedLine>(&a);
        return line ? line->direction : std::nullopt;
    };
    const auto to = [](const ProbeAnswer& a) {
        const auto* line = std::get_if<ProbedLine>(&a);
        return line ? line->to : std::nullopt;
    };
    d.field("direction", direction, "The direction of a ray.").only_when("rays are queried");
    d.field("to", to, "The end of a segment.").only_when("segments are queried");
    d.list("hits", where_it_is(&ProbedLine::hits), "The hit faces, in order.", declare_hit).only_when(lines);
    const auto meeting = [](const ProbeAnswer& a) {
        const auto* line = std::get_if<ProbedLine>(&a);
        return line ? line->meeting : std::nullopt;
    };
    d.field("meeting", meeting, "The relation of the line to the face.").only_when(one_face);
    const auto plane = [](const ProbeAnswer& a) {
        const auto* line = std::get_if<ProbedLine>(&a);
        return line ? line->plane : std::nullopt;
    };
    d.object("plane", plane, "The intersection with the plane of the face.", declare_in_plane)
        .only_when(
            "lines are tested against one face, and the line is neither parallel to its plane nor in it");
}

// --- lines for the terminal

std::string name_of(const std::optional<std::string>& part) { return part.value_or("-"); }
std::string number_of(const std::optional<Index>& face) { return face ? std::to_string(*face) : "null"; }

std::string line_of(const ProbedPoint& a) {
    const std::string text = fmt::format("{}: {}", readable(a.point), to_string(a.side));
    if (!a.distance) return text;
    return text + fmt::format(", {} from {} of {} face {}", readable(a.distance), readable(a.closest),
                              name_of(a.part), number_of(a.face));
}

std::string line_of(const ProbedLine& a) {
    const std::string text = fmt::format("{} {} {}: ", readable(a.from), a.to ? "to" : "along",
                                         readable(a.to ? a.to : a.direction));
    if (a.meeting) return text + *a.meeting;
    if (a.hits.empty()) return text + "no hit";
    const ProbedHit& first = a.hits[0];
    return text + fmt::format("{} hit{}, t {} at {} on {} face {}", a.hits.size(),
                              a.hits.size() == 1 ? "" : "s", readable(first.t), readable(first.at),
                              name_of(first.part), number_of(first.face));
}

std::vector<std::string> lines_of(const ProbeReport& report) {
    constexpr std::size_t few = 5; // answers listed individually
    std::vector<std::string> counts;
    const auto add = [&](std::uint64_t count, const std::string& kind) {
        if (count > 0) counts.push_back(fmt::format("{} {}", grouped(count), kind));
    };
    if (report.sides)
        for (const Side side : {Side::inside, Side::outside, Side::on, Side::unknown})
            add((*report.sides)[static_cast<std::size_t>(side)], to_string(side));
    if (report.meetings)
        for (const auto& [kind, count] : *report.meetings) add(count, kind);
    else if (report.hit) {
        add(*report.hit, "hit");
        add(report.missed.value_or(0), "missed");
    }
    std::string line = join_texts(counts);
    if (report.distance) line = join_texts({line, range_text("distance", *report.distance)}, "; ");
    std::vector<std::string> all{line.empty() ? "nothing was queried" : line};
    for (std::size_t i = 0; i < std::min(few, report.answers.size()); ++i)
        all.push_back(std::visit([](const auto& a) { return line_of(a); }, report.answers[i]));
    if (report.count > few) all.push_back(fmt::format("and {} more", grouped(report.count - few)));
    return all;
}

} // namespace

void declare_probe_report(DeclareFields<ProbeReport>& d) {
    d.field("count", &ProbeReport::count, "The number of queried points or lines.");
    for (const Side side : {Side::inside, Side::outside, Side::on, Side::unknown}) {
        const auto count = [side](const ProbeReport& r) {
            return r.sides ? std::optional((*r.sides)[static_cast<std::size_t>(side)]) : std::nullopt;
        };
        d.field(to_string(side), count, "Points at this side of the surface.").only_when(points);
    }
    d.field("hit", &ProbeReport::hit, "Lines that hit a face.").only_when(lines);
    d.field("missed", &ProbeReport::missed, "Lines that hit no face.").only_when(lines);
    d.field("hits", &ProbeReport::hits, "The hits of all lines.").only_when(lines);
    std::vector<std::string> meetings;
    for (const Meeting m : {Meeting::hit, Meeting::parallel, Meeting::in_plane, Meeting::outside_segment,
                            Meeting::outside_facet})
        meetings.emplace_back(to_string(m));
    d.counts("meetings", &ProbeReport::meetings, meetings,
             "The number of lines for each relation to the face.")
        .only_when(one_face);
    d.object("distance", &ProbeReport::distance, "Distances of all points to the surface.",
             statistics_fields("scene units"))
        .only_when(points);
    d.list("answers", &ProbeReport::answers, "The first answers, up to max_answers.", declare_answer);
    d.tell(lines_of);
}

FaceNames::FaceNames(const std::vector<const Part*>& parts) {
    Index first = 0;
    for (const Part* part : parts) {
        first_.push_back(first);
        names_.push_back(&part->name);
        first += static_cast<Index>(part->mesh.face_count());
    }
}

std::pair<const std::string*, Index> FaceNames::of(Index face) const {
    if (face == none || names_.empty()) return {nullptr, none};
    const auto after = std::upper_bound(first_.begin(), first_.end(), face);
    const auto part = static_cast<std::size_t>(after - first_.begin()) - 1;
    return {names_[part], face - first_[part]};
}

ProbeReport report_of(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                      const FaceNames& faces, std::size_t limit) {
    ProbeReport report;
    report.count = answers.size();
    auto& sides = report.sides.emplace();
    std::vector<double> distances;
    for (const auto& a : answers) {
        ++sides[static_cast<std::size_t>(a.side)];
        distances.push_back(a.closest.distance);
    }
    report.distance = statistics(std::move(distances));
    for (std::size_t i = 0; i < std::min(limit, answers.size()); ++i) {
        const auto& a = answers[i];
        ProbedPoint one{points[i], a.side, a.winding, {}, {}, {}, {}};
        name_face(one, faces, a.closest.face);
        if (a.closest.face != none) {
            one.distance = a.closest.distance;
            one.closest = a.closest.point;
        }
        report.answers.emplace_back(std::move(one));
    }
    return report;
}

ProbeReport report_of(const LineAnswers& answers, const FaceNames& faces, std::size_t limit) {
    ProbeReport report;
    report.count = answers.lines.size();
    std::size_t hit = 0;
    for (std::size_t i = 0; i < answers.lines.size(); ++i) {
        hit += !answers.hits.of(i).empty();
        if (i < limit) report.answers.emplace_back(answer_of(answers, i, faces));
    }
    report.hit = hit;
    report.missed = answers.lines.size() - hit;
    report.hits = answers.hits.hits.size();
    if (answers.meetings.empty()) return report;
    auto& counts = report.meetings.emplace();
    for (const auto& m : answers.meetings) {
        const std::string name = to_string(m.meeting);
        const auto known =
            std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == name; });
        if (known == counts.end())
            counts.emplace_back(name, 1);
        else
            ++known->second;
    }
    return report;
}

std::string points_csv(std::span<const Vec3> points, std::span<const PointAnswer> answers,
                       const FaceNames& faces) {
    std::string csv = "x,y,z,side,winding,distance,closest_x,closest_y,closest_z,part,face\n";
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const auto& a = answers[i];
        const bool found = a.closest.face != none;
        csv += fmt::format("{},{},{},{},{},{}\n", point_csv(points[i]), to_string(a.side), a.winding,
                           found ? io::csv_number(a.closest.distance) : "",
                           found ? point_csv(a.closest.point) : ",,", face_csv(faces, a.closest.face));
    }
    return csv;
}

std::string lines_csv(const LineAnswers& answers, const FaceNames& faces) {
    const bool meetings = !answers.meetings.empty();
    std::string csv = meetings ? "line,meeting,t,x,y,z\n" : "line,hit,t,x,y,z,enters,part,face\n";
    for (std::size_t i = 0; i < answers.lines.size(); ++i) {
        if (meetings) {
            const auto& m = answers.meetings[i];
            const bool crosses = crosses_plane(m);
            csv += fmt::format(
                "{},{},{}\n", i, to_string(m.meeting),
                crosses ? io::csv_number(shown(answers.lines[i], m.t)) + "," + point_csv(m.point) : ",,,");
            continue;
        }
        std::size_t number = 0;
        for (const auto& hit : answers.hits.of(i))
            csv += fmt::format("{},{},{},{},{},{}\n", i, number++,
                               io::csv_number(shown(answers.lines[i], hit.t)), point_csv(hit.point),
                               hit.way < 0 ? 1 : 0, face_csv(faces, hit.face));
    }
    return csv;
}

} // namespace facetmill::probe_stage
