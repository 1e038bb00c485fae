#include "stages/probe/report.hpp"

#include "base/point_json.hpp"
#include "geometry/measure/statistics.hpp"
#include "io/csv.hpp"
#include "stages/measure/report.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// The t that users see: of a ray, the distance from its start.
double shown(const Line& line, double t) { return line.ray ? t * length(line.to - line.from) : t; }

void name_face(Json& entry, const FaceNames& faces, Index face) {
    const auto [part, number] = faces.of(face);
    entry["part"] = part ? Json(*part) : Json(nullptr);
    entry["face"] = part ? Json(number) : Json(nullptr);
}

std::string face_csv(const FaceNames& faces, Index face) {
    const auto [part, number] = faces.of(face);
    return part ? fmt::format("{},{}", io::csv_text(*part), number) : ",";
}

std::string point_csv(const Vec3& p) {
    return fmt::format("{},{},{}", io::csv_number(p.x), io::csv_number(p.y), io::csv_number(p.z));
}

Json line_json(const LineAnswers& answers, std::size_t i, const FaceNames& faces) {
    const Line& line = answers.lines[i];
    Json hits = Json::array();
    for (const auto& hit : answers.hits.of(i)) {
        Json one = {{"t", shown(line, hit.t)}, {"at", point_json(hit.point)}, {"enters", hit.way < 0}};
        name_face(one, faces, hit.face);
        hits.push_back(std::move(one));
    }
    Json entry = {{"from", point_json(line.from)},
                  {line.ray ? "direction" : "to", point_json(line.ray ? line.to - line.from : line.to)},
                  {"hits", std::move(hits)}};
    if (answers.meetings.empty()) return entry;
    const SegmentFacet& m = answers.meetings[i];
    entry["meeting"] = to_string(m.meeting);
    if (m.meeting != Meeting::parallel && m.meeting != Meeting::in_plane)
        entry["plane"] = {{"t", shown(line, m.t)}, {"at", point_json(m.point)}};
    return entry;
}

} // namespace

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

Json points_json(std::span<const Vec3> points, std::span<const PointAnswer> answers, const FaceNames& faces,
                 std::size_t limit) {
    std::array<std::size_t, 4> of_side{};
    std::vector<double> distances;
    for (const auto& a : answers) {
        ++of_side[static_cast<std::size_t>(a.side)];
        distances.push_back(a.closest.distance);
    }
    Json list = Json::array();
    for (std::size_t i = 0; i < std::min(limit, answers.size()); ++i) {
        const auto& a = answers[i];
        Json entry = {{"point", point_json(points[i])}, {"side", to_string(a.side)}, {"winding", a.winding}};
        const bool found = a.closest.face != none;
        entry["distance"] = found ? Json(a.closest.distance) : Json(nullptr);
        entry["closest"] = found ? point_json(a.closest.point) : Json(nullptr);
        name_face(entry, faces, a.closest.face);
        list.push_back(std::move(entry));
    }
    Json result = {{"count", answers.size()}};
    for (const Side side : {Side::inside, Side::outside, Side::on, Side::unknown})
        result[to_string(side)] = of_side[static_cast<std::size_t>(side)];
    result["distance"] = statistics_json(statistics(std::move(distances)));
    result["answers"] = std::move(list);
    return result;
}

Json lines_json(const LineAnswers& answers, const FaceNames& faces, std::size_t limit) {
    Json list = Json::array();
    std::size_t hit = 0;
    for (std::size_t i = 0; i < answers.lines.size(); ++i) {
        hit += !answers.hits.of(i).empty();
        if (i < limit) list.push_back(line_json(answers, i, faces));
    }
    Json result = {{"count", answers.lines.size()},
                   {"hit", hit},
                   {"missed", answers.lines.size() - hit},
                   {"hits", answers.hits.hits.size()}};
    if (!answers.meetings.empty()) {
        Json cases = Json::object();
        for (const auto& m : answers.meetings) {
            Json& count = cases[to_string(m.meeting)];
            count = (count.is_null() ? 0 : count.get<std::size_t>()) + 1;
        }
        result["meetings"] = std::move(cases);
    }
    result["answers"] = std::move(list);
    return result;
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
            const bool crosses = m.meeting != Meeting::parallel && m.meeting != Meeting::in_plane;
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

} // namespace facetmill::report
