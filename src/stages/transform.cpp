#include "base/functions.hpp"
#include "io/convert.hpp"
#include "mesh/placement.hpp"
#include "options/mark_at.hpp"
#include "stage/convention_option.hpp"
#include "stage/stage.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

enum class About { origin, centre };

struct Rotation {
    Vec3 axis{0, 0, 1};
    Angle angle;
};

struct TransformOptions {
    std::vector<Length> translate;
    std::optional<Rotation> rotate;
    std::vector<double> scale, matrix;
    About about = About::origin;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    bool centre = false, ground = false, bake = false;
};

void declare(Declare<TransformOptions>& d) {
    d.choice<Unit>("unit", &TransformOptions::unit, unit_choices("unknown", "as it is"),
                   "The unit that numbers are in from here on; they change so that sizes stay.");
    d.choice<UpAxis>(
        "up", &TransformOptions::up,
        {{"unknown", UpAxis::unknown, "as it is"}, {"y", UpAxis::y, "+Y"}, {"z", UpAxis::z, "+Z"}},
        "The axis that points up from here on; the scene turns so that up stays up.");
    d.option("scale", &TransformOptions::scale, "One factor, or one for each axis; negative ones mirror.");
    d.group("rotate", &TransformOptions::rotate, "A rotation, anticlockwise seen against the axis.",
            [](Declare<Rotation>& r) {
                r.option("angle", &Rotation::angle, "How far.").primary();
                r.option("axis", &Rotation::axis, "Around which direction.");
            });
    d.choice<About>("about", &TransformOptions::about,
                    {{"origin", About::origin, "the world's origin"},
                     {"centre", About::centre, "the centre of the parts' box"}},
                    "The point that scale and rotate leave where it is.");
    d.option("matrix", &TransformOptions::matrix,
             "Twelve or sixteen numbers, row by row, applied to columns (x, y, z, 1).");
    d.option("translate", &TransformOptions::translate, "Three lengths.");
    d.option("centre", &TransformOptions::centre, "Then moves the centre of the parts' box to the origin.");
    d.option("ground", &TransformOptions::ground,
             "Then rests the parts on the ground: the lowest point along up is at 0.");
    d.option("bake", &TransformOptions::bake,
             "Moves the vertices and leaves the parts' nodes without a transform.");
}

Transform moved(const Vec3& by) {
    Transform t;
    for (int i = 0; i < 3; ++i) t.m[i][3] = by[static_cast<std::size_t>(i)];
    return t;
}

/// Rodrigues' formula.
Transform rotation(const Rotation& r) {
    const Vec3 u = normalised(r.axis);
    const double c = cosine(r.angle.radians), s = sine(r.angle.radians);
    Transform t;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = (i == j ? c : 0) + (1 - c) * u[i] * u[j];
    t.m[0][1] -= s * u.z, t.m[1][0] += s * u.z;
    t.m[0][2] += s * u.y, t.m[2][0] -= s * u.y;
    t.m[1][2] -= s * u.x, t.m[2][1] += s * u.x;
    return t;
}

Transform scaling(const std::vector<double>& factors) {
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) t.m[i][i] = factors[factors.size() == 1 ? 0 : i];
    return t;
}

Transform from_numbers(const std::vector<double>& m) {
    Transform t;
    for (std::size_t i = 0; i < 12; ++i) t.m[i / 4][i % 4] = m[i];
    return t;
}

class Mover {
  public:
    Mover(Scene& scene, const TransformOptions& o, Context& context)
        : scene_(scene), o_(o), context_(context) {}

