#include "fill/loop_sides.h"

#include <Eigen/Geometry>

#include "base/columns.h"

namespace fairing {

namespace {

constexpr double leads_away = -0.3;  // mean cosine of directions into the surface and to the others; −.17 at 200° bends
constexpr double leads_aside = 0.1;  // of the same: the side of a loop whose surface leads neither there nor away
constexpr double facing = 0.5;       // of the same, and between normals and the directions from a loop's middle

// Mean cosine between the directions into a loop's surface and to the nearest of other points; 0 for a lone loop.
double cosine_to_others(const std::vector<BoundaryLoop>& loops, std::size_t one) {
    const LoopShape& loop = loops[one].shape;
    std::vector<Vector3> others;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (l == one) continue;
        for (const auto place : loops[l].shape.points.colwise()) others.emplace_back(place);
    }
    if (others.empty()) return 0.0;
    const Indices some = spread(static_cast<int>(others.size()));
    const Indices few = spread(loop.size());
    double sum = 0.0;
    for (const int k : few) {
        const Vector3 here = loop.points.col(k);
        const Vector3 along = loop.edge(k) + loop.edge((k + loop.size() - 1) % loop.size());
        const int nearest = *std::min_element(some.begin(), some.end(), [&](int a, int b) {
            return (others[a] - here).squaredNorm() < (others[b] - here).squaredNorm();
        });
        sum += direction(loop.normals.col(k).cross(along)).dot(direction(others[nearest] - here));
    }
    return sum / static_cast<double>(few.size());
}

Diagnostic refusal(const std::string& text, Indices vertices, const char* figure) {
    std::sort(vertices.begin(), vertices.end());
    Figures figures;
    if (figure) figures[figure] = size_of(vertices);
    return {Code::loops_not_joined, "loops: " + text, std::move(vertices), ElementKind::vertex, std::move(figures)};
}

std::string named(const std::vector<BoundaryLoop>& loops, std::size_t one) {
    return "no surface joins loop " + std::to_string(one) + " (" + listed(loops[one].vertices) + ") with the others";
}

Diagnostic refused(const std::vector<BoundaryLoop>& loops, std::size_t one, const std::string& what,
                   std::string advice) {
    if (!loops[one].is_bare)
        advice = std::string("flip the triangles around it") + (loops.size() > 2 ? ", or leave it out" : "");
    return refusal(named(loops, one) + ", " + what + ": " + advice, loops[one].vertices, "turned");
}

// Mean cosine between the normals and the directions from the loop's middle.
double outward(const LoopShape& loop) {
    const Vector3 middle = loop.points.rowwise().mean();
    double sum = 0.0;
    for (int k = 0; k < loop.size(); ++k) sum += loop.normals.col(k).dot(direction(loop.points.col(k) - middle));
    return sum / loop.size();
}

// A tube that is seen from outside at one end and from inside at the other one crosses itself.
void check_sides(const std::vector<BoundaryLoop>& loops) {
    if (loops.size() != 2 || std::min(cosine_to_others(loops, 0), cosine_to_others(loops, 1)) < facing) return;
    const double one = outward(loops[0].shape);
    const double other = outward(loops[1].shape);
    if (std::min(std::abs(one), std::abs(other)) <= facing || one * other >= 0.0) return;
    const char* const what = "its normals point to the axis of the tube, those of the other one away from it";
    throw MeshError(refused(loops, one < other ? 0 : 1, what, "turn its normals"));
}

// Between two holes in walls that face one way a surface would have to turn back at both.
void check_walls(const std::vector<BoundaryLoop>& loops) {
    constexpr double is_wall = 0.5;  // turning: 1 around a hole in a plane, 0 at the end of a tube
    if (loops.size() != 2) return;
    for (const BoundaryLoop& loop : loops) {
        if (loop.is_bare || turning(loop.shape) < is_wall) return;
    }
    const Vector3 one = loops[0].shape.normals.rowwise().mean();
    if (one.dot(loops[1].shape.normals.rowwise().mean()) < facing) return;
    Indices all = loops[0].vertices;
    all.insert(all.end(), loops[1].vertices.begin(), loops[1].vertices.end());
    throw MeshError(refusal("both holes face the same way: extrude their borders towards each other first",
                            std::move(all), "one_way"));
}

}  // namespace

