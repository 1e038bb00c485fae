#include "stage/options/convention.hpp"

namespace facetmill {

std::vector<NamedChoice<Unit>> unit_choices(std::string none, std::string none_help) {
    return {{std::move(none), Unit::unknown, std::move(none_help)},
            {"um", Unit::um, "micrometres"},
            {"mm", Unit::mm, "millimetres"},
            {"cm", Unit::cm, "centimetres"},
            {"m", Unit::m, "metres"},
            {"km", Unit::km, "kilometres"},
            {"in", Unit::inch, "inches"},
            {"ft", Unit::foot, "feet"}};
}

std::vector<NamedChoice<UpAxis>> up_choices(std::string none, std::string none_help) {
    return {{std::move(none), UpAxis::unknown, std::move(none_help)},
            {"y", UpAxis::y, "the y axis"},
            {"z", UpAxis::z, "the z axis"}};
}

} // namespace facetmill
