#pragma once
// What measure reports, and its table of faces.

#include "geometry/measure/measure.hpp"
#include "options/fields.hpp"

namespace facetmill {

/// A solid filled with the density.
struct MeasuredSolid {
    struct Principal {
        std::array<double, 3> moments{};
        std::array<Vec3, 3> axes{};
        std::array<std::optional<double>, 3> radii{};
    };
    double volume = 0, mass = 0;
    std::optional<Vec3> centroid;
    std::array<Vec3, 3> inertia{};
    std::optional<Principal> principal;
};
MeasuredSolid measured(const SolidMass& solid, double density);

struct MeasuredPart {
    std::string part;
    ShellMass shell;
    std::optional<MeasuredSolid> solid;
    FaceResult faces;
    EdgeResult edges;
    CurvatureResult curvature;
};

struct MeasureReport {
    std::string unit;
    double density = 1;
    struct Total {
        ShellMass shell;
        std::optional<MeasuredSolid> solid;
    } total;
    std::vector<MeasuredPart> parts;
};
void declare_measure_report(DeclareFields<MeasureReport>& d);

inline constexpr const char* face_rows_head = "part,face,corners,area,x,y,z,nx,ny,nz,off_plane\n";
/// One row per face: part, number, corners, area, centroid, unit normal, farthest corner from its plane.
std::string face_rows(const std::string& part, const Mesh& mesh);

} // namespace facetmill
