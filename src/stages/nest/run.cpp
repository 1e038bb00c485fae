#include "base/text/words.hpp"
#include "geometry/nest/nest.hpp"
#include "mesh/finite_box.hpp"
#include "mesh/placement.hpp"
#include "options/mark_at.hpp"
#include "stage/bind_pose.hpp"
#include "stage/context.hpp"
#include "stage/stage.hpp"
#include "stages/nest/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::nest_stage {

namespace {

struct NestOptions {
    std::vector<Length> plate;
    std::optional<Length> spacing;
    std::optional<std::int64_t> plates;
    bool turn = true;
};

struct NestedPart {
    std::string part;
    std::size_t plate = 0;
    std::array<double, 2> at{};
    bool turned = false;
};

struct NestReport {
    std::size_t plates = 0;
    std::vector<NestedPart> parts;
};

void declare(Declare<NestOptions>& d) {
    d.option("plate", &NestOptions::plate,
             "The size of a plate: one length for a square, or width and depth. A third length limits the "
             "height of parts.")
        .also_called("bed size build_volume")
        .required()
        .primary();
    d.option("spacing", &NestOptions::spacing,
             "The minimum distance between parts. Default: 1/50 of the plate's shorter side.")
        .also_called("gap margin distance")
        .at_least(0);
    d.option("plates", &NestOptions::plates, "The maximum number of plates. Default: no limit.").at_least(1);
    d.option("turn", &NestOptions::turn, "Turns parts by 90 degrees where they fit better.");
}

void declare_part(DeclareFields<NestedPart>& d) {
    d.field("part", &NestedPart::part, "The name of the part.");
    d.field("plate", &NestedPart::plate, "The number of its plate, from 1.");
    d.field("at", &NestedPart::at, "The lowest corner of its box on the plate.").unit("scene units");
    d.field("turned", &NestedPart::turned, "Whether it was turned by 90 degrees.");
}

void declare_report(DeclareFields<NestReport>& d) {
    d.field("plates", &NestReport::plates, "The number of plates.");
    d.list("parts", &NestReport::parts, "Each part with its plate and position.", declare_part);
}

/// The axes of the ground and of up, a right-handed frame.
struct GroundAxes {
    std::size_t x, y, up;
    double y_sign; ///< y of the plate runs against its axis if up is y, so that it points to the back
};

class Nesting {
  public:
    Nesting(const NestOptions& o, const Scene& scene, Context& context)
        : context_(context), axes_(scene.up == UpAxis::y ? GroundAxes{0, 2, 1, -1} : GroundAxes{0, 1, 2, 1}) {
        const auto side = [&](std::size_t i) {
            const double length = context.resolve(o.plate[o.plate.size() > 1 ? i : 0], scene, "plate");
            if (!(length > 0))
                throw Error(ErrorKind::stage, "E-NEST", "nest: the size of the plate is 0 in this scene",
                            "give lengths in scene units");
            return length;
        };
        settings_.width = side(0);
        settings_.depth = side(1);
        if (o.plate.size() == 3) height_ = side(2);
        settings_.spacing = o.spacing ? context.resolve(*o.spacing, scene, "spacing")
                                      : std::min(settings_.width, settings_.depth) / 50;
        settings_.turns = o.turn;
        if (o.plates) settings_.plates = static_cast<std::size_t>(*o.plates);
    }

    Scene run(Scene scene, NestReport& report) {
        std::vector<Part*> parts;
        std::vector<Box> boxes;
        for (Part& part : scene.parts) {
            if (!context_.selects(part, scene)) continue;
            const Mesh& mesh = part.mesh;
            const Box box = box_of_finite(mesh.vertex_count(),
                                          [&](std::size_t v) { return in_world(part, mesh.positions[v]); });
            if (box.empty()) continue;
            parts.push_back(&part);
            boxes.push_back(box);
        }
        const auto places = nest(rectangles(boxes), settings_);
        refuse_what_does_not_fit(parts, boxes, places);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const NestPlace& place = *places[i];
            parts[i]->transform = movement(boxes[i], place) * parts[i]->transform;
            report.plates = std::max(report.plates, place.plate + 1);
            report.parts.push_back({parts[i]->name, place.plate + 1, {place.x, place.y}, place.turned});
        }
        return scene;
    }

