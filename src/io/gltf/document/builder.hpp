#pragma once
// Builds a glTF document for writing: adds accessors and buffer views, drops unused ones, and merges the rest
// into one buffer.

#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/draco/draco.hpp"
#include "io/gltf/numbers/compress.hpp"
#include "io/gltf/numbers/quantise.hpp"

#include <functional>
#include <set>
#include <unordered_map>

namespace facetmill::io::gltf {

/// The document under construction. It starts from a document that was read (with its buffers), or empty.
class Builder {
  public:
    Builder(Json document, const std::vector<Bytes>* buffers);
    ~Builder();
    Builder(const Builder&) = delete;
    Builder& operator=(const Builder&) = delete;

    Json& json() { return json_; }
    /// The document as it was read.
    Source& source() { return source_; }
    /// The current document, with the added views.
    Source& current() { return current_; }

    /// Adds bytes as a buffer view; omits target and stride if they are 0. Returns its index.
    std::size_t add_view(Bytes bytes, int target = 0, std::size_t stride = 0);
    std::size_t add_accessor(Json accessor);
    /// Adds vertex data as a separate view with an accessor. Returns the accessor's index. Equal data is
    /// stored once.
    std::size_t add_stored(Stored stored, int target);
    /// Adds indices or vertex data, and an accessor for them; equal ones are stored once.
    std::size_t add_shared(Bytes bytes, int target, std::size_t stride, Json accessor,
                           const std::string& filter = {});
    /// Adds positions, with their values in double precision. Equal ones are stored once.
    std::size_t add_positions(Stored stored, std::vector<Vec3> exact);
    /// Adds the attributes and the compressed view of a primitive; equal ones of equal names are stored once.
    /// make: makes the accessors the first time.
    Json add_compressed(Bytes bytes, const std::string& names, const std::function<Json()>& make);

    /// Positions in double precision for later rounding, by accessor.
    std::map<std::size_t, std::vector<Vec3>> exact_positions;
    /// The decoded contents of the Draco views.
    DracoDecodings decoded;
    /// Appends to a top-level array, creating it if necessary. Returns the index.
    std::size_t add(const char* list, Json value);

    /// Marks the accessors and views of a primitive for removal, unless something else uses them.
    void release(const Json& primitive);
    void release_mesh(const Json& mesh); ///< the same for all primitives and extensions of a mesh
    /// Requests compression of views with the settings' extension, where it saves space.
    void compress(const MeshoptSettings& settings) { meshopt_ = settings; }
    void use_extension(const std::string& name, bool required);
    void drop_extension(const std::string& name);

    /// Drops released and unused items, removes empty lists, and returns the bytes of the only buffer. Views
    /// that were compressed by meshopt are written uncompressed, with a warning, unless compress was called.
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
    std::map<std::size_t, Bytes> new_views_;     // new views, by view index at the time of adding
    std::map<std::size_t, std::string> filters_; // filters of new views
    Source source_, current_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> shared_accessors_; // by hash
    /// By names: the view and the primitive.
    std::map<std::string, std::vector<std::pair<std::size_t, Json>>> compressed_;
    std::vector<std::size_t> old_view_; // the original index of each remaining view
    std::set<std::size_t> released_accessors_, released_views_;
    MeshoptSettings meshopt_;
    std::size_t unpacked_bytes_ = 0; ///< size of the dataless buffer that compressed views refer to
    std::map<std::size_t, std::vector<std::size_t>> dataless_; // views of dataless buffers, by buffer
};

/// Calls visit for every reference to an accessor, a buffer view or a mesh in core glTF and in supported
/// extensions.
void visit_accessor_references(Json& document, const std::function<void(Json&)>& visit);
void visit_view_references(Json& document, const std::function<void(Json&)>& visit);
void see_view_references(const Json& document, const std::function<void(const Json&)>& see);
void visit_mesh_references(Json& document, const std::function<void(Json&)>& visit);
/// True if the document has an extension with unknown references: then no index may change. An extension
/// without integers and pointers has none.
bool has_unknown_extensions(const Json& document);
/// True if such an extension may refer to accessors or buffer views, too.
bool may_name_accessors(const Json& document);
/// Erases items of a list and renumbers the references to it.
void erase_items(Json& list, const std::set<std::size_t>& items,
                 const std::function<void(const std::function<void(Json&)>&)>& references);

} // namespace facetmill::io::gltf
