// Half-edge collapses on connectivity and inner-fairness weights alone, for the coarse levels of the global method.
#pragma once

#include "base/types.h"
#include "fairness/inner_weights.h"

namespace fairing {

// Sides of triangle t: 3t + k runs from corner k to corner k + 1.
inline int next_side(int s) { return s % 3 == 2 ? s - 2 : s + 1; }
inline int previous_side(int s) { return s % 3 == 0 ? s + 2 : s - 1; }

// The neighbours of a vertex counter-clockwise, with the sides that lead there; the last of an open star has none.
struct Star {
    int centre = none;
    bool closed = true;
    Indices vertices;
    Indices sides;
    std::vector<double> weights;
    std::vector<double> prices;  // scratch: what collapses onto each neighbour cost
    std::vector<double> passed;  // scratch: new weights to the vertex kept
    Indices around;              // scratch: neighbours of the vertex kept

    [[nodiscard]] std::size_t size() const { return vertices.size(); }
    [[nodiscard]] double weight() const { return std::accumulate(weights.begin(), weights.end(), 0.0); }
    // Whether neighbours k and k + 1 (cyclic) span a triangle with the centre.
    [[nodiscard]] bool has_triangle(std::size_t k) const { return closed || k + 1 < size(); }
    [[nodiscard]] std::size_t after(std::size_t k) const { return k + 1 == size() ? 0 : k + 1; }
    [[nodiscard]] std::size_t before(std::size_t k) const { return k == 0 ? size() - 1 : k - 1; }
};

// A free vertex that was removed: its value follows from its neighbours at that time by their weights.
struct Removals {
    Indices vertex;
    Indices begin{0};
    Indices neighbours;
    std::vector<float> weights;  // sum 1 for each vertex
    Indices pass_begin{0};       // no two of a pass are neighbours

    [[nodiscard]] int size() const { return static_cast<int>(vertex.size()); }
    void append(const Removals& more);
};

// Where the fixed vertices are: thinned loops have to follow the boundary. 3 × local vertices, free columns unused.
// Loops whose normals are 0 stay whole.
struct FixedPlaces {
    const Points& points;
    const Points& normals;
};

// The vertices and triangles of a patch of the present mesh.
struct CoarseMesh {
    PatchMembers members;
    Twins twins;
};

// A mesh without interior positions: shapes are those of the graph for uniform weights, and otherwise of the weights,
// which are large along short edges.
class CollapseMesh {
public:
    CollapseMesh(const Patch& patch, const InnerWeights& weights, const FixedPlaces& boundary);

    // Removes vertices, no two of them neighbours, and returns the free ones among them: about a quarter of the mesh.
    // Collapses keep the topology, valences between 4 and 9 where they were, and make no chord between fixed vertices.
    Removals pass();

    // To be called before a level's passes: loops may lose half of their vertices until the next call.
    void begin_level();

    [[nodiscard]] int free_count() const { return free_count_; }
    // The present mesh: to_input and input_triangle are the patch's vertices and triangles.
    [[nodiscard]] CoarseMesh mesh() const;
    // Weights of the present edges by the patch's vertices, each edge once.
    [[nodiscard]] InnerWeights weights() const;

private:
    struct Domain;

    void build_sides(const Patch& patch);
    void set_weights(const Patch& patch, const InnerWeights& weights);
    void number_loops(const Patch& patch);
    void gather(int v, Star& star) const;
    void pass_over(Domain& domain);
    [[nodiscard]] bool may_go(int v) const;
    bool try_collapse(Star& star, Removals& removals);
    [[nodiscard]] std::size_t cheapest_legal(Star& star) const;
    // `largest`: of the star's weights.
    [[nodiscard]] double cost(const Star& star, std::size_t k, double largest) const;
    [[nodiscard]] bool is_legal(Star& star, std::size_t k) const;
    [[nodiscard]] bool may_thin(const Star& star, std::size_t k) const;
    void pass_weights_on(Star& star, std::size_t k) const;
    void pass_fixed_weights_on(Star& star, std::size_t k) const;
    void collapse(const Star& star, std::size_t k);
    void strengthen_rim(const Star& star, std::size_t k);
    void hand_over_spokes(const Star& star, int kept);
    void drop_triangle(int side, double weight);
    void set_first_side(int v, int side);

    [[nodiscard]] bool is_fixed(int v) const { return v >= patch_free_count_; }
    [[nodiscard]] double valence_penalty(int v, int valence) const;

    const FixedPlaces& boundary_;
    int patch_free_count_;
    int free_count_;
    std::vector<char> pin_;
    std::vector<char> border_;
    std::vector<char> dead_vertex_;
    std::vector<char> dead_triangle_;
    std::vector<char> blocked_;
    Indices valence_;
    Indices first_side_;  // outgoing; of border vertices the one without a twin
    Indices loop_;        // of a border vertex
    Indices loop_size_;
    Indices least_loop_size_;
    // Side 3t + k runs from corner k to corner k + 1 of triangle t. The data of one side lie together, since memory
    // access limits the speed on large meshes.
    struct Side {
        int corner;
        int twin;
        float weight;  // the same on both sides of an edge
    };
    std::vector<Side> sides_;
    Indices alive_;  // vertices, ascending
};

}  // namespace fairing
