#pragma once
// A glTF document being written: new accessors and buffer views are added, those that nothing names any more
// are dropped, and one buffer is built of what is left.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/gltf/numbers/compress.hpp"
#include "io/gltf/numbers/quantise.hpp"

#include <functional>
#include <set>

namespace facetmill::io::gltf {

/// The document under construction. Begins as a document that was read (with its buffers), or as an empty
/// one.
class Builder {
  public:
    Builder(Json document, const std::vector<Bytes>* buffers);
    ~Builder();
    Builder(const Builder&) = delete;
    Builder& operator=(const Builder&) = delete;

    Json& json() { return json_; }
    /// The document as it was read.
    Source& source() { return source_; }
    /// The document as it is now, with the views that were added.
    Source& current() { return current_; }

    /// Adds bytes as a buffer view; target and stride 0 are not written. Returns its index.
    std::size_t add_view(Bytes bytes, int target = 0, std::size_t stride = 0);
    std::size_t add_accessor(Json accessor);
    /// Adds vertex data as a view of its own and an accessor. Returns the accessor's index.
    std::size_t add_stored(Stored stored, int target);

    /// Positions with the bits that float32 has not, for whoever rounds them again: by accessor.
    std::map<std::size_t, std::vector<Vec3>> exact_positions;
    /// What the Draco data of the views is decoded to.
    DracoDecodings decoded;
    /// Appends to a top-level array, which is made when missing. Returns the index.
    std::size_t add(const char* list, Json value);

    /// Notes the accessors and views that a primitive uses: they go when nothing else names them.
    void release(const Json& primitive);
    void release_mesh(const Json& mesh); ///< the same of all primitives and extensions of a mesh
    /// Views that can be are written compressed, under the settings' extension, where that pays.
    void compress(const MeshoptSettings& settings) { meshopt_ = settings; }
    void use_extension(const std::string& name, bool required);
    void drop_extension(const std::string& name);

    /// Drops what was released and is not used, removes lists that became empty, and gives the bytes of the
    /// one buffer. Views that were compressed by meshopt are written plain, with a warning, unless
    /// compress asks for it.
    Bytes finish(std::vector<Diagnostic>& warnings);

  private:
    void drop_released();
    void join_views();
    std::vector<std::optional<Packing>> packings_now() const;
    std::vector<Bytes> packed_views(const std::vector<std::optional<Packing>>& how);
    bool passes_through(std::size_t view) const;
    Json pack_view(std::size_t view, const std::optional<Packing>& packing, const Bytes& packed,
                   Bytes& buffer);
    Bytes build_buffer(std::vector<Diagnostic>& warnings);
    void list_buffers(std::size_t bytes);

    Json original_, json_;
    std::vector<Bytes> no_buffers_;
    std::map<std::size_t, Bytes> new_views_;     // by index at the time of adding
    std::map<std::size_t, std::string> filters_; // of new views
    Source source_, current_;
    std::vector<std::size_t> old_view_; // the index that each remaining view had
    std::set<std::size_t> released_accessors_, released_views_;
    MeshoptSettings meshopt_;
    std::size_t unpacked_bytes_ = 0; ///< of the buffer that is not there, which compressed views stand for
    std::map<std::size_t, std::vector<std::size_t>>
        dataless_; // views of buffers that have no bytes, by buffer
};

/// Calls visit for every reference to an accessor, a buffer view or a mesh that is known to the standard and
/// to the extensions that are understood.
void visit_accessor_references(Json& document, const std::function<void(Json&)>& visit);
void visit_view_references(Json& document, const std::function<void(Json&)>& visit);
void see_view_references(const Json& document, const std::function<void(const Json&)>& see);
void visit_mesh_references(Json& document, const std::function<void(Json&)>& visit);
/// True when the document has an extension whose references we cannot know: then nothing may be renumbered.
bool has_unknown_extensions(const Json& document);
/// Erases items of a list and renumbers the references to it.
void erase_items(Json& list, const std::set<std::size_t>& items,
                 const std::function<void(const std::function<void(Json&)>&)>& references);

} // namespace facetmill::io::gltf
