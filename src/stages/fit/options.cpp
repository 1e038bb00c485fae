#include "stages/fit/options.hpp"

#include "io/images/avif.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

#include <fmt/format.h>

namespace facetmill::fit_stage {

namespace {

/// Lets `off` unset an option, so that a pipeline can pass a parameter on.
void may_be_off(Option& option, void (*unset)(FitOptions&)) {
    option.parse = [plain = option.parse, unset](const Option& self, const Value& v, void* target,
                                                 Problems& problems) {
        if (!v.is_scalar() || v.deferred || !(v.text == "off" || v.as_bool() == false)) {
            Value unquoted = v; // a parameter of type text is quoted
            unquoted.quoted = false;
            return plain(self, unquoted, target, problems);
        }
        unset(*static_cast<FitOptions*>(target));
        return true;
    };
    option.schema = {{"anyOf", Json::array({option.schema, {{"enum", {"off", false}}}})}};
}

} // namespace

void declare_fit(Declare<FitOptions>& d) {
    d.option("path", &FitOptions::path, "The glTF file to write: .glb or .gltf. - writes to standard output.")
        .also_called(path_synonyms)
        .primary()
        .required();
    may_be_off(d.option("budget", &FitOptions::budget,
                        "The largest size of the file and of the files that it refers to, for example 500kB. "
                        "The file looks as much like the scene as this size allows. off: no limit.")
                   .also_called("size max_bytes bytes max_file_size")
                   .option(),
               [](FitOptions& o) { o.budget.reset(); });
    may_be_off(
        d.option("look", &FitOptions::look,
                 "The largest difference between pictures of the file and of the scene, for example 0.5%. "
                 "The file is as small as this difference allows. The difference is the root mean square "
                 "over all pixels of the object, as a share of the full range. off: no limit.")
            .also_called("max_difference similarity psnr ssim")
            .above(0)
            .at_most(1)
            .option(),
        [](FitOptions& o) { o.look.reset(); });
    d.option("pixels", &FitOptions::pixels,
             "The sides of the compared pictures. Give the size at which people will see the object.")
        .also_called("resolution")
        .between(16, 4096);
    d.choice<Compression>(
        "compression", &FitOptions::compression,
        {{"meshopt", Compression::meshopt, "EXT_meshopt_compression"},
         {"draco", Compression::draco, "KHR_draco_mesh_compression"},
         {"smallest", Compression::smallest, "the better of both, in twice the time"},
         {"none", Compression::none, "float32, which every reader supports"}},
        "How the meshes are compressed. none also keeps all bits of positions and normals.");
    std::vector<NamedChoice<std::string>> formats = {
        {"webp", "webp", "WebP, with EXT_texture_webp"},
        {"avif", "avif", "AVIF, with EXT_texture_avif; needs a build with libavif, and is slow"},
        {"jpeg", "jpeg", "JPEG; images whose alpha is used keep their format"},
        {"png", "png", "PNG, lossless"},
        {"keep", "keep", "the current format of each image"}};
    d.choice<std::string>("images", &FitOptions::images, formats,
                          "The format of images that become smaller. Other images do not change.")
        .also_called("texture_format image_format");
    d.option("max_size", &FitOptions::max_size,
             "The longest side of an image, in pixels. Larger images always become smaller.")
        .also_called("resize texture_size")
        .between(16, 16384);
    d.option("drop_names", &FitOptions::drop_names, "Removes names, as write: {drop_names: true} does.");
}

void verify_fit(const FitOptions& o, const Value& given, Problems& problems) {
    const auto refuse = [&](const char* option, std::string what, std::string hint, const char* id) {
        add_refusal(Refusal{option, std::move(what), std::move(hint), id}, "fit", given, problems);
    };
    const auto deferred = [&](const char* option) {
        const Value* value = given.is_map() ? given.find(option) : nullptr;
        return value && value->deferred;
    };
    if (o.images == "avif" && !io::has_avif())
        refuse("images", "AVIF needs libavif, which this build lacks", "use images: webp", "E-AVIF");
    // `off` may come from params of a pipeline whose condition then skips the stage.
    const bool names_one = given.is_map() && (given.find("budget") || given.find("look"));
    if (!o.budget && !o.look && !names_one)
        refuse("budget", "neither 'budget' nor 'look' is given", "give budget: 500kB, look: 0.5%, or both",
               "E-MISSING");
    if (o.budget && !deferred("budget") && (o.budget->min || !(o.budget->max.value_or(0) > 0)))
        refuse("budget", "'budget' must be a single size above 0", "give budget: 500kB", "E-RANGE");
    const io::Codec* codec = o.path.text == "-" ? io::codec_named("glb") : io::codec_for(o.path.text);
    if (!deferred("path") &&
        (!codec || !codec->write || !codec->can.honours("meshopt") || codec->can.honours("tiles")))
        refuse("path", fmt::format("'{}' is not the path of a glTF file", o.path.text),
               "give a path that ends in .glb or .gltf", "E-FORMAT");
}

} // namespace facetmill::fit_stage
