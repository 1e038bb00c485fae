#pragma once
// The keys that every step of a pipeline accepts besides its stage's options, and the control items. They
// are declared once for the parser, the one-liner, the help and the schema.

#include "base/json.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

struct CommonKey {
    /// How the planner uses the key: its switch has a case for each.
    enum class Use { names, conditions, selects, ensures };
    Use use;
    std::string name;
    std::string help;
    Json (*schema)(); ///< schema of the value, without expressions
};

/// The keys name, when, only and ensure, in the order of the help.
const std::vector<CommonKey>& common_keys();
bool is_common_key(std::string_view name);

/// A list item that contains stages instead of being one.
struct ControlItem {
    enum class Kind { branch, foreach, include };
    Kind kind;
    std::string name, about;
    std::vector<std::string> keys; ///< keys allowed next to it
    bool takes_common_keys = true;
};

/// The items branch, foreach and include.
const std::vector<ControlItem>& control_items();
/// The item with this name, or null.
[[nodiscard]] const ControlItem* control_item(std::string_view name);
inline bool is_control_item(std::string_view name) { return control_item(name) != nullptr; }

} // namespace facetmill
