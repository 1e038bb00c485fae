#include "stage/common_keys.hpp"

#include "stage/contract.hpp"

#include <algorithm>

namespace facetmill {

namespace {

Json text_schema() { return {{"type", "string"}}; }

Json texts_schema() {
    return {{"anyOf", Json::array({text_schema(), {{"type", "array"}, {"items", text_schema()}}})}};
}

Json condition_schema() {
    return {{"anyOf", Json::array({{{"type", Json::array({"boolean", "string"})}}, assertions_schema()})}};
}

} // namespace

const std::vector<CommonKey>& common_keys() {
    static const std::vector<CommonKey> keys{
        {CommonKey::Use::names, "name", "The unique name of this step, for the report, --set and messages.",
         text_schema},
        {CommonKey::Use::conditions, "when",
         "Runs the step only if this holds: a bool param, ${a} == value, or properties as in ensure.",
         condition_schema},
        {CommonKey::Use::selects, "only",
         "The parts to process: names or globs of parts or materials. \"!glob\" excludes.", texts_schema},
        {CommonKey::Use::ensures, "ensure",
         "Checks that the result of the step has these properties: {closed: true, faces: {max: 5000}}.",
         contract_schema},
    };
    return keys;
}

bool is_common_key(std::string_view name) {
    const auto& keys = common_keys();
    return std::any_of(keys.begin(), keys.end(), [&](const CommonKey& key) { return key.name == name; });
}

const std::vector<ControlItem>& control_items() {
    static const std::vector<ControlItem> items{
        {ControlItem::Kind::branch, "branch", "Runs several lists of stages on the same scene", {"join"}},
        {ControlItem::Kind::foreach,
         "foreach",
         "Runs stages once for each of several values",
         {"join", "do"}},
        {ControlItem::Kind::include, "include", "Runs the stages of another file", {"with"}, false},
    };
    return items;
}

const ControlItem* control_item(std::string_view name) {
    for (const ControlItem& item : control_items())
        if (item.name == name) return &item;
    return nullptr;
}

} // namespace facetmill
