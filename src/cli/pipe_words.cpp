#include "cli/pipe_words.hpp"

#include "stage/common_keys.hpp"
#include "stage/stage.hpp"

#include <algorithm>

namespace facetmill::cli {

bool is_bracket(const std::string& word) { return word == "[" || word == "]"; }
bool is_option(const std::string& word) { return word.size() > 2 && word.starts_with("--"); }
bool is_step(const std::string& word) { return stage_named(word) || is_control_item(word); }

bool PipeWords::at_end_of_step() const { return done() || word() == "!" || word() == "+" || word() == "]"; }

const std::string* PipeWords::before(std::size_t back) const {
    return at_ >= back && at_ - back < all().size() ? &all()[at_ - back] : nullptr;
}

Mark PipeWords::mark_before(std::size_t back) const {
    return line_->mark(std::min(at_ - back, all().size() - 1));
}

Mark PipeWords::inside(std::size_t offset) const {
    Mark m = mark();
    if (m.length != static_cast<int>(word().size()) || m.length <= static_cast<int>(offset)) return m;
    m.column += static_cast<int>(offset);
    m.length -= static_cast<int>(offset);
    return m;
}

void PipeWords::wrong(std::string message, std::string hint) const {
    problems_->add(mark(), "E-PIPE", std::move(message), std::move(hint));
}

} // namespace facetmill::cli
