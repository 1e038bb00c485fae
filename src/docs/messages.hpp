#pragma once
// Describes the ids of errors and warnings: `facetmill explain`, its Markdown, and the manual page
// facetmill-messages(7). All of it comes from base/message_ids.hpp.

#include "base/json.hpp"
#include "base/message_ids.hpp"

namespace facetmill::docs {

/// An id as people may type it: "w-units" -> "W-UNITS".
[[nodiscard]] std::string id_of(std::string text);
/// A line per id.
[[nodiscard]] std::string message_list();
/// The page of an id: its meaning, its exit code, the remedy.
[[nodiscard]] std::string message_page(const MessageId& message);
/// All ids, as one Markdown page.
[[nodiscard]] std::string messages_markdown();
/// All ids as a manual page, facetmill-messages(7).
[[nodiscard]] std::string messages_man();
/// The registry as JSON: id, severity, exit codes, meaning, hint.
[[nodiscard]] Json messages_json();

} // namespace facetmill::docs
