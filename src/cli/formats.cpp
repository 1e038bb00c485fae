// facetmill formats: the formats that facetmill reads and writes.

#include "base/json.hpp"
#include "cli/command.hpp"
#include "io/codec.hpp"
#include "io/images/avif.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill::cli {

namespace {

constexpr const char* formats_examples =
    R"(The content of a file determines its format. If the content is not conclusive, the suffix decides. Files that end
in .gz and .zst are decompressed. Text may be UTF-8 or UTF-16. Helper programs beside facetmill read FBX, STEP
and others. Without a helper, the list shows what to install.

Examples
  facetmill formats
  facetmill formats --json
)";

std::string directions(const io::Codec& codec) {
    return fmt::format("{}{}", codec.reads() ? "r" : "-", codec.write ? "w" : "-");
}

const char* draco_word(const io::Capabilities& can) {
    return can.always_draco ? "always" : can.honours("draco") ? "on request" : "never";
}

std::vector<std::pair<std::string, bool>> abilities(const io::Capabilities& can) {
    std::vector<std::pair<std::string, bool>> all{{"polygons", can.polygons},
                                                  {"shares_vertices", can.shares_vertices},
                                                  {"normals", can.normals},
                                                  {"transforms", can.transforms},
                                                  {"skins", can.skins},
                                                  {"points", can.points},
                                                  {"points_and_faces", can.points_and_faces},
                                                  {"lines", can.lines},
                                                  {"curves", can.curves},
                                                  {"documents", can.documents},
                                                  {"text", can.honours("ascii")},
                                                  {"big_endian", can.honours("big_endian")},
                                                  {"full_precision", can.full_precision}};
    for (const char* option : {"mesh_manifold", "lods", "textures", "quantize", "meshopt", "order", "tiles"})
        all.emplace_back(option, can.honours(option));
    return all;
}

/// "in m, y up; polygons, text, draco on request; attributes: all".
std::string abilities_text(const io::Codec& codec) {
    std::vector<std::string> words;
    for (const auto& [name, has] : abilities(codec.can))
        if (has) words.push_back(name);
    if (codec.can.honours("draco")) words.push_back(fmt::format("draco {}", draco_word(codec.can)));
    const std::string unit =
        codec.unit == Unit::unknown ? "no unit" : "in " + std::string(to_string(codec.unit));
    const std::string up = codec.up == UpAxis::unknown ? "" : fmt::format(", {} up", to_string(codec.up));
    return fmt::format("{}{}; {}; attributes: {}", unit, up, fmt::join(words, ", "), codec.can.attributes);
}

Json format_json(const io::Codec& codec) {
    Json can = Json::object();
    for (const auto& [name, has] : abilities(codec.can)) can[name] = has;
    can["draco"] = draco_word(codec.can);
    can["attributes"] = codec.can.attributes;
    can["companion"] = codec.can.companion.empty() ? Json() : Json(codec.can.companion);
    const std::string missing = codec.missing ? codec.missing() : "";
    return {{"name", codec.name},
            {"about", codec.about},
            {"extensions", codec.extensions},
            {"read", codec.reads()},
            {"missing", missing.empty() ? Json() : Json(missing)},
            {"write", static_cast<bool>(codec.write)},
            {"unit", to_string(codec.unit)},
            {"up", to_string(codec.up)},
            {"can", can}};
}

int list_formats(bool json) {
    Json all = Json::array();
    std::string text;
    for (const auto& c : io::codecs()) {
        all.push_back(format_json(c));
        text += fmt::format("{:<6} {}  .{:<14} {}\n{:<26}{}\n", c.name, directions(c),
                            fmt::join(c.extensions, " ."), c.about, "", abilities_text(c));
        if (c.read && !c.reads()) text += fmt::format("{:<26}{}\n", "", c.missing());
    }
    if (!io::has_avif()) text += "AVIF images: not in this build, which has no libavif\n";
    print(json ? all.dump(2) + "\n" : text);
    return 0;
}

} // namespace

Command formats_command() {
    return {"formats",
            "Lists the formats that facetmill reads and writes.",
            formats_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto json = std::make_shared<bool>(false);
                arguments.add("--json", json.get(), "Prints JSON.");
                return [=](const Invocation&) { return list_formats(*json); };
            }};
}

} // namespace facetmill::cli