    void run() {
        const io::Conversion converted = io::convert(scene_, {o_.unit, o_.up});
        for (const auto& name : converted.lost_skins) warn_of_skin(name);
        if (converted.unit_guessed)
            context_.warn("W-UNITS",
                          fmt::format("transform: the scene had no unit; its numbers are taken as {}",
                                      spelled(o_.unit)),
                          "say what the file's numbers mean when it is loaded (load: {unit: mm})");
        Transform spin;
        if (!o_.scale.empty()) spin = scaling(o_.scale);
        if (o_.rotate) spin = rotation(*o_.rotate) * spin;
        const Vec3 fixed = o_.about == About::centre ? box().centre() : Vec3{};
        if (!spin.identity()) move(moved(fixed) * spin * moved(-fixed));
        if (!o_.matrix.empty()) move(from_numbers(o_.matrix));
        Vec3 by;
        for (std::size_t i = 0; i < o_.translate.size(); ++i)
            by[i] = context_.resolve(o_.translate[i], scene_, fmt::format("translate.{}", "xyz"[i]));
        if (!o_.translate.empty()) move(moved(by));
        if (o_.centre && !box().empty()) move(moved(-box().centre()));
        if (o_.ground && !box().empty()) {
            Vec3 drop;
            const std::size_t up = scene_.up == UpAxis::y ? 1 : 2;
            drop[up] = -box().min[up];
            move(moved(drop));
        }
        if (o_.bake)
            context_.for_each_part(scene_, [](Part& part) {
                if (!part.skinned) apply(part.mesh, part.transform), part.transform = {};
            });
        Json rows = Json::array();
        for (const auto& row : all_.m) rows.push_back({row[0], row[1], row[2], row[3]});
        context_.result() = {{"matrix", rows},
                             {"unit_factor", converted.factor},
                             {"unit", spelled(scene_.unit)},
                             {"up", spelled(scene_.up)}};
    }

  private:
    Box box() const {
        Box all;
        for (const Part& part : scene_.parts)
            if (context_.selects(part, scene_))
                for (const Vec3& p : part.mesh.positions) all.add(in_world(part, p));
        return all;
    }

    void move(const Transform& t) {
        all_ = t * all_;
        for (Part& part : scene_.parts) {
            if (!context_.selects(part, scene_)) continue;
            part.transform = part.skinned ? t : t * part.transform;
            if (part.skinned) warn_of_skin(part.name);
            part.skinned = false;
        }
    }

    void warn_of_skin(const std::string& name) {
        context_.warn("W-SKIN",
                      fmt::format("transform: part '{}' moves in bind pose and loses its skin", name),
                      "move the node of its skeleton instead");
    }

    Scene& scene_;
    const TransformOptions& o_;
    Context& context_;
    Transform all_;
};

Scene run(Scene scene, const TransformOptions& o, Context& context) {
    Mover(scene, o, context).run();
    return scene;
}

void verify(const TransformOptions& o, const Value& given, Problems& problems) {
    const auto refuse = [&](const char* name, std::string message) {
        problems.add(mark_at(given, name), "E-TRANSFORM", "transform: " + std::move(message));
    };
    if (!o.translate.empty() && o.translate.size() != 3)
        refuse("translate", fmt::format("translate takes three lengths, found {}", o.translate.size()));
    if (!o.scale.empty() && o.scale.size() != 1 && o.scale.size() != 3)
        refuse("scale", fmt::format("scale takes one factor or three, found {}", o.scale.size()));
    for (const double factor : o.scale)
        if (!(std::abs(factor) > 0) || !std::isfinite(factor))
            refuse("scale", "a factor of 0 would flatten the parts");
    if (!o.matrix.empty() && o.matrix.size() != 12 && o.matrix.size() != 16)
        refuse("matrix", fmt::format("matrix takes 12 or 16 numbers, found {}", o.matrix.size()));
    else if (!o.matrix.empty() && !(std::abs(from_numbers(o.matrix).determinant()) > 0))
        refuse("matrix", "the matrix would flatten the parts");
    if (o.matrix.size() == 16 &&
        (o.matrix[12] != 0 || o.matrix[13] != 0 || o.matrix[14] != 0 || o.matrix[15] != 1))
        refuse("matrix", "the last row of a matrix is 0, 0, 0, 1");
    if (o.rotate && !(length(o.rotate->axis) > 0)) refuse("rotate", "the axis of a rotation has no length");
}

const RegisterStage registered = make_stage<TransformOptions>(
    {.name = "transform",
     .about = "Moves, turns and scales parts; converts units and the up axis.",
     .details = "In this order, whatever the order of the options: unit and up (of the whole scene), scale, "
                "rotate, matrix, "
                "translate, centre, ground. All in world space: the nodes of the parts move, their meshes "
                "stay as they are, "
                "unless bake is on. Faces of a part that is mirrored keep their front, as glTF has it. The "
                "ground is 0 along "
                "the up axis, +Z where that is unknown. A skinned part moves in bind pose and loses its skin "
                "(W-SKIN).",
     .examples = {"transform: {scale: 0.001}",
                  "transform: {rotate: {axis: [1, 0, 0], angle: 90deg}, ground: true}",
                  "transform: {unit: m, up: y, centre: true, ground: true}",
                  "transform: {translate: [0, 0, 2mm]}"}},
    declare, run, StageHooks<TransformOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
