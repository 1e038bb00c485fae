#include "stages/measure/csv.hpp"

#include "geometry/polygon/polygon.hpp"
#include "io/csv.hpp"

#include <fmt/format.h>

namespace facetmill::report {

std::string face_rows(const std::string& part, const Mesh& mesh) {
    std::string csv;
    std::vector<Vec3> corners;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        corners.clear();
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) corners.push_back(mesh.point(c));
        const Vec3 area = polygon::area_vector(corners), normal = normalised(area);
        // The fan's signed parts, about the first corner: right for concave faces too.
        Vec3 moment;
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            const Vec3 a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
            moment += (a + b) * (dot(cross(a, b), normal) / 6);
        }
        const double size = length(area);
        const Vec3 centroid = corners[0] + (size > 0 ? moment / size : Vec3{});
        csv += fmt::format("{},{},{},{}", io::csv_text(part), f, corners.size(), io::csv_number(size));
        for (const Vec3& v : {centroid, normal})
            for (std::size_t i = 0; i < 3; ++i) csv += "," + io::csv_number(v[i]);
        csv += "," + io::csv_number(polygon::plane_deviation(corners)) + "\n";
    }
    return csv;
}

} // namespace facetmill::report
