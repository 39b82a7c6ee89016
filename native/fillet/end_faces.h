// Faces at the ends of seams, cut along a fillet's cross-section.
#pragma once

#include <map>
#include <optional>

#include "fillet/end_section.h"

namespace fairing {

class EndFaces {
public:
    using Corners = std::array<int, 3>;
    // The faces made of the triangles given. Keeps references to both.
    EndFaces(const Points& points, const Triangles& triangles, const SplitMesh& cut);

    [[nodiscard]] int at(int from, int to) const;  // the piece with that directed side, or `none`
    [[nodiscard]] int parent(int piece) const { return parent_[piece]; }
    [[nodiscard]] Vector3 place(int vertex) const;
    // For each triangle given: whether the fillet takes nothing of it, its corners, and all vertices around it.
    [[nodiscard]] bool is_whole(int given) const;
    [[nodiscard]] Corners corners_given(int given) const;
    [[nodiscard]] Indices border(int given) const;
    [[nodiscard]] bool lies_in(int given, const Vector3& plane, const Vector3& origin) const;
    // The unit normal of the face on the chain's right, if that is one plane.
    [[nodiscard]] std::optional<Vector3> plane_beyond(const Indices& chain) const;
    // Cuts the faces along the sections, or adds to them, and takes the fillet there.
    void replace(std::vector<EndSection>& sections);
    void write(SplitMesh& cut) const;

private:
    int put(const Corners& corners, int parent, bool inside);
    void remove(int piece);
    [[nodiscard]] FaceChange extension(const EndSection& section) const;
    void write(const std::vector<EndSection*>& sections, const FaceChange& change);
    void move_fillet(const Indices& chain, const std::vector<Indices>& path);

    const Points& points_;
    const Triangles& given_;
    std::vector<Vector3> added_;
    std::vector<Corners> triangles_;
    Indices parent_;
    std::vector<char> inside_, removed_;
    std::vector<Indices> pieces_of_;  // of each triangle given
    std::map<VertexPair, int> sides_;
    std::map<int, int> moved_;  // seams' ends
};

}  // namespace fairing
