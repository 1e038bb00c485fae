#include "base/json.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;
template class std::vector<facetmill::Json>;

namespace facetmill {

Json parse_json(std::string_view text, Broken broken) {
    return Json::parse(text.data(), text.data() + text.size(), nullptr, broken == Broken::thrown);
}

} // namespace facetmill
