// Rules between the objects of a document.

#include "io/gltf/document/rules.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

class DocumentRules {
  public:
    explicit DocumentRules(const CheckedDocument& document) : document_(document) {}

    void run() {
        extensions();
        for (std::size_t c = 0; c < count_of(document_.json, "cameras"); ++c)
            camera(item(document_.json, "cameras", c));
        lights();
    }

  private:
    void extensions() {
        const auto needed = list(document_.json, "extensionsRequired");
        for (std::size_t i = 0; needed && i < needed->size(); ++i)
            if (!uses_extension(document_.json, needed->at(i).text()))
                document_.breaches.add(needed->at(i), "is not in extensionsUsed");
        const auto used = list(document_.json, "extensionsUsed");
        constexpr const char* quantization = "KHR_mesh_quantization";
        for (std::size_t i = 0; used && i < used->size(); ++i)
            if (used->at(i).json() == quantization &&
                !(needed && std::count(needed->json().begin(), needed->json().end(), Json(quantization)) > 0))
                document_.breaches.add(used->at(i), "is not in extensionsRequired");
    }

    void camera(const JsonCursor& place) {
        const std::string type = place.text_or("type", "");
        for (const char* of : {"perspective", "orthographic"})
            if (place.json().contains(of) != (type == of))
                document_.breaches.add(
                    place, fmt::format("its type is {}, {} {}", type,
                                       type == of ? "without the member" : "with the member", of));
        if (const auto lens = place.find("orthographic"))
            for (const char* key : {"xmag", "ymag"})
                if (const auto half = lens->find(key); half && !(half->real() > 0))
                    document_.breaches.add(*half, "must be greater than 0");
        for (const char* of : {"perspective", "orthographic"}) {
            const auto lens = place.find(of);
            if (!lens || !lens->find("zfar") || !lens->find("znear")) continue;
            if (!(lens->at("zfar").real() > lens->at("znear").real()))
                document_.breaches.add(lens->at("zfar"), "is not greater than znear");
        }
    }

    void lights() {
        const Json::json_pointer place("/extensions/KHR_lights_punctual/lights");
        if (!document_.json.contains(place)) return;
        const JsonCursor lights(document_.json[place], "extensions.KHR_lights_punctual.lights");
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const auto spot = lights.at(i).find("spot");
            if (lights.at(i).text_or("type", "") == "spot" && !spot)
                document_.breaches.add(lights.at(i), "\"spot\" is missing");
            if (!spot) continue;
            const double inner = spot->find("innerConeAngle") ? spot->at("innerConeAngle").real() : 0;
            constexpr double usual = 0.7853981633974483; // pi / 4
            const double outer = spot->find("outerConeAngle") ? spot->at("outerConeAngle").real() : usual;
            if (!(inner < outer)) document_.breaches.add(*spot, "the inner cone is not inside the outer one");
        }
    }

    const CheckedDocument& document_;
};

} // namespace

std::size_t number_in(const Json& owner, const char* key, std::size_t otherwise) {
    const auto found = owner.find(key);
    return found == owner.end() ? otherwise : static_cast<std::size_t>(found->get<double>());
}

std::string format_of(const Json& accessor) {
    return fmt::format("{} {}{}", accessor["type"].get<std::string>(), number_in(accessor, "componentType"),
                       accessor.value("normalized", false) ? " normalized" : "");
}

bool is_one_of(const std::string& text, std::initializer_list<const char*> all) {
    return std::find(all.begin(), all.end(), text) != all.end();
}
void check_rules(const Json& json, Breaches& breaches) {
    const CheckedDocument document{json, breaches};
    DocumentRules(document).run();
    check_nodes(document);
    check_meshes(document);
    check_animations(document);
    check_data(document);
}

} // namespace facetmill::io::gltf