  private:
    std::vector<NestRectangle> rectangles(const std::vector<Box>& boxes) const {
        std::vector<NestRectangle> all;
        all.reserve(boxes.size());
        for (const Box& box : boxes) all.push_back({box.extent()[axes_.x], box.extent()[axes_.y]});
        return all;
    }

    void refuse_what_does_not_fit(const std::vector<Part*>& parts, const std::vector<Box>& boxes,
                                  const std::vector<std::optional<NestPlace>>& places) const {
        std::string names;
        std::size_t count = 0;
        constexpr std::size_t most = 10;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!places[i] || boxes[i].extent()[axes_.up] > height_ * (1 + 1e-9)) {
                if (++count <= most) append_item(names, fmt::format("'{}'", parts[i]->name));
            }
        if (count == 0) return;
        if (count > most) names += fmt::format(" and {} more", count - most);
        throw Error(ErrorKind::stage, "E-NEST",
                    fmt::format("nest: {} no place: {}",
                                count == 1 ? "1 part has" : fmt::format("{} parts have", count), names),
                    "allow more plates, use a smaller spacing, cut large parts with tile: {fit: ...}, or "
                    "shrink them with transform: {fit: ..., shrink_only: true}");
    }

    /// From the part's position in the world to its position on the plate.
    Transform movement(const Box& box, const NestPlace& place) const {
        // On the ground, in coordinates of the plate: x, y.
        const double left = box.min[axes_.x];
        const double front = axes_.y_sign > 0 ? box.min[axes_.y] : -box.max[axes_.y];
        const double plate_left = static_cast<double>(place.plate) * 1.2 * settings_.width;
        Transform t;
        if (place.turned) {
            // A quarter turn, anticlockwise from above: x' = -y, y' = x.
            const double right = front + box.extent()[axes_.y];
            t.m[axes_.x][axes_.x] = t.m[axes_.y][axes_.y] = 0;
            t.m[axes_.x][axes_.y] = -axes_.y_sign;
            t.m[axes_.y][axes_.x] = axes_.y_sign;
            t.m[axes_.x][3] = plate_left + place.x + right;
            t.m[axes_.y][3] = axes_.y_sign * (place.y - left);
        } else {
            t.m[axes_.x][3] = plate_left + place.x - left;
            t.m[axes_.y][3] = axes_.y_sign * (place.y - front);
        }
        t.m[axes_.up][3] = -box.min[axes_.up];
        return t;
    }

    Context& context_;
    GroundAxes axes_;
    NestSettings settings_;
    double height_ = HUGE_VAL;
};

Scene run(Scene scene, const NestOptions& o, Context& context, NestReport& report) {
    warn_of_bind_pose(scene, context);
    Nesting nesting(o, scene, context);
    return nesting.run(std::move(scene), report);
}

struct NestStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        const Value* sizes = given.is_map() ? given.find("plate") : &given;
        if (o.plate.empty() || o.plate.size() > 3)
            problems.add(mark_at(given, "plate"), "E-NEST",
                         fmt::format("nest: plate needs one, two or three lengths, found {}", o.plate.size()),
                         "write, for example, plate: [250mm, 210mm]");
        for (const Length& side : o.plate)
            if (!(side.amount > 0) && !(sizes && sizes->deferred))
                problems.add(mark_at(given, "plate"), "E-NEST",
                             fmt::format("nest: the lengths of plate must be above 0, found {}", side.text),
                             "write, for example, plate: [250mm, 210mm]");
    }
};

const RegisterStage registered =
    make_stage<NestStage>({.name = "nest",
                           .also_called = "pack arrange layout plate",
                           .about = help::nest::about,
                           .details = help::nest::details,
                           .examples = {"nest: 200mm", "nest: {plate: [250mm, 210mm, 200mm], spacing: 5mm}"},
                           .moves = true,
                           .lines = LinesPolicy::work,
                           .may_lose = MayLose::area},
                          declare, declare_report);

} // namespace

} // namespace facetmill::nest_stage
