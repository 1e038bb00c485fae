#include "base/text/words.hpp"
#include "geometry/align/align.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/gltf/gltf.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/read_recorded.hpp"
#include "stage/stage.hpp"
#include "stages/align/help.hpp"

#include <fmt/format.h>

namespace facetmill::align_stage {

namespace {

struct AlignOptions {
    PathText with;
    bool from_axes = true;
    Ratio keep{0.9};
    std::int64_t samples = static_cast<std::int64_t>(AlignSettings{}.samples);
    std::int64_t iterations = AlignSettings{}.iterations;
};

void declare(Declare<AlignOptions>& d) {
    d.option("with", &AlignOptions::with, "The mesh file to align with.")
        .also_called(with_synonyms)
        .also_called("to target reference onto")
        .required()
        .primary();
    d.choice<bool>(
        "start", &AlignOptions::from_axes,
        {{"axes", true, "the best match of the principal axes, or the current position if it is better"},
         {"here", false, "the current position"}},
        "Where to start.");
    d.option("keep", &AlignOptions::keep,
             "The share of the samples to use. The farthest samples are left out.")
        .also_called("trim overlap")
        .above(0)
        .at_most(1);
    d.option("samples", &AlignOptions::samples, "The number of samples on the surface.")
        .between(100, 10000000);
    d.option("iterations", &AlignOptions::iterations, "The largest number of iterations.")
        .also_called("steps iters n")
        .between(1, 100000);
}

struct AlignReport {
    double before = 0, residual = 0, farthest = 0;
    std::size_t starts = 0;
    std::int64_t iterations = 0;
    std::vector<double> matrix;
};

void declare_report(DeclareFields<AlignReport>& d) {
    d.field("residual_before", &AlignReport::before,
            "The root mean square distance of the used samples before the move.")
        .unit("scene units");
    d.field("residual", &AlignReport::residual,
            "The root mean square distance of the used samples after the move.")
        .unit("scene units");
    d.field("farthest", &AlignReport::farthest, "The largest distance of the used samples after the move.")
        .unit("scene units");
    d.field("iterations", &AlignReport::iterations, "The number of iterations.");
    d.field("starts", &AlignReport::starts, "The number of starts that were tried.");
    d.field("matrix", &AlignReport::matrix,
            "The move as 16 numbers, column by column, as in the matrix of a glTF node.");
    d.tell([](const AlignReport& r) {
        return std::vector{fmt::format("residual {:.4g}, before {:.4g}; {} from the best of {}", r.residual,
                                       r.before, counted(static_cast<std::size_t>(r.iterations), "iteration"),
                                       counted(r.starts, "start"))};
    });
}

std::vector<double> columns_of(const Transform& t) {
    std::vector<double> numbers;
    numbers.reserve(16);
    for (int column = 0; column < 4; ++column) {
        for (const auto& row : t.m) numbers.push_back(row[column]);
        numbers.push_back(column == 3 ? 1 : 0);
    }
    return numbers;
}

void warn(const AlignResult& r, const AlignOptions& o, double diagonal, Context& context) {
    if (r.starts == 0)
        context.warn("W-ALIGN", "align: one of the meshes has no points, so nothing moves",
                     "give a mesh with faces or points");
    else if (r.after > 0.01 * diagonal || !r.settled)
        context.warn(
            "W-ALIGN",
            fmt::format("align: the scene is still {:.4g} from '{}' on average, {:.2g} % of its diagonal{}",
                        r.after, o.with.text, 100 * r.after / diagonal,
                        r.settled ? "" : ", and its move has not settled"),
            "check that both meshes show the same object in the same unit; if they only overlap, give a "
            "smaller keep; or give more iterations");
}

Scene run(Scene scene, const AlignOptions& o, Context& context, AlignReport& report) {
    const Scene other = read_beside(o.with, scene, context, false);
    const Surface target = surface_or_points_of(other, filled_surface);
    std::vector<bool> moved;
    Scene chosen;
    for (const Part& part : scene.parts) {
        moved.push_back(context.selects(part, scene));
        if (moved.back()) chosen.parts.push_back(part);
    }
    AlignSettings settings;
    settings.from_axes = o.from_axes;
    settings.keep = o.keep.value;
    settings.samples = static_cast<std::size_t>(o.samples);
    settings.iterations = static_cast<int>(o.iterations);
    const AlignResult r = align(surface_or_points_of(chosen, filled_surface), target, settings);
    for (std::size_t i = 0; i < moved.size(); ++i)
        if (moved[i]) scene.parts[i].transform = r.move * scene.parts[i].transform;
    // A rigid motion keeps all lengths, so animated lengths stay right.
    static_cast<void>(io::move_cameras_and_lights(scene, moved, r.move));
    report = {r.before, r.after, r.farthest, r.starts, r.iterations, columns_of(r.move)};
    warn(r, o, target.bounds().diagonal(), context);
    return scene;
}

struct AlignStage : StageOf<run> {
    StageFiles files() const override { return {{o.with}, {}}; }
};

const RegisterStage registered =
    make_stage<AlignStage>({.name = "align",
                            .also_called = "icp register registration best_fit fit_to superimpose match",
                            .about = help::align::about,
                            .details = help::align::details,
                            .examples = {"align: reference.stl", "align: {with: scan.ply, keep: 70%}",
                                         "align: {with: reference.stl, start: here}"},
                            .moves = true,
                            .lines = LinesPolicy::pass},
                           declare, declare_report);

} // namespace

} // namespace facetmill::align_stage
