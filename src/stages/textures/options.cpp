#include "stages/textures/options.hpp"

#include "io/images/avif.hpp"
#include "io/images/ktx_workers.hpp"
#include "options/mark_at.hpp"
#include "platform/worker_process.hpp"
#include "stage/options/synonyms.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

using MaybeFormat = std::optional<Format>;

constexpr std::int64_t longest_side = 16384; // the longest side of any readable image

template <class F>
std::vector<NamedChoice<F>> formats() {
    return {{"keep", Format::keep, "the current format of each image"},
            {"png", Format::png, "PNG, lossless"},
            {"jpeg", Format::jpeg, "progressive JPEG, without alpha"},
            {"webp", Format::webp, "WebP, through EXT_texture_webp"},
            {"avif", Format::avif, "AVIF, through EXT_texture_avif; needs a build with libavif"},
            {"ktx2", Format::ktx2, "KTX2, through KHR_texture_basisu; needs the program ktx or toktx"}};
}

void declare_role(Declare<RoleOptions>& d) {
    d.option("max_size", &RoleOptions::max_size, "The same option for these images only.")
        .also_called("resize resolution texture_size")
        .between(1, longest_side);
    d.option("power_of_two", &RoleOptions::power_of_two, "The same option for these images only.");
    d.choice<MaybeFormat>("format", &RoleOptions::format, formats<MaybeFormat>(),
                          "The same option for these images only.")
        .also_called(format_synonyms);
    d.option("quality", &RoleOptions::quality, "The same option for these images only.").between(1, 100);
    d.option("lossless", &RoleOptions::lossless, "The same option for these images only.");
}

ImageSettings with_role(const TexturesOptions& o, const RoleOptions& role, int quality) {
    ImageSettings s;
    s.max_size = static_cast<std::size_t>(role.max_size.value_or(o.max_size.value_or(longest_side)));
    s.power_of_two = role.power_of_two.value_or(o.power_of_two);
    s.lossless = role.lossless.value_or(o.lossless);
    s.format = role.format.value_or(o.format);
    s.quality = static_cast<int>(role.quality.value_or(o.quality.value_or(quality)));
    return s;
}

} // namespace

std::string name_of(Format format) {
    for (const auto& known : formats<Format>())
        if (known.value == format) return known.name;
    return {};
}

ImageSettings for_colours(const TexturesOptions& o) { return with_role(o, {}, 80); }
ImageSettings for_normals(const TexturesOptions& o) { return with_role(o, o.normals, 90); }
ImageSettings for_data(const TexturesOptions& o) { return with_role(o, o.data, 90); }

bool wants(const TexturesOptions& o, Format format) {
    return for_colours(o).format == format || for_normals(o).format == format || for_data(o).format == format;
}

void declare_textures(Declare<TexturesOptions>& d) {
    d.option(
         "max_size", &TexturesOptions::max_size,
         "The longest side in pixels. Larger images are scaled down to it. By default, no image is scaled.")
        .also_called("resize resolution texture_size")
        .between(1, longest_side)
        .primary();
    d.option("power_of_two", &TexturesOptions::power_of_two,
             "Scales each side down to a power of two, which some older hardware needs.");
    d.choice<Format>("format", &TexturesOptions::format, formats<Format>(),
                     "The format of the images. An image is converted only if it becomes smaller.")
        .also_called(format_synonyms);
    d.option("quality", &TexturesOptions::quality,
             "The quality of converted or scaled JPEG, WebP, AVIF and KTX2 images. Default: 80 for colours "
             "and 90 "
             "for others.")
        .between(1, 100);
    d.option("lossless", &TexturesOptions::lossless, "Writes lossless WebP or AVIF.");
    d.option("repack", &TexturesOptions::repack,
             "Repacks PNG and JPEG images that would stay unchanged, if that makes them smaller. Pixels do "
             "not change.");
    d.option("atlas", &TexturesOptions::atlas,
             "Merges materials of the same kind and puts their textures into an atlas of at most max_size "
             "(4096 by default).");
    d.option("gutter", &TexturesOptions::gutter,
             "The width of the border around each texture of an atlas, in texels, rounded up to a power of "
             "two. The default keeps textures apart in three mipmap levels.")
        .between(1, 256);
    d.option("unroll", &TexturesOptions::unroll,
             "The most copies of a repeated texture in an atlas. Materials with more repeats are not merged.")
        .between(1, 1024);
    d.option("timeout", &TexturesOptions::timeout,
             "Time limit in seconds for ktx or toktx per image. The run fails when it is exceeded.")
        .between(1, 86400);
    d.group("normals", &TexturesOptions::normals, "Different settings for normal maps.", declare_role);
    d.group("data", &TexturesOptions::data,
            "Different settings for images that are neither colours nor normals.", declare_role);
}

void verify_textures(const TexturesOptions& o, const Value& given, Problems& problems) {
    if (wants(o, Format::avif) && !io::has_avif()) {
        add_refusal(Refusal{"format", "AVIF needs libavif, which this build lacks",
                            "use format: webp, or install libavif-dev and build facetmill again", "E-AVIF"},
                    "textures", given, problems);
        return;
    }
    if (wants(o, Format::ktx2) && !has_workers()) {
        add_refusal(Refusal{"format", "facetmill cannot write KTX2 on this system",
                            "use format: webp, or run this stage on Linux", "E-KTX"},
                    "textures", given, problems);
        return;
    }
    if (wants(o, Format::ktx2) && !io::ktx_program()) {
        const char* named = std::getenv("FACETMILL_KTX");
        add_refusal(
            Refusal{"format",
                    named && *named ? fmt::format("FACETMILL_KTX is not the path of a program: '{}'", named)
                                    : "KTX2 needs the program ktx or toktx, but neither is in PATH",
                    "install KTX-Software (https://github.com/KhronosGroup/KTX-Software/releases), or give "
                    "the path of the program in FACETMILL_KTX; format: webp needs no other program",
                    "E-KTX"},
            "textures", given, problems);
        return;
    }
    const std::pair<const char*, ImageSettings> roles[] = {
        {"lossless", for_colours(o)}, {"normals", for_normals(o)}, {"data", for_data(o)}};
    for (const auto& [option, s] : roles) {
        if (!s.lossless || s.format == Format::webp || s.format == Format::avif || s.format == Format::keep)
            continue;
        add_refusal(
            Refusal{option, "'lossless' needs format: webp or avif", "use format: webp, or remove it"},
            "textures", given, problems);
        return;
    }
}

} // namespace facetmill::textures_stage
