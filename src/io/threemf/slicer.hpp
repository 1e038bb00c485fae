#pragma once
// The purposes that slicers give to volumes: negative volumes, modifiers, enforcers and blockers of supports.
// PrusaSlicer and its kin name ranges of triangles, Bambu Studio and its kin components.

#include "io/threemf/model.hpp"
#include "io/threemf/zip.hpp"

namespace facetmill::io::threemf {

class SlicerVolumes {
  public:
    /// Reads the settings files of the archive, if there are any. name: of the archive, for messages.
    SlicerVolumes(Archive& archive, const std::string& name);

    /// Removes the triangles that are not printed, but never all of an object. left_out: the counts of
    /// volumes by their purpose, to which it adds.
    void remove_from(std::map<std::uint32_t, Object>& objects,
                     std::map<std::string, std::size_t>& left_out) const;

    /// The purpose of a component that is not printed; null if it is printed.
    [[nodiscard]] const std::string* purpose(std::uint32_t object, std::uint32_t component) const;

    /// Messages about files that cannot be read. They do not concern the geometry.
    [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

  private:
    struct Range {
        std::uint32_t first = 0, last = 0; ///< triangles, both included
        std::string purpose;               ///< empty: a part of the model
    };
    void read_ranges(Span xml, const std::string& name);
    void read_components(Span xml, const std::string& name);

    std::map<std::uint32_t, std::vector<Range>> ranges_; ///< by object
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> components_;
    std::vector<std::string> faults_;
};

} // namespace facetmill::io::threemf
