#include "base/json.hpp"

#include "base/quick_json.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;
template class std::vector<facetmill::Json>;

namespace facetmill {

Json parse_json(std::string_view text, Broken broken) {
    if (auto read = quick_json(text)) return *std::move(read);
    return Json::parse(text.data(), text.data() + text.size(), nullptr, broken == Broken::thrown);
}

} // namespace facetmill
