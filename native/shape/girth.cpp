#include "shape/girth.h"

#include <map>
#include <unordered_map>

#include <Eigen/Geometry>

#include "fairness/harmonic_values.h"
#include "mesh/loops.h"
#include "mesh/union_find.h"
#include "start/swept_tube.h"

namespace fairing {

namespace {

// Cells that vertices are gathered in. A line that follows borders of cells has the same shadow as one that does not,
// so that more of them only cost time: a solve with these takes 3 ms.
constexpr int most_cells = 1500;

// Sections lie at these levels.
constexpr int section_count = 17;
constexpr double level_of(int section) {
    constexpr double first = 0.1;  // the last one as far from the loop
    return first + (1.0 - 2.0 * first) * section / (section_count - 1);
}

// Cells of neighbouring vertices, around equally many of them each: one for each boundary loop, then those inside.
class Cells {
public:
    Cells(const Patch& patch, const std::vector<Indices>& loops) : cell_(patch.vertex_count(), none) {
        Indices queue;
        for (const Indices& loop : loops) {
            for (const int v : loop) cell_[v] = count_;
            ++count_;
        }
        const int stride = (patch.free_count + most_cells - 1) / most_cells;
        for (int v = 0; v < patch.free_count; v += stride) {
            cell_[v] = count_++;
            queue.push_back(v);
        }
        for (std::size_t k = 0; k < queue.size(); ++k) {
            for (const int u : patch.ring(queue[k]).vertices) {
                if (cell_[u] != none) continue;
                cell_[u] = cell_[queue[k]];
                queue.push_back(u);
            }
        }
    }

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] int of(int vertex) const { return cell_[vertex]; }

private:
    Indices cell_;
    int count_ = 0;
};

// For each loop the function of cells that is 1 there, 0 at the other loops, and elsewhere the mean of its neighbours
// by the edges between them. Nothing where some cells hang on no loop.
std::optional<Eigen::MatrixXd> harmonic_functions(const Patch& patch, const Cells& cells, int loop_count) {
    InnerWeights edges;
    for (const auto& [v, w] : patch.edge_ends) {
        const int a = cells.of(v);
        const int b = cells.of(w);
        if (a != b && a != none && b != none) edges.push_back({a, b, 1.0});
    }
    std::vector<char> is_known(cells.count(), 0);
    std::fill_n(is_known.begin(), loop_count, 1);
    Eigen::MatrixXd values =
        Eigen::MatrixXd::Constant(cells.count(), loop_count, std::numeric_limits<double>::quiet_NaN());
    values.topRows(loop_count).setIdentity();
    auto found = harmonic_values({edges, std::move(is_known)}, std::move(values));
    return found && found->allFinite() ? found : std::nullopt;
}

// Whether a level line runs through a triangle with these values.
bool is_met(const Vector3& values, double level) { return values.minCoeff() < level && values.maxCoeff() >= level; }

// The part of a level line within one triangle, higher values on one side.
struct Step {
    int from_edge;
    int to_edge;
    Vector3 area;  // that its ends span with the origin
};

Step step_within(const Patch& patch, const Points& points, const Vector3& values, int t, double level) {
    int from = 0;
    int to = 0;
    for (int k = 0; k < 3; ++k) {
        const bool first_is_high = values[(k + 1) % 3] >= level;
        const bool last_is_high = values[(k + 2) % 3] >= level;
        if (first_is_high && !last_is_high) from = k;
        if (!first_is_high && last_is_high) to = k;
    }
    // Where the line meets the edge opposite to corner k.
    const auto crossing = [&](int k) {
        const double a = values[(k + 1) % 3];
        const double b = values[(k + 2) % 3];
        const double share = (level - a) / (b - a);
        const auto corners = patch.triangles.col(t);
        return Vector3((1.0 - share) * points.col(corners[(k + 1) % 3]) + share * points.col(corners[(k + 2) % 3]));
    };
    const Vector3 area = 0.5 * crossing(from).cross(crossing(to));
    return {patch.triangle_edges(from, t), patch.triangle_edges(to, t), area};
}

// Within all closed curves of a line.
double area_within(const std::vector<Step>& steps) {
    std::unordered_map<int, int> numbers;  // of edges, in the order in which the line meets them
    const auto number = [&](int edge) {
        return numbers.try_emplace(edge, static_cast<int>(numbers.size())).first->second;
    };
    UnionFind curves(2 * static_cast<int>(steps.size()));
    for (const Step& step : steps) curves.join(number(step.from_edge), number(step.to_edge));
    std::map<int, Vector3> areas;
    for (const Step& step : steps)
        areas.try_emplace(curves.root(number(step.from_edge)), Vector3::Zero()).first->second += step.area;
    double sum = 0.0;
    for (const auto& [curve, area] : areas) sum += area.norm();
    return sum;
}

}  // namespace

