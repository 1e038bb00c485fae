#include "stages/measure/robot_text.hpp"

#include "base/math/numbers.hpp"
#include "base/text/markup.hpp"

#include <fmt/format.h>

namespace facetmill::measure_stage {

namespace {

std::string spaced(std::initializer_list<double> numbers) {
    std::string text;
    for (const double x : numbers) text += (text.empty() ? "" : " ") + to_string(x);
    return text;
}

/// https://wiki.ros.org/urdf/XML/link
std::string urdf_link(const std::string& name, const MeasuredSolid& s, double metre) {
    const auto& [xx, yy, zz] = s.inertia;
    const double square = metre * metre;
    const Vec3 c = *s.centroid * metre;
    return fmt::format("  <link name=\"{}\">\n    <inertial>\n      <origin xyz=\"{}\" rpy=\"0 0 0\"/>\n"
                       "      <mass value=\"{}\"/>\n"
                       "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n"
                       "    </inertial>\n  </link>\n",
                       escaped(name), spaced({c.x, c.y, c.z}), to_string(s.mass), to_string(xx.x * square),
                       to_string(xx.y * square), to_string(xx.z * square), to_string(yy.y * square),
                       to_string(yy.z * square), to_string(zz.z * square));
}

/// https://mujoco.readthedocs.io/en/stable/XMLreference.html#body-inertial
std::string mjcf_body(const std::string& name, const MeasuredSolid& s, double metre) {
    const auto& [xx, yy, zz] = s.inertia;
    const double square = metre * metre;
    const Vec3 c = *s.centroid * metre;
    return fmt::format(
        "    <body name=\"{}\">\n      <inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>\n    </body>\n",
        escaped(name), spaced({c.x, c.y, c.z}), to_string(s.mass),
        spaced({xx.x * square, yy.y * square, zz.z * square, xx.y * square, xx.z * square, yy.z * square}));
}

} // namespace

RobotFormat robot_format(const PathText& path) {
    if (path.text.ends_with(".urdf")) return RobotFormat::urdf;
    return path.text.ends_with(".mjcf") || path.text.ends_with(".xml") ? RobotFormat::mjcf
                                                                       : RobotFormat::none;
}

std::string robot_text(RobotFormat format, const MeasureReport& report) {
    const double known = metres(unit_named(report.unit).value_or(Unit::unknown)),
                 metre = known > 0 ? known : 1;
    const bool urdf = format == RobotFormat::urdf;
    std::string text = urdf ? "<?xml version=\"1.0\"?>\n<robot name=\"scene\">\n"
                            : "<mujoco model=\"scene\">\n  <worldbody>\n";
    for (const MeasuredPart& part : report.parts) {
        if (!part.solid || !(part.solid->mass > 0) || !part.solid->centroid)
            throw Error(ErrorKind::stage, "E-MASS",
                        fmt::format("measure: part '{}' has no mass, because {}", part.part,
                                    !part.solid              ? "it is not closed"
                                    : part.solid->volume < 0 ? "it is inside out"
                                                             : "its volume is 0"),
                        "close it with clean or wrap, turn it with orient, or exclude it with only");
        text += urdf ? urdf_link(part.part, *part.solid, metre) : mjcf_body(part.part, *part.solid, metre);
    }
    return text + (urdf ? "</robot>\n" : "  </worldbody>\n</mujoco>\n");
}

} // namespace facetmill::measure_stage
