// facetmill formats: what can be read and written.

#include "base/json.hpp"
#include "cli/command.hpp"
#include "io/codec.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill::cli {

namespace {

constexpr const char* formats_examples =
    R"(A file is read by its content where that is sure, else by its extension; .gz is inflated.

Examples
  facetmill formats
  facetmill formats --json
)";

std::string directions(const io::Codec& codec) {
    return fmt::format("{}{}", codec.read ? "r" : "-", codec.write ? "w" : "-");
}

int list_formats(bool json) {
    Json all = Json::array();
    std::string text;
    for (const auto& c : io::codecs()) {
        all.push_back({{"name", c.name},
                       {"about", c.about},
                       {"extensions", c.extensions},
                       {"read", static_cast<bool>(c.read)},
                       {"write", static_cast<bool>(c.write)},
                       {"unit", to_string(c.unit)},
                       {"up", to_string(c.up)}});
        text += fmt::format("{:<6} {}  .{:<14} {}\n", c.name, directions(c), fmt::join(c.extensions, " ."),
                            c.about);
    }
    print(json ? all.dump(2) + "\n" : text);
    return 0;
}

} // namespace

Command formats_command() {
    return {"formats", "Lists the formats that are read and written.", formats_examples, false,
            [](CLI::App& app, Console&) {
                auto json = std::make_shared<bool>(false);
                app.add_flag("--json", *json, "As JSON.");
                return [=](const Invocation&) { return list_formats(*json); };
            }};
}

} // namespace facetmill::cli
