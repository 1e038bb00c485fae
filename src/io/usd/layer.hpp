#pragma once
// The text of a USD layer (.usda).

#include "base/text/unique_names.hpp"
#include "io/flatten.hpp"

#include <array>
#include <vector>

namespace facetmill::io::usd {

/// Turns a name into an identifier of ASCII letters, digits and underscores that does not start with a digit.
/// An empty name becomes `otherwise`.
[[nodiscard]] std::string identifier(std::string_view name, std::string_view otherwise);

/// The numbers as "(1, 2, 3)", with the shortest digits of float32.
template <std::size_t Size>
[[nodiscard]] std::string tuple(const std::array<double, Size>& numbers) {
    std::string text = "(";
    for (std::size_t k = 0; k < Size; ++k) {
        if (k > 0) text += ", ";
        put_number(text, static_cast<float>(numbers[k]));
    }
    return text + ")";
}

class Layer {
  public:
    /// depth: the number of prims around its text.
    explicit Layer(std::size_t depth) : names_(1), depth_(depth) {}

    /// Begins a prim, for example "def Xform", and returns its name, which is unique below its parent. If
    /// they differ, customData keeps the wanted name. metadata: further lines for the prim.
    std::string open(std::string_view type, std::string_view wanted, std::string_view otherwise,
                     std::vector<std::string> metadata = {});
    void close();
    void line(std::string_view text);
    /// "declaration = [...]": put(i, text) appends item i.
    template <class Put>
    void array(std::string_view declaration, std::size_t count, Put&& put, std::string_view after = "");
    /// Appends the text of another layer, which has its own depth.
    void add(const Layer& other) { text_.insert(text_.end(), other.text_.begin(), other.text_.end()); }
    /// Reserves a name for a prim at the outermost level.
    void take(const std::string& name) { names_.front().take(name); }

    [[nodiscard]] bool empty() const { return text_.empty(); }
    Bytes& text() { return text_; }

  private:
    void indent();

    Bytes text_;
    std::vector<UniqueNames> names_; ///< the names below each open prim
    std::size_t depth_;
};

template <class Put>
void Layer::array(std::string_view declaration, std::size_t count, Put&& put, std::string_view after) {
    indent();
    append(text_, declaration);
    append(text_, " = [");
    append_text(text_, count, [&](std::size_t begin, std::size_t end, std::string& out) {
        for (std::size_t i = begin; i < end; ++i) {
            if (i > 0) out += ", ";
            put(i, out);
        }
    });
    append(text_, "]");
    append(text_, after);
    append(text_, "\n");
}

} // namespace facetmill::io::usd
