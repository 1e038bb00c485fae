#include "stages/textures/options.hpp"

#include "io/images/ktx_workers.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace facetmill::textures_stage {

namespace {

using MaybeFormat = std::optional<Format>;

constexpr std::int64_t longest_side = 16384; // the longest side of any readable image

template <class F>
std::vector<NamedChoice<F>> formats() {
    return {{"keep", Format::keep, "the format that each has"},
            {"png", Format::png, "without loss"},
            {"jpeg", Format::jpeg, "progressive JPEG, without alpha"},
            {"webp", Format::webp, "WebP, by EXT_texture_webp"},
            {"ktx2", Format::ktx2, "KTX2, by KHR_texture_basisu; needs the program ktx or toktx"}};
}

void declare_role(Declare<RoleOptions>& d) {
    d.option("max_size", &RoleOptions::max_size, "As above, for these.")
        .also_called("resize resolution texture_size")
        .between(1, longest_side);
    d.option("power_of_two", &RoleOptions::power_of_two, "As above, for these.");
    d.choice<MaybeFormat>("format", &RoleOptions::format, formats<MaybeFormat>(), "As above, for these.")
        .also_called(format_synonyms);
    d.option("quality", &RoleOptions::quality, "As above, for these.").between(1, 100);
    d.option("lossless", &RoleOptions::lossless, "As above, for these.");
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

bool wants_ktx2(const TexturesOptions& o) {
    return for_colours(o).format == Format::ktx2 || for_normals(o).format == Format::ktx2 ||
           for_data(o).format == Format::ktx2;
}

void declare_textures(Declare<TexturesOptions>& d) {
    d.option(
         "max_size", &TexturesOptions::max_size,
         "The longest side in pixels: larger images are scaled down to it (a count; if not given, none are).")
        .also_called("resize resolution texture_size")
        .between(1, longest_side)
        .primary();
    d.option("power_of_two", &TexturesOptions::power_of_two,
             "Scales each side down to a power of two, as some older hardware needs it.");
    d.choice<Format>("format", &TexturesOptions::format, formats<Format>(),
                     "The format of the images, as far as they become smaller in it.")
        .also_called(format_synonyms);
    d.option("quality", &TexturesOptions::quality,
             "Of JPEG, WebP and KTX2, where an image is written anew; if not given, 80 for colours and 90 "
             "for the "
             "others (a count).")
        .between(1, 100);
    d.option("lossless", &TexturesOptions::lossless, "Writes WebP without loss.");
    d.option(
        "repack", &TexturesOptions::repack,
        "Packs PNG and JPEG images that would stay as they are anew where that makes them smaller, without "
        "a change of a pixel.");
    d.option("timeout", &TexturesOptions::timeout,
             "Seconds that ktx or toktx may take for one image before the run fails (a count).")
        .between(1, 86400);
    d.group("normals", &TexturesOptions::normals, "What is different for normal maps.", declare_role);
    d.group("data", &TexturesOptions::data,
            "What is different for images that are neither colours nor normals.", declare_role);
}

void verify_textures(const TexturesOptions& o, const Value& given, Problems& problems) {
    if (wants_ktx2(o) && !io::ktx_program()) {
        const char* named = std::getenv("FACETMILL_KTX");
        add_refusal(
            Refusal{"format",
                    named && *named ? fmt::format("FACETMILL_KTX names no program: '{}'", named)
                                    : "KTX2 is encoded by the program ktx or toktx, and neither is in PATH",
                    "install KTX-Software (https://github.com/KhronosGroup/KTX-Software/releases), or name "
                    "the program by the variable FACETMILL_KTX; format: webp needs no other program",
                    "E-KTX"},
            "textures", given, problems);
        return;
    }
    const std::pair<const char*, ImageSettings> roles[] = {
        {"lossless", for_colours(o)}, {"normals", for_normals(o)}, {"data", for_data(o)}};
    for (const auto& [option, s] : roles) {
        if (!s.lossless || s.format == Format::webp || s.format == Format::keep) continue;
        add_refusal(
            Refusal{option, "'lossless' goes with format: webp only", "use format: webp, or leave it out"},
            "textures", given, problems);
        return;
    }
}

} // namespace facetmill::textures_stage
