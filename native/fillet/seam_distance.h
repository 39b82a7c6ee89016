// Exact distances along the surface from seams, less the width there.
#pragma once

#include "fillet/seam_mesh.h"

namespace fairing {

// Widths of a fillet at each vertex: on the left of its seams and on the right, as their directions have it.
struct SeamWidths {
    VectorX left;
    VectorX right;
    [[nodiscard]] double largest() const { return std::max(left.maxCoeff(), right.maxCoeff()); }
};

struct SeamPlace {
    double distance;  // along the surface; infinite beyond the reach
    double width;     // at the seam's nearest point, on this side
};

// Where a shortest path from the seam begins: on a seam's half-edge `half_edge`, `along` it from its tail; or at a
// corner, in the sector that begins with that half-edge, in a direction `along` it radians counter-clockwise from
// there.
struct SeamFoot {
    int half_edge;  // or `none`
    bool corner;
    double along;
};

// Windows of straight rays, unfolded from triangle to triangle (Mitchell, Mount & Papadimitriou 1987; Chen & Han 1990,
// with the filter of Xin & Wang 2009): parallel ones from each seam, fans from its corners, and from the vertices that
// shortest paths bend around. All distances up to `reach` are exact but for roundoff.
class SeamDistance {
public:
    // `widths`: entries at the seams' vertices are read. `through`: seams that end on walls go on beyond these. Asks
    // whether to stop. Keeps a reference to the mesh.
    SeamDistance(const SeamMesh& mesh, const SeamWidths& widths, double reach, bool through = false);

    [[nodiscard]] bool reaches(int triangle) const { return !windows_of_[triangle].empty(); }
    // The nearest seam, by the distance less the width.
    [[nodiscard]] SeamPlace at(int triangle, const Vector3& weights) const;
    [[nodiscard]] SeamFoot foot(int triangle, const Vector3& weights) const;
    // The width there as a share of the widest, to which lengths of new edges are in proportion; 1 beyond the reach.
    [[nodiscard]] double relative_width(int triangle, const Vector3& weights) const;
    // Distance less width: negative within the fillet.
    [[nodiscard]] double value(int triangle, const Vector3& weights) const;
    // A lower bound of the value within `radius` of a place in the triangle, in which sight lines do not count.
    [[nodiscard]] double least_value(int triangle, const Vector3& weights, double radius) const;

private:
    // Rays of one source have coordinates that grow clockwise around it: the place on a seam's edge, or the angle.
    struct Source {
        double first, last;              // coordinates,
        double width_first, width_last;  // and the widths there
        bool parallel;
        SeamFoot foot;  // `along`: of paths that bend around a vertex, else that of each ray
    };
    struct Window {
        int half_edge;  // whose frame `origin` and `zero` are in; rays enter its triangle there,
        bool corner;    // or begin at its tail
        Vector2 origin, zero;
        double base;         // the coordinate of the ray along `zero`
        double first, last;  // rays
        double offset;       // the distance to the origin
        int source;
        int crossed = 0;  // edges
    };
    struct Event {
        double key;
        int window;     // that goes on, or `none`:
        int half_edge;  // its tail becomes
        int source;     // this one
        bool operator>(const Event& other) const { return key != other.key ? key > other.key : window > other.window; }
    };
    void seed_edges(const SeamWidths& widths);
    void seed_corners(const SeamWidths& widths);
    void seed_sector(int first_half_edge, const SeamWidths& widths);
    void seed_extension(int wall, int seam, double angle, double width);
    void emit_fan(int half_edge, int source);
    void add(const Window& window, double key);
    void run();
    void propagate(int w);
    void pass(const Window& window, int through, double first, double last);
    void touch(int half_edge, double reached, const Window& window, double ray);
    [[nodiscard]] double width_of(int half_edge, bool at_tail, const SeamWidths& widths) const;
    struct Nearest {
        SeamPlace place;
        int window;  // or `none`
        double ray;
    };
    [[nodiscard]] Nearest nearest(int triangle, const Vector3& weights) const;
    [[nodiscard]] SeamFoot foot(const Source& source, double ray) const;
    [[nodiscard]] double coordinate(const Window& window, const Vector2& place) const;
    [[nodiscard]] double distance(const Window& window, const Vector2& place) const;
    [[nodiscard]] double width(const Window& window, double coordinate) const;
    [[nodiscard]] double tolerance(const Window& window) const;
    [[nodiscard]] double crossing(const Window& window, double coordinate) const;
    [[nodiscard]] bool bends(int half_edge) const;

    const SeamMesh& mesh_;
    double reach_;
    bool through_;
    double widest_ = 0.0;
    double slack_ = 0.0;  // paths that are longer by less than that may lead to wider fillets
    double size_ = 1.0;
    std::vector<Source> sources_;
    std::vector<Window> windows_;
    std::vector<Indices> windows_of_;  // of each triangle
    std::vector<double> vertex_;       // distance of each sheet vertex
    Indices seams_at_;                 // of each vertex: how many there are
    std::vector<Event> queue_;
};

}  // namespace fairing
