#include "fillet/end_cuts.h"

#include <map>
#include <set>

#include "base/columns.h"
#include "boundary/fair_curve.h"
#include "fillet/cut_triangle.h"
#include "fillet/end_faces.h"
#include "fillet/limits.h"
#include "geometry/triangle.h"

namespace fairing {

namespace {

constexpr double slanted = 0.2;      // sine of the angle between a seam and a face: a longer section is none
constexpr double derivative = 1e-4;  // of a section's length

// Directions in which seams leave vertices at which no other one does.
std::map<int, Vector3> seam_ends(const SeamMesh& mesh) {
    std::map<int, int> count;
    std::map<int, Vector3> headings;
    for (int h = 0; h < mesh.half_edge_count(); ++h) {
        if (mesh.seam[h] == none) continue;
        ++count[mesh.tail(h)];
        headings[mesh.tail(h)] = direction(mesh.points.col(mesh.head(h)) - mesh.points.col(mesh.tail(h)));
    }
    std::erase_if(headings, [&](const auto& heading) { return count.at(heading.first) != 1; });
    return headings;
}

// Edges of walls from one point of the line to the next, the fillet on their left.
using Chain = Indices;

class EndCutting {
public:
    EndCutting(const SeamMesh& mesh, SideNormals& sides, SplitMesh& cut)
        : mesh_(mesh), sides_(sides), cut_(cut), ends_(seam_ends(mesh)) {}

    EndSections result() {
        if (ends_.empty()) return {};
        EndFaces faces(mesh_.points, mesh_.triangles, cut_);
        std::vector<EndSection> sections;
        for (const Chain& chain : chains(faces)) add_section(chain, faces, sections);
        faces.replace(sections);
        faces.write(cut_);
        EndSections made;
        for (const EndSection& each : sections) {
            made.vertices.insert(made.vertices.end(), each.vertices.begin(), each.vertices.end());
            made.normals.insert(made.normals.end(), each.vertex_normals.begin(), each.vertex_normals.end());
            made.before.insert(made.before.end(), each.before.begin(), each.before.end());
        }
        return made;
    }

private:
    [[nodiscard]] std::vector<Chain> chains(const EndFaces& faces) const {
        const std::set<VertexPair> line(cut_.line.begin(), cut_.line.end());
        std::map<int, int> next;  // along the fillet's border
        for (Eigen::Index t = 0; t < cut_.triangles.cols(); ++t) {
            for (int k = 0; cut_.inside[t] != 0 && k < 3; ++k) {
                const int from = cut_.triangles(k, t);
                const int to = cut_.triangles((k + 1) % 3, t);
                const int other = faces.at(to, from);
                if (other == none || cut_.inside[other] == 0) next[from] = to;
            }
        }
        std::vector<Chain> found;
        for (const auto& [before, end] : cut_.line) {
            if (!next.contains(end) || line.contains({end, next.at(end)})) continue;
            Chain chain{end};
            while (next.contains(chain.back()) && chain.size() <= next.size()) {
                const VertexPair side{chain.back(), next.at(chain.back())};
                if (line.contains(side)) break;
                chain.push_back(side[1]);
            }
            found.push_back(chain);
        }
        return found;
    }

    // The middle of all seams that end there; zero without any.
    [[nodiscard]] Vector3 seam_heading(const Chain& chain, int& end) const {
        Vector3 sum = Vector3::Zero();
        for (std::size_t k = 1; k + 1 < chain.size(); ++k) {
            const auto found = ends_.find(chain[k]);
            if (found == ends_.end()) continue;
            sum += found->second;
            end = found->first;
        }
        return direction(sum);
    }

    Vector3 side_normal(int parent, const Vector3& place) {
        return sides_.normal(parent, barycentric(mesh_.points, mesh_.triangles, parent, place));
    }

    void add_section(const Chain& chain, const EndFaces& faces, std::vector<EndSection>& sections) {
        int end = none;
        const Vector3 heading = seam_heading(chain, end);
        if (heading.isZero()) return;
        const std::optional<Vector3> plane = faces.plane_beyond(chain);
        if (!plane || std::abs(heading.dot(*plane)) < slanted) return;
        const Vector3 begin = faces.place(chain.front());
        const Vector3 last = faces.place(chain.back());
        const Vector3 middle = faces.place(end);
        const auto across = [&](const Vector3& v) { return Vector3(v - v.dot(heading) * heading); };
        const auto along_side = [&](const VertexPair& side, const Vector3& place, const Vector3& wanted) {
            const Vector3 found = side_normal(faces.parent(faces.at(side[0], side[1])), place).cross(heading);
            return Vector3(found.dot(wanted) < 0.0 ? -found : found);
        };
        const CurveEnd from{across(begin - middle), along_side({chain[0], chain[1]}, begin, middle - begin)};
        const CurveEnd to{across(last - middle), along_side({*(chain.end() - 2), chain.back()}, last, last - middle)};
        if (from.direction.isZero() || to.direction.isZero() || from.place == to.place) return;
        const VectorX shares = shares_along(chain, faces);
        VectorX all(3 * shares.size());
        all << shares, (shares.array() - derivative).max(0.0), (shares.array() + derivative).min(1.0);
        const Points curve = fair_curve(from, to, all);
        const Vector3 normal = side_normal(faces.parent(faces.at(chain[0], chain[1])), begin);
        const double sign = from.direction.cross(heading).dot(normal) < 0.0 ? -1.0 : 1.0;
        EndSection section{chain, {}, {}, *plane, none, {}, {}, {}};
        for (Eigen::Index k = 0; k < shares.size(); ++k) {
            const Vector3 place = curve.col(k);
            section.places.emplace_back(middle + place - place.dot(*plane) / heading.dot(*plane) * heading);
            const Vector3 tangent = curve.col(2 * shares.size() + k) - curve.col(shares.size() + k);
            section.normals.emplace_back(sign * tangent.cross(heading).normalized());
        }
        sections.push_back(std::move(section));
    }

    // Shares of the chain's length at its vertices.
    [[nodiscard]] static VectorX shares_along(const Chain& chain, const EndFaces& faces) {
        std::vector<double> lengths{0.0};
        for (std::size_t k = 1; k < chain.size(); ++k)
            lengths.push_back(lengths.back() + (faces.place(chain[k]) - faces.place(chain[k - 1])).norm());
        return VectorX::Map(lengths.data(), std::ssize(lengths)) / lengths.back();
    }

    const SeamMesh& mesh_;
    SideNormals& sides_;
    SplitMesh& cut_;
    std::map<int, Vector3> ends_;
};

}  // namespace

EndSections cut_ends(const SeamMesh& mesh, SideNormals& sides, SplitMesh& cut) {
    return EndCutting(mesh, sides, cut).result();
}

}  // namespace fairing
