#pragma once
// The nodes and meshes of a glTF document as prims of a USD layer.

#include "io/usd/materials.hpp"

namespace facetmill::io::usd {

class Nodes {
  public:
    /// root: the path of the prim around all nodes. All must outlive it.
    Nodes(gltf::Source& source, Materials& materials, std::string root);

    /// Writes the scene that viewers show, and other nodes as invisible.
    void write();

    const Layer& layer() const { return layer_; }
    /// The meshes that several nodes show.
    const Layer& shared() const { return shared_; }

  private:
    struct Root {
        std::size_t node;
        bool shown;
    };
    [[nodiscard]] std::vector<Root> roots() const;
    void write_nodes(std::size_t nodes);
    void open_node(const Json& node, std::size_t index, bool shown);
    void put_transform(const Json& node);
    void put_mesh(std::size_t mesh);
    void put_primitives(Layer& layer, std::size_t mesh);
    void put_primitive(Layer& layer, const std::string& name, const Json& primitive);
    void put_faces(Layer& layer, const Json& primitive, const Attribute& positions);
    /// The numbers of a vertex attribute; none if they are missing, or not one per vertex.
    std::optional<Attribute> numbers_of(const Json& attributes, const char* name, std::size_t count);

    gltf::Source& source_;
    const Json& json_;
    Materials& materials_;
    std::string root_;
    Layer layer_{1}, shared_{2};
    std::vector<std::size_t> uses_;         ///< [meshes]
    std::vector<std::string> shared_names_; ///< [meshes] empty: not written yet
};

} // namespace facetmill::io::usd
