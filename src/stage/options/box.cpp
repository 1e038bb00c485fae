#include "stage/options/box.hpp"

#include "stage/options/numbers.hpp"

#include "base/math/numbers.hpp"
#include "mesh/transform.hpp"

#include <fmt/format.h>

namespace facetmill {

bool OptionType<BoxCorners>::parse(const Value& value, BoxCorners& out, Problems& problems) {
    return parse_numbers(value, out.numbers,
                         "a box ({min: [0, 0, 0], max: [1, 1, 1]}, {centre: [0, 0, 0], size: [1, 1, 1]}, "
                         "[0, 0, 0, 1, 1, 1])",
                         problems);
}
std::string OptionType<BoxCorners>::print(const BoxCorners& value) {
    std::string text;
    for (const double x : value.numbers) text += (text.empty() ? "[" : ", ") + to_string(x);
    return text + "]";
}
Json OptionType<BoxCorners>::schema() { return numbers_schema(6); }

void declare_box(Declare<BoxOption>& d) {
    d.option("min", &BoxOption::min, "The corner with the smallest coordinates, in scene units.");
    d.option("max", &BoxOption::max, "The corner with the largest coordinates, in scene units.");
    d.option("centre", &BoxOption::centre, "The centre, in scene units. Needs size.");
    d.option("size", &BoxOption::size, "The lengths of the edges, in scene units.");
    d.option("axis", &BoxOption::axis, "The axis of rotation for angle, through the centre of the box.");
    d.option("angle", &BoxOption::angle,
             "The rotation of the box, anticlockwise when you look against the axis.");
    d.at_most_one({"min", "centre"});
    d.at_most_one({"max", "size"});
    d.shorthand(ShortForm::list, "[x, y, z, X, Y, Z]: the smallest and the largest corner",
                OptionType<BoxCorners>::schema(), [](const Value& value, BoxOption& out, Problems& problems) {
                    BoxCorners c;
                    if (!OptionType<BoxCorners>::parse(value, c, problems)) return false;
                    const auto& n = c.numbers;
                    out.min = {n[0], n[1], n[2]};
                    out.max = {n[3], n[4], n[5]};
                    return true;
                });
}

void verify_box(const BoxOption& box, const Mark& where, Problems& problems) {
    const char* example =
        "for example {min: [0, 0, 0], max: [1, 1, 1]} or {centre: [0, 0, 0], size: [1, 1, 1]}";
    if (!(box.min && box.max) && !(box.centre && box.size))
        return problems.add(where, "E-BOX", "a box needs min and max, or centre and size", example);
    for (std::size_t i = 0; i < 3; ++i) {
        const double extent = box.min ? (*box.max)[i] - (*box.min)[i] : (*box.size)[i];
        if (!(extent > 0))
            return problems.add(
                where, "E-BOX",
                fmt::format("the box has no extent along {}: {}", "xyz"[i], to_string(extent)),
                box.min ? "max must be greater than min along all three axes" : "sizes must be above zero");
    }
    if (box.axis == Vec3{})
        problems.add(where, "E-BOX", "the axis of the box is zero, so it has no direction",
                     "for example axis: [0, 0, 1]");
}

std::vector<Plane> planes_of(const BoxOption& box) {
    const Vec3 half = (box.min ? *box.max - *box.min : *box.size) * 0.5;
    const Vec3 middle = box.min ? *box.min + half : *box.centre;
    const Vec3 low = box.min ? *box.min : middle - half, high = box.min ? *box.max : middle + half;
    std::vector<Plane> planes;
    const Vec3 k = normalised(box.axis);
    for (std::size_t i = 0; i < 3; ++i) {
        Vec3 axis;
        axis[i] = 1;
        if (box.angle.radians != 0) {
            axis = rotated(axis, k, box.angle.radians);
            planes.push_back({axis, middle - axis * half[i], 0});
            planes.push_back({-axis, middle + axis * half[i], 0});
        } else {
            planes.push_back({axis, low, 0});
            planes.push_back({-axis, high, 0});
        }
    }
    return planes;
}

} // namespace facetmill
