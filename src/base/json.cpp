#include "base/json.hpp"

#include "base/fast_json.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace facetmill {

Json parse_json(std::string_view text, Broken broken) {
    if (auto read = fast_json(text)) return *std::move(read);
    const char *const begin = text.data(), *const end = begin + text.size();
    // Discards everything of an invalid text, because the library would first take time quadratic in the
    // number of members.
    const bool whole = Json::accept(begin, end);
    const auto nothing = [](int, Json::parse_event_t, Json&) { return false; };
    return Json::parse(begin, end, whole ? nullptr : Json::parser_callback_t(nothing),
                       broken == Broken::thrown);
}

} // namespace facetmill