void BoundaryLoop::turn() {
    std::reverse(vertices.begin(), vertices.end());
    shape.points = shape.points.rowwise().reverse().eval();
    shape.normals = shape.normals.rowwise().reverse().eval();
    curvatures = curvatures.reverse().eval();
}

void BoundaryLoop::begin_anew() {
    constexpr double alike = 1e-6;  // of the loop's size: far more than roundoff, or a turned mesh has another start
    const int count = shape.size();
    const Points out = shape.points.colwise() - shape.points.rowwise().mean();
    const auto mark = [&](int k) { return out.col(k).norm() + shape.edge(k).norm(); };
    VectorX marks(count);  // the next place counts half: two places that mirror each other differ in it
    for (int k = 0; k < count; ++k) marks[k] = mark(k) + 0.5 * mark((k + 1) % count);
    const double least = (1.0 - alike) * marks.maxCoeff();
    int first = none;
    for (int k = 0; k < count; ++k) {
        if (marks[k] >= least && (first == none || vertices[k] < vertices[first])) first = k;
    }
    Indices order;
    for (int k = 0; k < count; ++k) order.push_back((first + k) % count);
    std::rotate(vertices.begin(), vertices.begin() + first, vertices.end());
    shape.points = shape.points(Eigen::all, order).eval();
    if (shape.normals.cols() > 0) shape.normals = shape.normals(Eigen::all, order).eval();
    if (curvatures.size() > 0) curvatures = curvatures(order).eval();
}

void settle_sides(std::vector<BoundaryLoop>& loops, bool bridge) {
    const bool joined = bridge && loops.size() > 1;
    std::vector<std::size_t> turned;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (!loops[l].is_bare) continue;
        if (joined ? cosine_to_others(loops, l) < leads_away : leads_outside(loops[l].shape)) turned.push_back(l);
    }
    for (const std::size_t l : turned) {
        loops[l].turn();
        loops[l].begin_anew();
    }
    if (!joined) return;
    check_sides(loops);
    check_walls(loops);
}

Diagnostic not_joined(const std::vector<BoundaryLoop>& loops) {
    std::vector<double> cosines;
    cosines.reserve(loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) cosines.push_back(cosine_to_others(loops, l));
    const auto worst = static_cast<std::size_t>(std::min_element(cosines.begin(), cosines.end()) - cosines.begin());
    if (cosines[worst] > leads_aside) {
        Indices all;
        for (const BoundaryLoop& loop : loops) all.insert(all.end(), loop.vertices.begin(), loop.vertices.end());
        return refusal(
            "no surface joins them; they cross or are linked, face away from each other, or are too many: "
            "join fewer",
            std::move(all), nullptr);
    }
    if (loops[worst].is_bare)
        return refused(loops, worst, "the surface would lead away from the others there",
                       "turn its normals or its direction");
    return refusal(named(loops, worst) + ": its own triangles are in the way: cut them back, or leave it out",
                   loops[worst].vertices, "between");
}

std::string listed(const Indices& vertices) {
    constexpr std::size_t most = 5;  // names in one sentence
    std::string text = vertices.size() == 1 ? "vertex " : "vertices ";
    for (std::size_t k = 0; k < std::min(vertices.size(), most); ++k)
        text += (k > 0 ? ", " : "") + std::to_string(vertices[k]);
    if (vertices.size() > most) text += " and " + std::to_string(vertices.size() - most) + " more";
    return text;
}

}  // namespace fairing
