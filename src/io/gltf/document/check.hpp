#pragma once
// The rules of glTF 2.0 (Khronos Group, 2021) and of the usual extensions.

#include "io/gltf/document/accessor.hpp"

namespace facetmill::io::gltf {

/// Broken rules that do not prevent reading.
class Breaches {
  public:
    void add(const JsonCursor& place, const std::string& message) {
        if (is_listed()) first_.push_back(place.path() + ": " + message);
    }
    /// An error with the place in its message.
    void add(const Error& error) {
        if (is_listed()) first_.push_back(error.diagnostics().front().message);
    }
    std::size_t count() const { return count_; }
    const std::vector<std::string>& first() const { return first_; }

  private:
    /// Further ones are only counted.
    bool is_listed() {
        constexpr std::size_t most = 3;
        return count_++ < most;
    }

    std::size_t count_ = 0;
    std::vector<std::string> first_;
};

/// Writes the integers of the members without a fraction, which glTF allows (`1.0`). Unknown extensions and
/// extras stay. Returns true if the document has changed.
bool make_integers(Json& document);

/// Checks the types, the ranges and the references of all members. Throws malformed (E-GLTF) at a value of a
/// wrong type, at a missing member, and at a reference to nothing, except in scenes: such a document has no
/// meaning.
void check_members(const Json& document, Breaches& breaches);

/// Checks the rules between objects. The members must have been checked.
void check_rules(const Json& json, Breaches& breaches);

/// Sets missing and wrong minima and maxima of accessors from their numbers. Accessors without bytes and
/// accessors of Draco keep theirs. Breaches receive the wrong ones. Returns true if the document has changed.
bool correct_bounds(Json& document, Source& source, Breaches& breaches);

} // namespace facetmill::io::gltf
