#include "io/gltf/document/accessor_uses.hpp"
#include "io/gltf/document/rules.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill::io::gltf {

namespace {

class DataRules {
  public:
    explicit DataRules(const CheckedDocument& document) : document_(document) {}

    void run() {
        for (std::size_t i = 0; i < count_of(document_.json, "images"); ++i)
            image(item(document_.json, "images", i));
        for (std::size_t a = 0; a < count_of(document_.json, "accessors"); ++a)
            accessor(item(document_.json, "accessors", a));
        uses();
    }

  private:
    void image(const JsonCursor& place) {
        const Json& image = place.json();
        if (image.contains("uri") == image.contains("bufferView"))
            document_.breaches.add(place, image.contains("uri") ? "has a uri and a buffer view"
                                                                : "has no uri and no buffer view");
        if (image.contains("bufferView") && !image.contains("mimeType"))
            document_.breaches.add(place, "\"mimeType\" is missing");
        if (image.contains("bufferView") &&
            document_.at("bufferViews", image["bufferView"]).contains("byteStride"))
            document_.breaches.add(place.at("bufferView"), "the view of an image has a byteStride");
    }

    void accessor(const JsonCursor& place) {
        const Json& accessor = place.json();
        const std::size_t size = size_of(static_cast<int>(number_in(accessor, "componentType")));
        const std::size_t components =
            static_cast<std::size_t>(components_of(accessor["type"].get<std::string>()));
        for (const char* bound : {"min", "max"})
            if (const auto numbers = place.find(bound); numbers && numbers->size() != components)
                document_.breaches.add(*numbers, fmt::format("expected {} numbers", components));
        if (accessor.value("normalized", false) && (size == 4 || size == 0))
            document_.breaches.add(place, "floats and 32-bit integers cannot be normalized");
        if (const auto sparse = place.find("sparse");
            sparse && sparse->at("count").natural() > number_in(accessor, "count"))
            document_.breaches.add(sparse->at("count"), "is more than the count of the accessor");
        if (!accessor.contains("bufferView")) {
            if (accessor.contains("byteOffset"))
                document_.breaches.add(place, "has a byteOffset without a buffer view");
            return;
        }
        const Json& view = document_.at("bufferViews", accessor["bufferView"]);
        const std::size_t offset = number_in(accessor, "byteOffset", 0),
                          stride = number_in(view, "byteStride", 0);
        if (size > 0 && (offset % size != 0 || (offset + number_in(view, "byteOffset", 0)) % size != 0))
            document_.breaches.add(place, fmt::format("its offset is not a multiple of {} bytes", size));
        if (size > 0 && stride % size != 0)
            document_.breaches.add(place, fmt::format("its stride is not a multiple of {} bytes", size));
        if (stride > 0 && stride < size * components)
            document_.breaches.add(
                place, fmt::format("its elements are longer than the stride of {} bytes", stride));
        if (accessor["type"].get<std::string>().starts_with("MAT") && offset % 4 != 0)
            document_.breaches.add(place, "the offset of matrices is not a multiple of 4 bytes");
    }

    using Use = AccessorUse;

    /// Rules for the views of vertices, indices and other numbers.
    void uses() {
        std::map<std::size_t, Use> view_use;
        std::map<std::size_t, std::set<std::size_t>> vertices_of; // by view
        each_accessor_use(document_.json, [&](Use use, const std::string&, const JsonCursor& reference) {
            if (use == Use::instances) return; // the extension has its own rules
            const Json& accessor = document_.at("accessors", reference.json());
            if (!accessor.contains("bufferView")) return;
            const std::size_t v = number_in(accessor, "bufferView");
            const Json& view = document_.json["bufferViews"][v];
            const bool strided = view.contains("byteStride");
            if (use != Use::vertices && strided)
                document_.breaches.add(reference, "its view has a byteStride, which is for vertices");
            const auto target = number_in(view, "target", 0);
            const std::size_t wanted = use == Use::vertices ? 34962 : use == Use::indices ? 34963 : 0;
            if (target != 0 && target != wanted)
                document_.breaches.add(reference,
                                       fmt::format("its view is for another use: target {}", target));
            const auto [known, fresh] = view_use.try_emplace(v, use);
            const bool both = (known->second == Use::vertices) != (use == Use::vertices) ||
                              (known->second == Use::indices) != (use == Use::indices);
            if (!fresh && both) document_.breaches.add(reference, "its view also has data for another use");
            if (use != Use::vertices) return;
            if (number_in(accessor, "byteOffset", 0) % 4 != 0 || number_in(view, "byteOffset", 0) % 4 != 0)
                document_.breaches.add(reference, "the offset of vertices is not a multiple of 4 bytes");
            auto& all = vertices_of[v];
            if (all.insert(reference.natural()).second && all.size() == 2 && !strided)
                document_.breaches.add(reference,
                                       "several accessors of vertices share a view without byteStride");
        });
        for (std::size_t v = 0; v < count_of(document_.json, "bufferViews"); ++v) {
            const JsonCursor place = item(document_.json, "bufferViews", v);
            const auto stride = place.find("byteStride");
            if (stride && stride->natural() % 4 != 0)
                document_.breaches.add(*stride, "is not a multiple of 4");
            if (stride && number_in(place.json(), "target", 34962) != 34962)
                document_.breaches.add(*stride, "is for vertices");
            if (stride && stride->natural() > number_in(place.json(), "byteLength"))
                document_.breaches.add(*stride, "is more than byteLength");
        }
    }

    const CheckedDocument& document_;
};

} // namespace

void check_data(const CheckedDocument& document) { DataRules(document).run(); }

} // namespace facetmill::io::gltf
