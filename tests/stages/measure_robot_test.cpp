#include "geometry/measure/measure.hpp"
#include "stages/measure/robot_text.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

#include "mesh/shapes.hpp"

using namespace facetmill;
using namespace facetmill::measure_stage;
using test::failure;

namespace {

/// A beam of 2 x 4 x 6 mm from the origin, with 0.5 kg per cubic millimetre: 24 kg.
MeasureReport beam() {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions) p = {2 * p.x, 4 * p.y, 6 * p.z};
    MeasureReport report;
    report.unit = "mm";
    report.density = 0.5;
    const MassResult mass = measure_mass(mesh);
    report.parts.push_back(
        {"a <beam>", mass.shell, measured(mass.solid.value_or(SolidMass{}), 0.5), {}, {}, {}});
    return report;
}

double number_after(const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

} // namespace

TEST_CASE("measure: mass properties for robots are in metres", "[stages]") {
    // m/12 (b^2 + c^2) with m = 24 kg: 2 * 52, 2 * 40 and 2 * 20 kg mm^2
    const std::string urdf = robot_text(RobotFormat::urdf, beam()),
                      mjcf = robot_text(RobotFormat::mjcf, beam());
    CHECK(urdf.find("<link name=\"a &lt;beam&gt;\">") != std::string::npos);
    CHECK(number_after(urdf, "xyz=\"") == Approx(0.001));
    CHECK(number_after(urdf, "mass value=\"") == Approx(24));
    CHECK(number_after(urdf, "ixx=\"") == Approx(104e-6));
    CHECK(number_after(urdf, "iyy=\"") == Approx(80e-6));
    CHECK(number_after(urdf, "izz=\"") == Approx(40e-6));
    CHECK(number_after(urdf, "ixy=\"") == Approx(0).margin(1e-15));
    CHECK(mjcf.find("<body name=\"a &lt;beam&gt;\">") != std::string::npos);
    CHECK(number_after(mjcf, "mass=\"") == Approx(24));
    CHECK(number_after(mjcf, "fullinertia=\"") == Approx(104e-6));
    MeasureReport open = beam();
    open.parts[0].solid.reset();
    CHECK(failure([&] { (void)robot_text(RobotFormat::urdf, open); }).find("it is not closed") !=
          std::string::npos);
}

TEST_CASE("measure: the suffix selects the format for robots", "[stages]") {
    CHECK(robot_format({"a.urdf"}) == RobotFormat::urdf);
    CHECK(robot_format({"a.mjcf"}) == RobotFormat::mjcf);
    CHECK(robot_format({"a.xml"}) == RobotFormat::mjcf);
    CHECK(robot_format({"a.json"}) == RobotFormat::none);
}
