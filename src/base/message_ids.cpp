#include "base/message_ids.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// A function, because other files register rows before the constants of this file exist.
std::vector<MessageId>& registry() {
    static std::vector<MessageId> rows;
    return rows;
}

std::vector<MessageId> sorted_ids() {
    auto rows = registry();
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    const auto twice = std::adjacent_find(rows.begin(), rows.end(),
                                          [](const auto& a, const auto& b) { return a.id == b.id; });
    if (twice != rows.end())
        throw Error(ErrorKind::bug, "E-BUG", fmt::format("the message id {} is registered twice", twice->id));
    return rows;
}

} // namespace

RegisterMessages::RegisterMessages(std::initializer_list<MessageId> rows) {
    registry().insert(registry().end(), rows);
}

const std::vector<MessageId>& message_ids() {
    static const auto sorted = sorted_ids();
    return sorted;
}

const MessageId* message_id(std::string_view id) {
    const auto& all = message_ids();
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& known) { return known.id == id; });
    return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> warning_ids() {
    std::vector<std::string> ids;
    for (const auto& known : message_ids())
        if (known.is_warning()) ids.emplace_back(known.id);
    return ids;
}

} // namespace facetmill
