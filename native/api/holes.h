// The boundary loops of a mesh that are to be filled, each with its surroundings, and those that can't be.
#pragma once

#include "base/types.h"
#include "fill/loop_sides.h"
#include "geometry/hard_edges.h"
#include "mesh/fans.h"

namespace fairing {

// Any triangles; what is wrong with them away from a hole is no matter. Triangles with a corner that is not finite
// count as missing for slopes, but bound no hole.
struct BorderedMesh {
    View<Points> vertices;  // outlive it
    Triangles triangles;
    VertexPairs marked = {};  // edges that are hard whatever they bend
};

// Loops named by the caller, in either direction; empty: all holes. Normals and curvatures: for all vertices of the
// mesh, or a row per vertex of each loop (loops that touch are then not split); none: fitted.
struct NamedLoops {
    std::vector<Indices> loops = {};
    std::vector<Points> normals = {};
    std::vector<VectorX> curvatures = {};
    Points vertex_normals = {};
    VectorX vertex_curvatures = {};
    int longest = 0;  // without names: the most edges that a loop may have; 0: any
    double longest_length = 0.0;

    [[nodiscard]] bool are_parted() const { return normals.empty() && curvatures.empty(); }
};

struct LeftOpen {
    Indices loop;
    Diagnostic reason;
    bool is_outer = false;  // around the outside of a sheet
};

// A loop, or several loops, to be closed by one surface.
struct Hole {
    std::vector<BoundaryLoop> loops;  // vertices of the mesh, the surface on the left
    VertexPairs hard = {};            // edges around, across which no slope is fitted
};

struct Holes {
    std::vector<Hole> holes;
    std::vector<LeftOpen> left;
};

// The mesh with its adjacency, for any number of calls and threads.
class HoledMesh {
public:
    explicit HoledMesh(BorderedMesh mesh);
    HoledMesh(const HoledMesh&) = delete;
    HoledMesh& operator=(const HoledMesh&) = delete;
    ~HoledMesh() = default;

    [[nodiscard]] const BorderedMesh& mesh() const { return mesh_; }
    // A local mesh of `vertices`, `also`, and the finite triangles within the rings that slopes depend on.
    [[nodiscard]] LocalMesh around(const Indices& vertices, const Indices& also = {}) const;
    [[nodiscard]] const Stars& stars() const { return stars_; }

private:
    BorderedMesh mesh_;
    Stars stars_;
};

// Each hole is found and judged by what is around it alone. `bridge`: one surface joins all. Throws the first reason
// where no hole is left, or any loop is bad that is to be joined with others; std::invalid_argument for normals that
// lie along the boundary.
Holes find_holes(const HoledMesh& mesh, const NamedLoops& named, bool bridge);

// What is known about border loops before they are filled, in either direction. Throws NOT_A_LOOP.
std::vector<LoopShape> loop_shapes(const HoledMesh& mesh, const std::vector<Indices>& loops);

// NOT_A_HOLE: outer borders that were left open.
Diagnostic outer_borders_left(const std::vector<Indices>& loops);

}  // namespace fairing
