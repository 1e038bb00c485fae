#include "stages/fit/trials.hpp"

#include "io/gltf/contents/textures.hpp"
#include "io/images/pixels.hpp"
#include "stage/read_written.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::fit_stage {

namespace {

/// The state of a separate run, whose files are discarded with it.
struct Aside {
    RunState state;
    report::StageRecord record;
    PartFilter all;
};

std::shared_ptr<Stage> stage_with(const char* name, const Value& options) {
    const StageInfo* info = stage_named(name);
    auto stage = info->made();
    Problems problems;
    info->options->parse(options, stage->target(), name, problems);
    problems.throw_if_any(ErrorKind::bug);
    return stage;
}

Context context_of(Aside& aside, const Scene& scene, const Context& context) {
    aside.state.places = context.places();
    aside.state.read_back = false;
    return {aside.state, aside.record, aside.all, scene.bounds(), context.where()};
}

Value number(std::int64_t n) { return Value::scalar(std::to_string(n)); }
Value truth(bool b) { return Value::scalar(b ? "true" : "false"); }

Value options_of_role(const ImageChoice& choice, const std::string& format) {
    Value map = Value::map({});
    map.set("format", Value::scalar(choice.side > 0 ? format : "keep"));
    if (choice.side == 0) return map;
    map.set("max_size", number(static_cast<std::int64_t>(choice.side)));
    map.set("quality", number(choice.quality));
    return map;
}

Value quantize_options(const Bits& bits) {
    Value map = Value::map({});
    map.set("position", number(bits.position));
    map.set("normal", number(bits.normal));
    map.set("uv", number(bits.uv));
    return map;
}

Value draco_options(const Bits& bits) {
    Value map = Value::map({});
    map.set("position_bits", number(bits.position));
    map.set("normal_bits", number(bits.normal));
    map.set("uv_bits", number(bits.uv));
    return map;
}

/// Trials of a .glb stay in memory. A .gltf needs its folder, for temporary files.
std::string trial_path(const FitOptions& o) {
    const io::Codec* codec = io::codec_for(o.path.text);
    return codec && !codec->can.companion.empty() ? o.path.text : "-";
}

} // namespace

Scene Trials::simplified(double keep, std::vector<report::PartChange>* changes) const {
    if (keep >= 1 || scene_.face_count() == 0) return scene_;
    Value options = Value::map({});
    options.set("ratio", Value::scalar(fmt::format("{:.6f}%", std::max(keep * 100, 1e-6))));
    options.set("max_quadric_error", Value::scalar("off"));
    options.set("topology", Value::scalar("allow"));
    options.set("measure", truth(false));
    // Light depends on normals. On smooth meshes, 0.3 looked more alike than the stage's own weight.
    Value weights = Value::map({});
    weights.set("normal", Value::scalar("0.3"));
    options.set("weights", std::move(weights));
    Aside aside;
    Context inner = context_of(aside, scene_, context_);
    Scene out = stage_with("simplify", options)->run(scene_, inner);
    if (changes) *changes = std::move(aside.record.attribute_changes);
    return out;
}

Scene Trials::with_images(Scene scene, const ImageChoice& colours, const ImageChoice& normals) const {
    if (colours.side == 0 && normals.side == 0) return scene;
    Value options = options_of_role(colours, o_.images);
    options.set("normals", options_of_role(normals, o_.images));
    options.set("data", options_of_role(colours, o_.images));
    if (normals.side == 0) { // the options of colours apply to all roles
        Value& role = *options.find("normals");
        role.set("max_size", number(16384));
    }
    Aside aside;
    Context inner = context_of(aside, scene, context_);
    return stage_with("textures", options)->run(std::move(scene), inner);
}

Value Trials::options_of_write(const std::string& path, const Bits& bits, bool final_order) const {
    Value options = Value::map({});
    options.set("path", Value::scalar(path));
    if (path == "-") options.set("format", Value::scalar("glb"));
    options.set("drop_names", truth(o_.drop_names));
    if (o_.compression == Compression::draco) options.set("draco", draco_options(bits));
    if (o_.compression != Compression::meshopt) return options;
    options.set("meshopt", truth(true));
    options.set("quantize", quantize_options(bits));
    options.set("order", Value::scalar(final_order ? "size" : "strips"));
    return options;
}

TrialFile Trials::file(const Scene& scene, const Bits& bits, bool final_order) const {
    Aside aside;
    Context inner = context_of(aside, scene, context_);
    const Scene left =
        stage_with("write", options_of_write(trial_path(o_), bits, final_order))->run(scene, inner);
    TrialFile made;
    for (const report::FileRecord& file : inner.output_records()) made.bytes += file.bytes;
    made.decoded = read_written(inner.trail().written.back(), left, inner);
    return made;
}

void Trials::write(Scene scene, const Bits& bits) const {
    (void)stage_with("write", options_of_write(o_.path.text, bits, true))->run(std::move(scene), context_);
}

StageFiles files_of_fit(const FitOptions& o) {
    if (o.path.text.empty()) return {}; // the plan reports it
    Value options = Value::map({});
    options.set("path", Value::scalar(o.path.text));
    if (o.path.text == "-") options.set("format", Value::scalar("glb"));
    return stage_with("write", options)->files();
}

ImageSides image_sides(const Scene& scene) {
    ImageSides sides;
    for (const auto& document : scene.documents)
        for (const io::DocumentImage& image : io::document_images(*document, {})) {
            sides.bytes += image.bytes.size();
            const auto size = io::image_size(image.bytes);
            if (!size || image.use.textures.empty()) continue;
            std::size_t& side = image.use.normals ? sides.normals : sides.colours;
            side = std::max({side, size->first, size->second});
        }
    return sides;
}

} // namespace facetmill::fit_stage