std::optional<CrossSections> CrossSections::of(const Patch& patch) {
    const std::vector<Indices> loops = patch.loops();
    if (loops.size() < 2) return std::nullopt;
    const int loop_count = static_cast<int>(loops.size());
    const Cells cells(patch, loops);
    const auto functions = harmonic_functions(patch, cells, loop_count);
    if (!functions) return std::nullopt;
    CrossSections result(patch);
    for (int k = 0; k < (loop_count == 2 ? 1 : loop_count); ++k) {
        VectorX& values = result.levels_.emplace_back(VectorX::Zero(patch.vertex_count()));
        for (int v = 0; v < patch.vertex_count(); ++v) {
            if (cells.of(v) != none) values[v] = (*functions)(cells.of(v), k);
        }
    }
    return result;
}

VectorX CrossSections::radii(int loop, const Points& points) const {
    std::vector<std::vector<Step>> steps(section_count);
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        const Vector3 values = levels_[loop](patch_.triangles.col(t));
        if (values.minCoeff() == values.maxCoeff()) continue;  // within one cell
        for (int section = 0; section < section_count; ++section) {
            const double level = level_of(section);
            if (is_met(values, level)) steps[section].push_back(step_within(patch_, points, values, t, level));
        }
    }
    VectorX radii(section_count);
    for (int section = 0; section < section_count; ++section)
        radii[section] = radius_of_area(area_within(steps[section]));
    return radii;
}

Indices CrossSections::triangles(int loop, int section) const {
    Indices found;
    for (int t = 0; t < patch_.triangle_count(); ++t) {
        if (is_met(levels_[loop](patch_.triangles.col(t)), level_of(section))) found.push_back(t);
    }
    return found;
}

GirthRange worst_of(const GirthRange& a, const GirthRange& b) {
    const GirthRange& thin = b.least < a.least ? b : a;
    const GirthRange& thick = b.largest > a.largest ? b : a;
    return {thin.least, thick.largest, thin.thinnest, thick.thickest};
}

bool is_between_tubes(const Patch& patch, const Points& points, const Points& fixed_normals) {
    const std::vector<Indices> loops = patch.loops();
    Points normals(3, points.cols());
    normals.rightCols(fixed_normals.cols()) = fixed_normals;
    return loops.size() > 1 && std::all_of(loops.begin(), loops.end(), [&](const Indices& loop) {
               return tube_end(loop, points, normals).has_value();
           });
}

std::optional<GirthRange> girth_range(const Patch& patch, const Points& points) {
    const std::vector<Indices> loops = patch.loops();
    const auto sections = CrossSections::of(patch);
    if (!sections) return std::nullopt;
    std::vector<double> areas;
    areas.reserve(loops.size());
    for (const Indices& loop : loops) areas.push_back(area_within(loop, points));
    const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
    GirthRange range;
    for (int k = 0; k < sections->count(); ++k) {
        const VectorX radii = sections->radii(k, points);
        const double thinner = radius_of_area(std::min(areas[k], whole - areas[k]));
        const double thicker = radius_of_area(std::max(areas[k], whole - areas[k]));
        int thin = 0;
        int thick = 0;
        const double least = radii.minCoeff(&thin) / thinner;
        const double largest = radii.maxCoeff(&thick) / thicker;
        range = worst_of(range, {least, largest, corners_of(patch, sections->triangles(k, thin)),
                                 corners_of(patch, sections->triangles(k, thick))});
    }
    return range;
}

}  // namespace fairing
